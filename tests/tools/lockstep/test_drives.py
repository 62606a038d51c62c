"""Sentences drive the robot in lockstep; faults stop it; the same seed does the same."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import hypot

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planner.plan import GoalState
from tests.known import known
from tests.planner.language.laws.test_stop_laws import chinese, english
from tests.tools.lockstep.conftest import Ready
from tools.bench.measure.fault_times import trial
from tools.lockstep import TICK_S, Disturbance, GoalHandle, LockstepWorld
from tools.lockstep.world_fork import fork_world
from wire import Mode, Pose2, SimFault
from wire.keys import Party

pytestmark = pytest.mark.nightly(keep=16)


LIMIT_S = 90.0
IN_KITCHEN, BY_THE_DOOR = Pose2(1.5, 1.5, 1.5), Pose2(1.5, 2.0, 1.5)
"""In the kitchen of two_room, so that a drive to the living room takes seconds."""
BAD_WIRE = Disturbance(
    sender=Party.PLANNER, drop=0.1, duplicate=0.1, delay_ticks=(0, 4), reorder=True
)
HOLD2_TICKS = 31
"""BRAIN_LOST acts over 300 ms after the newest echoed status was sent: at the 31st tick at last."""


def inside(world: LockstepWorld, room_id: str) -> bool:
    room = known(world.scene.site.place(room_id))
    return room.contains(world.truth.x_m, world.truth.y_m)


def stands(goal: GoalHandle, state: GoalState) -> bool:
    return goal.state is state


def assert_within_limits(world: LockstepWorld) -> None:
    limits, base = world.scene.robot.limits, world.scene.robot.base
    sent = [command for command in world.commands if command is not None]
    fastest = max(max(abs(c.left_radps), abs(c.right_radps)) for c in sent)
    assert fastest <= limits.max_wheel_radps
    forward = max(abs(c.left_radps + c.right_radps) / 2 * base.wheel_radius_m for c in sent)
    # What the motors swallow is added behind the limits, and what wheel control finds missing.
    drive = world.scene.robot.drive
    swallowed_mps = drive.dead_zone_radps * base.wheel_radius_m
    correction_mps = swallowed_mps + drive.max_correction * limits.max_speed_mps
    assert forward <= limits.max_speed_mps + swallowed_mps + correction_mps + 1e-9
    assert all(a.seq < b.seq for a, b in pairwise(sent))


def driving(world: LockstepWorld) -> bool:
    return world.status.mode is Mode.ACTIVE and abs(world.twist.v_mps) > 0.2


Driving = Callable[[], tuple[LockstepWorld, GoalHandle]]


@pytest.fixture(scope="module")
def off(ready: Ready) -> Driving:
    """Return a maker of worlds on their way to the living room, each with its goal."""
    first = ready(seed=4, start=IN_KITCHEN)
    goal_id = first.say("go to the living room").id
    first.run_until(driving, LIMIT_S)

    def copy() -> tuple[LockstepWorld, GoalHandle]:
        world = fork_world(first)
        return world, world.goal(goal_id)

    return copy


@pytest.mark.parametrize(
    ("text", "wire"),
    [("去客厅", None), ("go to the living room", BAD_WIRE)],
    ids=["good wire", "bad wire"],
)
def test_a_goal_in_either_language_ends_standing_in_the_room_and_a_bad_wire_costs_time_only(
    ready: Ready, text: str, wire: Disturbance | None
) -> None:
    world = ready(seed=2, start=BY_THE_DOOR)
    if wire is not None:
        world.disturb(wire)
    goal = world.say(text)
    world.run_until(lambda _: goal.has_ended, LIMIT_S)
    assert stands(goal, GoalState.SUCCEEDED)
    assert inside(world, "living_room")
    assert world.standing
    outcome = known(goal.record.outcome)
    assert known(outcome.reached).room == "living_room"
    assert known(outcome.metres) > 1.0
    assert world.contacts == 0


def test_several_steps_and_back_visit_each_place_and_end_where_it_began(ready: Ready) -> None:
    world = ready(seed=2, start=BY_THE_DOOR)
    began = world.truth
    visited: list[str] = []
    goal = world.say("go to the living room, then the kitchen, then come back")

    def done(w: LockstepWorld) -> bool:
        room = w.room
        if room is not None and (not visited or visited[-1] != room):
            visited.append(room)
        return goal.has_ended

    world.run_until(done, 2 * LIMIT_S)
    assert stands(goal, GoalState.SUCCEEDED)
    assert visited == ["kitchen", "living_room", "kitchen"]
    assert_within_limits(world)
    assert hypot(world.truth.x_m - began.x_m, world.truth.y_m - began.y_m) < 0.25
    assert world.contacts == 0


def test_a_stop_holds_until_a_person_acts(off: Driving) -> None:
    world, goal = off()
    request = world.stop()
    world.run_until(lambda w: w.standing and request.answer is not None, 3.0)
    assert stands(goal, GoalState.PAUSED)
    stood = world.truth
    world.run(2.0)
    assert hypot(world.truth.x_m - stood.x_m, world.truth.y_m - stood.y_m) < 0.01
    assert world.status.held is not None
    world.resume(goal)
    world.run_until(driving, LIMIT_S)


@pytest.mark.parametrize("phase", [0, 3])
@pytest.mark.parametrize("way", ["kill", "freeze"])
def test_a_silent_brain_is_held_within_31_ticks_of_its_last_echo(
    off: Driving, way: str, phase: int
) -> None:
    world, _ = off()
    world.run(phase * TICK_S)
    world.kill_planner() if way == "kill" else world.freeze_planner()
    world.run_until(lambda w: w.bridge.state.mode is Mode.STOPPING, 1.0)
    echoed_s = known(world.bridge.state.ownership.echo_s)
    assert round((world.now_s - echoed_s) / TICK_S) <= HOLD2_TICKS
    world.run_until(lambda w: w.standing, 3.0)
    assert world.contacts == 0


def test_after_a_kill_nothing_moves_until_a_person_resumes(off: Driving) -> None:
    world, goal = off()
    world.kill_planner()
    world.run_until(lambda w: w.standing, 3.0)
    world.start_planner()
    stood = world.truth
    world.run(2.0)
    assert stands(goal, GoalState.PAUSED)
    assert goal.record.reason == "planner_restarted"
    assert hypot(world.truth.x_m - stood.x_m, world.truth.y_m - stood.y_m) < 0.01
    world.resume(goal)
    world.run_until(driving, LIMIT_S)


def test_a_short_freeze_goes_on_by_itself_and_obeys_nothing_from_before(off: Driving) -> None:
    world, goal = off()
    before = world.status.epoch
    tick = world.tick_count
    world.at(tick + 1, lambda w: w.freeze_planner())
    world.at(tick + 101, lambda w: w.thaw_planner())
    world.run(0.5)
    assert world.status.epoch != before
    world.run_until(lambda _: goal.has_ended, LIMIT_S)
    assert stands(goal, GoalState.SUCCEEDED)


def test_what_is_put_in_the_way_is_not_touched(off: Driving) -> None:
    world, goal = off()
    # Right in the doorway, the only way there is.
    world.place_obstacle(1.5, 3.0)
    world.run_until(lambda w: w.standing and w.status.blocked, 15.0)
    world.run(2.0)
    assert world.contacts == 0
    world.remove_obstacle()
    world.run_until(lambda _: goal.has_ended, LIMIT_S)
    assert stands(goal, GoalState.SUCCEEDED)
    assert world.contacts == 0


def test_carrying_the_robot_away_stops_it_first(off: Driving) -> None:
    world, goal = off()
    world.teleport(Pose2(1.5, 1.9, 0.0))
    world.run_until(lambda w: any(row.row == "POSE_JUMP" for row in w.status.rows), 1.0)
    world.run_until(lambda _: goal.has_ended, LIMIT_S)
    assert stands(goal, GoalState.SUCCEEDED)
    assert inside(world, "living_room")
    assert world.contacts == 0


def drive(seed: int) -> list[tuple[float, float] | None]:
    world = LockstepWorld(seed=seed)
    world.say("go to the living room")
    world.run(3.0)
    return [(c.left_radps, c.right_radps) if c is not None else None for c in world.commands]


def test_the_same_seed_gives_the_same_commands_and_another_does_not() -> None:
    first, again, other = drive(11), drive(11), drive(12)
    assert first == again
    assert first != other


STANDS_WITHIN_S = 3.0


@given(st.data())
@settings(
    max_examples=max(12, settings().max_examples // 4),
    suppress_health_check=[HealthCheck.function_scoped_fixture],
    deadline=None,
)
def test_no_sentence_with_a_stop_word_leaves_the_robot_driving(
    off: Driving, data: st.DataObject
) -> None:
    world, goal = off()
    text = data.draw(english() | chinese())
    said = world.say(text)
    world.run_until(lambda w: w.standing, STANDS_WITHIN_S)
    assert world.status.held is not None, text
    assert goal.state is GoalState.PAUSED, text
    world.run(1.0)
    assert world.standing, text
    assert said.state in {GoalState.SUCCEEDED, GoalState.AWAITING_CONFIRMATION}, text


def test_words_that_make_no_plan_leave_the_hold_of_a_stop(off: Driving) -> None:
    world, goal = off()
    world.say("停")
    world.run_until(lambda w: w.standing and w.status.held is not None, STANDS_WITHIN_S)
    for text in ("emergency brake", "what is that?", "frobnicate", "don't go away", "你好"):
        world.say(text)
        world.run(0.5)
        assert world.status.held is not None, text
        assert world.standing, text
    assert goal.state is GoalState.PAUSED
    again = world.say("go to the living room")
    world.run_until(lambda w: w.status.held is None and not w.standing, 10.0)
    assert again.state is GoalState.RUNNING


def test_slow_down_halves_the_cap_of_what_runs(off: Driving) -> None:
    world, goal = off()
    world.run(3.0)
    before_mps = abs(world.status.measured.v_mps)
    said = world.say("slow down please")
    world.run(2.0)
    assert said.state is GoalState.SUCCEEDED
    assert goal.state is GoalState.RUNNING
    waypoints = world.planner.book.missions[goal.id].speed_share
    assert waypoints == 0.5
    assert abs(world.status.measured.v_mps) <= 0.5 * 0.5 + 0.02 < before_mps


NOTICED = {
    "drive_deaf": "DRIVER_NACK.0",
    "drive_off": "ENC_STALE.0",
    "encoder_stuck": "POSE_JUMP.0",
    "encoder_garbage": "RUNAWAY.0",
    "encoder_delayed": "ENC_STALE.0",
    "encoder_intermittent": "ENC_STALE.0",
    "lidar_off": "LIDAR_STALE.0",
    "lidar_stuck": "LIDAR_STALE.0",
    "lidar_blind": "LIDAR_BLIND.0",
    "lidar_sector": "LIDAR_SECTOR.0",
    "lidar_garbage": "gate obstacle",
    "lidar_delayed": "LIDAR_STALE.0",
    "lidar_intermittent": "LIDAR_STALE.0",
    "gyro_off": "YAW_DISAGREE.0",
    "gyro_stuck": "YAW_DISAGREE.0",
    "gyro_garbage": "YAW_DISAGREE.0",
    "gyro_delayed": "YAW_DISAGREE.0",
    "wheel_stuck": "STUCK.0",
    "runaway": "RUNAWAY.0",
    "reversed": "RUNAWAY.0",
    "battery_low": "BATTERY.0",
    "battery_sag": "BATTERY.0",
    "bumper_front": "gate contact",
    "cliff": "gate contact",
    "estop_pressed": "ESTOP.0",
}
UNNOTICED = {
    "gyro_intermittent": "no reading is older than 0.25 s for long enough",
    "slip": "at speed, wheels on ice go on as they were told",
    "bumper_rear": "the robot drives away from it, slowly",
}
UNHEARD = {fault for fault in SimFault if fault.startswith("camera_")}
"""The bridge has no link to the camera: what a picture shows can neither stop nor move it."""
SLOWS_ONLY = {"gyro_off", "gyro_stuck", "gyro_garbage", "gyro_delayed", "battery_low"}

SLOW_TO_STAND = {"encoder_stuck"}
"""Frozen at nearly what is meant, encoders show where the robot turns, or gets nowhere in 5 s."""


def test_every_fault_is_told_of_here() -> None:
    assert NOTICED.keys() | UNNOTICED.keys() | UNHEARD == set(SimFault)


@pytest.mark.parametrize("name", NOTICED)
def test_a_broken_thing_is_noticed_by_its_row(name: str) -> None:
    watch_s = 7.0 if name in SLOW_TO_STAND else 3.5
    result = trial(SimFault(name), 1, watch_s=watch_s, after_s=watch_s if watch_s > 4.0 else 2.0)
    assert result.first == NOTICED[name]
    assert (result.stood_ticks is not None) is (name not in SLOWS_ONLY)
    assert result.contacts == 0


@pytest.mark.parametrize("name", UNNOTICED)
def test_what_does_no_harm_stops_nobody(name: str) -> None:
    result = trial(SimFault(name), 1, watch_s=2.0)
    assert (result.first, result.contacts) == ("", 0)
