"""Hold what the wheels are told: feed-forward, correction, torque, and what a mode follows."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.geometry.kinematics import wheels_of
from bridge.core.motion import wheel_command
from bridge.core.motion.pursuit import carry_over
from bridge.core.motion.wheel_command import limit
from bridge.core.state import RowUp
from bridge.core.state_motion import AT_REST, NEW, FollowState, LimiterState, Wheel
from bridge.core.tick_context import MOVING, TickContext
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.scripted import World, config
from tests.bridge.core.table import table
from wire import STILL, Mode, RobotDescription, Twist2


def test_the_dead_zone_is_fed_forward_once_and_not_remembered() -> None:
    described = RobotDescription()
    plain = {"kp": 0.0, "ki_per_s": 0.0, "response_s": 0.0}
    robot = described.model_copy(update={"drive": described.drive.model_copy(update=plain)})
    world = World(config(robot)).driving()
    world.run(1.0)
    meant = wheels_of(world.sent, robot.base)
    assert meant.left_radps > 0.0
    over = world.told.left_radps - meant.left_radps
    assert over == pytest.approx(robot.drive.dead_zone_radps)


@pytest.fixture
def world() -> World:
    """Drive on a motor without the dead zone that robot.toml states: there is much to learn."""
    world = reached("active")
    assert wheel(world).integral < -0.05
    return world


def wheel(world: World) -> Wheel:
    return world.state.motion.left


def told(world: World) -> float:
    return world.told.left_radps


def test_a_motor_unlike_its_description_turns_as_meant(world: World) -> None:
    meant = wheels_of(world.sent, world.core.robot.base)
    assert world.drive.speeds[0] == pytest.approx(meant.left_radps, abs=0.02)


def test_a_stop_forgets_what_was_learnt_and_only_falls(world: World) -> None:
    before = told(world)
    world.stop()
    while world.tick().state.mode is Mode.STOPPING:
        assert wheel(world).integral == 0.0
        assert wheel(world).push <= 0.0
        meant = abs(wheels_of(world.sent, world.core.robot.base).left_radps)
        assert 0.0 <= told(world) <= min(before, meant + world.core.robot.drive.dead_zone_radps)
        before = told(world)
    assert (told(world), wheel(world)) == (0.0, AT_REST)


@pytest.mark.parametrize("start", ["active", "teleop", "stopping_by_person", "stopping_by_row"])
def test_after_a_freeze_nothing_is_ramped_down(start: str) -> None:
    """A bridge that froze for 3 s once told a robot that stood to go on at 0.07 m/s."""
    timeout_s = RobotDescription().drive.timeout_s
    for gap_s, begins_anew in ((timeout_s - 0.001, False), (timeout_s + 0.001, True), (3.0, True)):
        world = reached(start)
        had = world.sent
        assert had.v_mps > 0.1
        for _ in range(round(gap_s / 0.01) - 1):
            world.drive.tick(world.now_s)
        decision = world.tick(gap_s)
        assert decision.command is not None
        if begins_anew:
            assert world.sent == STILL
            assert decision.command.left_radps == decision.command.right_radps == 0.0
            assert world.mode not in MOVING
        else:
            assert abs(world.sent.v_mps - had.v_mps) < 0.05


NOW_S = 100.0


def at(start: str = "active") -> TickContext:
    tick = tick_of(reached(start))
    tick.now_s = NOW_S
    return tick


@table(
    ("start", "powered"),
    [
        ("disarmed", False), ("estopped", False), ("fault", False), ("estopped_moving", True),
        ("hold", True), ("stopping_by_row", True), ("active", True),
    ],
)  # fmt: skip
def test_torque_is_on_where_it_may_move_or_has_to_stop(start: str, powered: bool) -> None:
    tick = at(start)
    tick.s.motion.free_m, tick.s.motion.cap = 9.0, 0.5
    tick.s.motion.bound_by = "robot"
    after = limit(tick, Twist2(0.3, 0.0))
    assert tick.s.motion.powered is powered
    if not powered:
        assert after == LimiterState()
        told: tuple[object, ...] = (tick.s.motion.free_m, tick.s.motion.bound_by, tick.s.motion.cap)
        assert told == (None, "unpowered", 0.0)


@table(("start", "arrives"), [("teleop", False), ("active_external", False)])
def test_a_hand_and_another_brain_have_no_end(start: str, arrives: bool) -> None:
    assert wheel_command.requested_twist(at(start))[1] is arrives
    assert wheel_command.requested_twist(at(start))[0] != STILL


@table(
    ("what", "corrects"),
    [("nothing", True), ("disabled", False), ("timed_out", False), ("unknown", True),
     ("stale", False),
     ("reborn", False), ("silent", None), ("absent", False)],
)  # fmt: skip
def test_wheels_are_corrected_by_readings_that_may_be_trusted(
    what: str, corrects: bool | None
) -> None:
    tick = at()
    motion, drive = tick.s.motion, tick.s.drive
    state = drive.newest
    assert state is not None
    drive.received_s, drive.reborn_s = NOW_S, NOW_S if what == "reborn" else None
    changes: dict[str, dict[str, bool | None]] = {
        "disabled": {"enabled": False}, "timed_out": {"timed_out": True},
        "unknown": {"timed_out": None},
    }  # fmt: skip
    changed = changes.get(what, {})
    drive.newest = state.model_copy(update={"left_radps": 3.0, "right_radps": 3.5, **changed})
    tick.s.rows = {"ENC_STALE.0": RowUp(0.0, 0.0, "old")} if what == "stale" else {}
    if what == "silent":
        drive.received_s = NOW_S - 0.01
    if what == "absent":
        drive.newest = None
    motion.limiter = LimiterState(Twist2(0.4, 0.0))
    wheel = replace(AT_REST, told_radps=4.0, due_radps=4.0, expected_radps=4.0, push=0.25)
    wheel = motion.left = motion.right = replace(wheel, integral=0.1)
    told = wheel_command.command(tick)
    assert tick.s.mode is Mode.ACTIVE
    if corrects is None:  # no reading in this tick: what was found before stays
        assert (motion.left.push, motion.right.push) == (0.25, 0.25)
    elif corrects:
        assert 0.25 < motion.right.push < motion.left.push
        assert told.left_radps > told.right_radps
    else:
        assert {(one.push, one.integral) for one in (motion.left, motion.right)} == {(0.0, 0.0)}
        assert told.left_radps > 0.0, "fed forward alone"


def test_without_a_way_there_is_no_end_and_a_way_is_followed_on() -> None:
    tick = at()
    assert wheel_command.requested_twist(tick) == (STILL, False)  # no place in this tick yet
    tick.robot_in_map = tick.s.odometry.base_in_odom
    answer = wheel_command.follow_horizon(tick)
    assert answer is not None
    tick.s.motion.follow = replace(answer.state, turning=not answer.state.turning)
    before = tick.s.motion.follow
    expected = wheel_command.follow_horizon(tick)
    assert expected is not None
    assert wheel_command.requested_twist(tick) == (expected.target, expected.at_end)
    assert tick.s.motion.follow == expected.state != before


@table(
    ("had", "mission", "leg", "goal", "follow"),
    [
        ("none", "m1", 0, True, "new"),
        ("other", "m2", 0, True, "new"),
        ("other", "m1", 1, True, "new"),
        ("other", "m1", 0, True, "carried"),
        ("other", "m1", 0, False, "turning"),
        ("same", "m1", 0, True, "kept"),
    ],
)
def test_what_was_learnt_on_a_leg_stays_while_it_is_the_same_leg(
    had: str, mission: str, leg: int, goal: bool, follow: str
) -> None:
    tick = at()
    now = tick.s.leg
    assert now.horizon is not None
    now = tick.s.leg = replace(now, mission="m1", leg=0, goal=now.horizon.points[-1])
    assert now.horizon is not None
    horizons = {"none": None, "other": now.horizon.model_copy(), "same": now.horizon}
    before = replace(
        now,
        horizon=horizons[had],
        mission=mission,
        leg=leg,
        goal=now.goal if goal else now.horizon.points[0],
    )
    learnt = tick.s.motion.follow = FollowState(
        along_m=1.0, turning=True, settled=True, heading_done=True, tries=2
    )
    assert carry_over(learnt) not in (NEW, learnt, replace(NEW, turning=True))
    wheel_command.take_horizon(tick, before)
    kept = {
        "new": NEW,
        "carried": carry_over(learnt),
        "turning": replace(NEW, turning=True),
        "kept": learnt,
    }
    assert tick.s.motion.follow == kept[follow]


@table(("more_s", "stands"), [(0.0, False), (1e-6, True)])
def test_a_gap_as_long_as_the_drives_time_out_forgets_nothing(more_s: float, stands: bool) -> None:
    tick = at()
    motion = tick.s.motion
    motion.limiter = LimiterState(Twist2(0.4, 0.0))
    motion.left = motion.right = replace(AT_REST, told_radps=4.0)
    tick.dt_s = tick.config.robot.drive.timeout_s + more_s
    wheel_command.forget_after_gap(tick)
    assert (motion.limiter == LimiterState()) is stands
    assert (motion.left == AT_REST) is stands
    assert (motion.right == AT_REST) is stands
