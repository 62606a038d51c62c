"""Play whole stories: the self test, a drive, and everything that may come between."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.geometry.fence import build_fence
from tests.bridge.core.fake_planner import MAP_ID, FakeDrive, FakePlanner
from tests.bridge.core.scripted import World, config
from wire import HeldReason, Mode, Pose2, RobotDescription, Waypoints


def test_a_sentence_worth_of_motion_ends_reached_and_standing() -> None:
    world = World().driving((2.0, 0.0))
    world.until(Mode.HOLD)
    world.run(0.1)
    assert world.shown.leg is not None
    assert world.shown.leg.reached
    assert world.shown.leg.residual_m <= 0.10
    assert abs(world.here.x_m - 2.0) <= 0.10
    assert world.sent.v_mps == 0.0
    assert "row_up" not in [e.code for e in world.events if e.mode is Mode.ACTIVE]


def test_reached_stays_until_the_next_leg() -> None:
    world = World().driving((1.0, 0.0))
    world.until(Mode.HOLD)
    world.run(1.0)
    assert world.state.leg.reached
    assert world.is_in(Mode.HOLD)
    world.brain.leg, world.brain.goal_m = 2, (2.0, 0.0)
    world.until(Mode.ACTIVE, 0.5)
    assert not world.state.leg.reached
    world.until(Mode.HOLD)
    assert world.state.leg.reached
    assert world.state.leg.leg == 2


def test_a_horizon_of_no_points_ramps_to_hold_without_a_row() -> None:
    world = World().driving()
    world.brain.goal_m = None
    seen = len(world.events)
    world.until(Mode.HOLD, 3.0)
    assert not [e for e in world.events[seen:] if e.code == "row_up"]
    assert not world.state.leg.reached


def test_the_self_test_withholds_commands_and_nothing_else_does() -> None:
    world = World(keep=True).ready()
    silent = [d for d in world.decisions if d.command is None]
    assert 15 <= len(silent) <= 40
    assert {d.state.mode for d in silent} == {Mode.SELFTEST}
    world.keep = False
    world.armed()


@pytest.mark.parametrize(
    ("name", "drive", "code"),
    [
        ("ignores its time-out", FakeDrive(never_times_out=True), "drive_no_timeout"),
        ("rolls by itself", FakeDrive(runs_on=True, speeds=(2.0, 2.0)), "encoders_moving"),
    ],
)
def test_what_is_wrong_is_a_fault(name: str, drive: FakeDrive, code: str) -> None:
    world = World(drive=drive)
    world.until(Mode.FAULT, 5.0)
    world.run(0.1)
    assert world.shown.waiting_for == (code,), name
    drive.never_times_out = drive.runs_on = False
    world.run(3.0)
    assert world.asked("reset") == "ok"
    assert world.is_in(Mode.SELFTEST)
    world.until(Mode.DISARMED)


def test_stop_holds_until_a_person_resumes() -> None:
    world = World().driving()
    epoch = world.state.epoch_no
    stop_id = world.stop()
    world.tick()
    assert world.is_in(Mode.STOPPING)
    assert world.state.epoch_no == epoch + 1
    assert world.state.held is not None
    assert world.state.held.reason is HeldReason.STOP
    world.until(Mode.HOLD, 2.0)
    world.run(3.0)
    assert world.is_in(Mode.HOLD)
    assert world.verdict(stop_id) == "ok"
    assert ("grant", "held") in {(a.kind, a.code) for a in world.shown.answers}
    assert world.asked("resume") == "ok"
    world.until(Mode.ACTIVE, 1.0)


def test_a_stop_wins_over_all_that_came_with_it() -> None:
    world = World().driving()
    world.stop()
    assert world.asked("resume") == "stopped"
    assert world.state.held is not None
    assert world.state.grants.mission is None
    assert world.is_in(Mode.STOPPING)


def test_a_short_silence_of_the_planner_goes_on_by_itself() -> None:
    world = World().driving()
    world.brain.silent = True
    world.run(1.0)
    assert world.mode in {Mode.STOPPING, Mode.HOLD}
    assert world.state.ownership.owner is None
    world.brain.silent = False
    world.until(Mode.ACTIVE, 1.0)
    assert world.state.held is None
    assert "BRAIN_LOST.0" not in world.rows()


def test_what_was_said_before_the_silence_is_not_obeyed() -> None:
    world = World(keep=True).driving()
    old: list[Waypoints] = [w for inbox, _ in world.inboxes for w in inbox.waypoints][-4:]
    world.brain.silent = True
    world.run(1.0)
    for seconds in (0.05, 0.05, 0.3):
        world.extra = replace(world.extra, waypoints=tuple(old))
        world.run(seconds)
        assert world.mode in {Mode.STOPPING, Mode.HOLD}
    assert world.sent.v_mps == 0.0


def test_another_planner_is_told_and_then_held() -> None:
    world = World().driving()
    other = FakePlanner(planner_id="p2")
    world.extra = replace(world.extra, hellos=(other.hello(world.shown),))
    world.tick()
    world.run(0.05)
    assert ("hello", "p2", "owner_alive") in {(a.kind, a.id, a.code) for a in world.shown.answers}
    world.brain.silent = True
    world.run(1.0)
    other.mission, other.goal_m = "m2", (4.0, 0.0)
    world.planner = other
    world.run(2.0)
    assert world.state.ownership.owner is not None
    assert world.state.ownership.owner.planner_id == "p2"
    assert world.state.held is not None
    assert world.state.held.reason is HeldReason.NEW_PLANNER
    assert world.is_in(Mode.HOLD)
    world.op("resume")
    world.until(Mode.ACTIVE, 1.0)


def test_a_jump_of_the_pose_needs_a_grant_that_knows_of_it() -> None:
    world = World().driving()
    world.odom_in_map = Pose2(0.0, 0.3, 0.0)
    world.until(Mode.STOPPING, 0.3)
    assert "POSE_JUMP.0" in world.rows()
    world.until(Mode.ACTIVE, 3.0)
    assert "POSE_JUMP.0" not in world.rows()


def test_teleop_takes_over_only_after_released_and_neutral() -> None:
    world = World().driving()
    world.teleop(0.3, held=True)
    world.tick()
    assert world.is_in(Mode.ACTIVE)
    world.teleop(0.0, held=False)
    world.tick()
    world.teleop(0.3, held=True)
    world.tick()
    assert world.is_in(Mode.TELEOP)
    for _ in range(40):
        world.run(0.05)
        world.teleop(0.3, held=True)
    assert world.is_in(Mode.TELEOP)
    assert 0.25 < world.sent.v_mps <= 0.3
    world.teleop(0.0, held=False)
    world.tick()
    assert world.is_in(Mode.HOLD)
    world.run(2.0)
    assert world.is_in(Mode.HOLD), "the planner stays held after a take-over"
    assert world.sent.v_mps == 0.0
    assert world.state.held is not None
    assert world.state.held.reason is HeldReason.TELEOP
    world.op("resume")
    world.until(Mode.ACTIVE, 1.0)


def test_an_obstacle_blocks_and_its_leaving_frees() -> None:
    world = World().driving((4.0, 0.0))
    world.obstacle_m = (3.0, 0.0, 0.3)
    world.run(12.0)
    assert world.is_in(Mode.HOLD)
    assert world.state.gate.blocked
    assert world.shown.blocked
    assert world.here.x_m < 3.0 - 0.3 - 0.3
    world.obstacle_m = None
    world.until(Mode.ACTIVE, 2.0)
    world.until(Mode.HOLD, 15.0)
    assert world.state.leg.reached


def test_a_turn_that_passes_beside_a_closed_way_is_no_way() -> None:
    world = World().driving((4.0, 0.3))
    world.obstacle_m = (3.0, 0.0, 0.5)
    world.run(12.0)
    assert world.is_in(Mode.HOLD)
    assert world.state.gate.blocked
    assert world.state.waits_since_s is not None


@pytest.mark.parametrize("away_m", [0.01, 0.5, 1.5])
def test_a_robot_outside_its_fence_is_said_and_a_stick_brings_it_in(away_m: float) -> None:
    outline = ((away_m, -1.0), (5.0, -1.0), (5.0, 1.0), (away_m, 1.0))
    world = World(core=replace(config(), fence=build_fence(MAP_ID, (outline,))), planner=None)
    world.ready()
    assert world.shown.waiting_for == ("fence_excludes_robot",)
    world.arm()
    world.run(0.2)
    assert world.shown.waiting_for == ("fence_excludes_robot",)
    assert world.is_in(Mode.HOLD), "a stick needs torque"
    world.teleop(held=False)
    world.tick()
    for _ in range(round(2.0 * 100 + away_m / 0.15 * 100)):
        world.teleop(0.3, held=True)
        world.tick()
        assert world.sent.v_mps <= 0.2 or world.here.x_m > away_m
    assert world.here.x_m > away_m
    assert not world.shown.waiting_for


def test_a_robot_that_does_not_know_where_it_is_is_not_said_to_be_outside() -> None:
    outline = ((3.0, -1.0), (5.0, -1.0), (5.0, 1.0), (3.0, 1.0))
    core = replace(config(), fence=build_fence(MAP_ID, (outline,)))
    world = World(core=core, localization_silent=True).ready()
    assert world.shown.waiting_for == ()


def test_a_base_that_does_not_tell_its_time_out_is_never_left_in_silence_and_slow() -> None:
    ugv = RobotDescription.model_validate({"drive": {"kind": "waveshare", "port": "/dev/x"}})
    world = World(core=config(ugv), drive=FakeDrive(tells_time_out=False), real_time=True)
    while world.mode is not Mode.DISARMED:
        assert world.tick().command is not None
        assert world.ticks < 1_000
    world.arm().drive_to((4.0, 0.0))
    assert world.shown.drive.timed_out is None
    assert 0.25 < world.sent.v_mps <= 0.3
    tried = World(
        core=replace(config(ugv), dead_man_s=0.3),
        drive=FakeDrive(tells_time_out=False),
        real_time=True,
    )
    tried.until(Mode.DISARMED)
    assert tried.arm().drive_to((4.0, 0.0)).sent.v_mps > 0.3


def test_what_has_not_arrived_is_waited_for_by_name() -> None:
    world = World(lidar_silent=True, drive_silent=True, planner=None)
    world.run(1.0)
    assert world.is_in(Mode.SELFTEST)
    assert {"drive", "drive_echo", "lidar", "lidar_baseline"} <= set(world.shown.waiting_for)
    world.lidar_silent = world.drive_silent = False
    world.until(Mode.DISARMED, 5.0)
