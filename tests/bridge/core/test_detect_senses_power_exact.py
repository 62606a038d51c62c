"""Hold what is said of lidar, pose, drive, buttons and battery to its numbers, by single calls."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.faults import detectors
from bridge.core.motion import wheel_command
from bridge.core.motion.wheel_command import limit
from bridge.core.sensing.stop_inputs import note_pressed
from bridge.core.state import RowUp
from bridge.core.state_motion import AT_REST, LimiterState
from bridge.core.tick_context import TickContext
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import tick_of
from wire import STILL, Mode, Twist2

EPS = 1e-6
NOW_S = 100.0


def at(start: str = "active") -> TickContext:
    tick = tick_of(reached(start))
    tick.now_s = NOW_S
    return tick


def seen(detector: str, tick: TickContext) -> list[str]:
    dirty: list[tuple[str, str]] = []
    getattr(detectors, detector)(tick, dirty)
    return [name for name, _ in dirty]


@table(
    ("age_s", "equal", "moved_m", "up_s", "stages"),
    [
        (0.25, 1, 9.0, None, 0), (0.25 + EPS, 1, 0.0, None, 1), (0.25 + EPS, 1, 0.0, 5.0, 2),
        (0.25 + EPS, 1, 0.0, 5.0 - EPS, 1), (0.0, 5, 0.02 + EPS, None, 1),
        (0.0, 4, 9.0, None, 0), (0.0, 5, 0.02 - EPS, None, 0), (0.0, 6, 0.5, 5.0, 2),
        (0.0, 1, 0.0, 9.0, 0),
    ],
)  # fmt: skip
def test_a_scan_is_old_or_the_same_again(
    age_s: float, equal: int, moved_m: float, up_s: float | None, stages: int
) -> None:
    tick = at()
    scan = tick.s.lidar.newest
    assert scan is not None
    newest = scan.model_copy(update={"stamp_s": NOW_S})
    tick.s.odometry = replace(tick.s.odometry, travelled_m=30.0)
    tick.s.lidar = replace(
        tick.s.lidar, newest=newest, received_s=NOW_S - age_s, equal=equal,
        equal_from_m=30.0 - moved_m,
    )  # fmt: skip
    tick.s.rows = {} if up_s is None else {"LIDAR_STALE.0": RowUp(NOW_S - up_s, NOW_S, "old")}
    assert seen("lidar", tick) == ["LIDAR_STALE.0", "LIDAR_STALE.1"][:stages]


def test_a_scan_five_times_over_exactly_2_cm_is_a_frozen_lidar() -> None:
    tick = at()
    tick.s.odometry = replace(tick.s.odometry, travelled_m=0.02)
    tick.s.lidar = replace(tick.s.lidar, received_s=NOW_S, equal=5, equal_from_m=0.0)
    tick.inbox = replace(tick.inbox, sensors_same_host=False)
    assert seen("lidar", tick) == ["LIDAR_STALE.0"]


def test_a_pose_is_lost_or_jumps() -> None:
    tick = at()
    assert seen("pose", tick) == ["POSE_LOST.0", "POSE_LOST.1"], "the tick has not looked for it"
    tick.robot_in_map = tick.s.odometry.base_in_odom
    assert seen("pose", tick) == []
    tick.s.pose = replace(tick.s.pose, jumped_s=NOW_S)
    assert seen("pose", tick) == ["POSE_JUMP.0"]
    tick.s.pose = replace(tick.s.pose, jumped_s=NOW_S - 0.01)
    assert seen("pose", tick) == []


@table(
    ("age_s", "behind", "reborn_s", "rows"),
    [
        (0.0, 0, None, []),
        (0.08 - EPS, 10, 99.99, []),
        (0.08 + EPS, 11, None, ["ENC_STALE.0", "DRIVER_NACK.0"]),
        (0.25, 0, None, ["ENC_STALE.0"]),
        (0.25 + EPS, 50, None, ["ENC_STALE.0", "ENC_STALE.1", "DRIVER_NACK.0"]),
        (0.0, 51, NOW_S, ["DRIVER_NACK.0", "DRIVER_NACK.1", "DRIVE_REBOOT.0"]),
    ],
)
def test_a_drive_reports_and_hears(
    age_s: float, behind: int, reborn_s: float | None, rows: list[str]
) -> None:
    tick = at()
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"stamp_s": NOW_S})
    tick.s.drive.received_s, tick.s.drive.behind = NOW_S - age_s, behind
    tick.s.drive.reborn_s = reborn_s
    assert seen("drive", tick) == rows
    tick.s.drive.received_s = None
    assert seen("drive", tick) == []
    tick.s.drive.newest, tick.s.drive.received_s = None, 0.0
    assert seen("drive", tick) == []


def test_a_pressed_button_is_remembered_and_an_order_is_one_too() -> None:
    tick = at()
    assert seen("buttons", tick) == []
    assert tick.s.buttons.pressed_s is None
    tick.s.buttons = replace(tick.s.buttons, ordered=True)
    assert seen("buttons", tick) == ["ESTOP.0"]
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"estop_pressed": True})
    tick.s.buttons = replace(tick.s.buttons, ordered=False)
    assert seen("buttons", tick) == ["ESTOP.0"]
    assert tick.s.buttons.pressed_s is None
    note_pressed(tick)
    pressed_s: float | None = tick.s.buttons.pressed_s
    assert pressed_s == NOW_S


@table(
    ("charge", "low_s", "empty_s", "after"),
    [
        (0.18, 0.0, 0.0, (0.01, 0.0)), (0.05, 0.0, 0.0, (0.01, 0.01)),
        (0.9, 0.5, 0.0, (0.4975, 0.0)), (0.9, 0.5, 0.5, (0.4975, 0.4975)),
        (0.22, 0.0, 0.0, (0.0, 0.0)), (0.9, 0.0, 0.0, (0.0, 0.0)),
        (0.9, 1.0, 1.0, (0.9975, 0.9975)),
    ],
)  # fmt: skip
def test_a_low_charge_fills_its_windows(
    charge: float, low_s: float, empty_s: float, after: tuple[float, float]
) -> None:
    tick = at()
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update={"battery": charge})
    tick.s.watch.low_s, tick.s.watch.empty_s = low_s, empty_s
    detectors.battery(tick, [])
    assert (tick.s.watch.low_s, tick.s.watch.empty_s) == pytest.approx(after)


def test_a_lidar_that_sees_again_drains_its_window_and_a_zone_left_is_none() -> None:
    tick = at()
    tick.s.watch.blind_s, tick.s.watch.zone_mps = 0.5, 0.2
    detectors.blind(tick, [])
    assert tick.s.watch.blind_s == pytest.approx(0.4975)
    for level_s, after_s in ((0.0, 0.0), (1.0, 0.9975)):
        tick.s.watch.blind_s = level_s
        detectors.blind(tick, [])
        assert tick.s.watch.blind_s == pytest.approx(after_s)
    detectors.zone(tick, [])
    zone_mps: float | None = tick.s.watch.zone_mps
    assert zone_mps is None


# What is sent ----------------------------------------------------------------------------------


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


@table("start", ["hold", "disarmed", "estopped", "fault", "stopping_by_row"])
def test_who_follows_nobody_wants_to_stand_and_is_at_no_end(start: str) -> None:
    assert wheel_command.requested_twist(at(start)) == (STILL, False)


def test_without_a_path_or_a_place_nothing_is_followed() -> None:
    tick = at()
    assert wheel_command.follow_horizon(tick) is None  # no place in this tick yet
    tick.robot_in_map = tick.s.odometry.base_in_odom
    answer = wheel_command.follow_horizon(tick)
    assert answer is not None
    assert answer.target != STILL
    tick.s.leg = replace(tick.s.leg, path=None)
    assert wheel_command.follow_horizon(tick) is None


@table(("start", "arrives"), [("teleop", False), ("active_external", False)])
def test_a_hand_and_another_brain_have_no_end(start: str, arrives: bool) -> None:
    assert wheel_command.requested_twist(at(start))[1] is arrives
    assert wheel_command.requested_twist(at(start))[0] != STILL


@table(
    ("what", "corrects"),
    [("nothing", True), ("disabled", False), ("timed_out", False), ("stale", False),
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
    changed = {"disabled": {"enabled": False}, "timed_out": {"timed_out": True}}.get(what, {})
    drive.newest = state.model_copy(update={"left_radps": 3.0, "right_radps": 3.5, **changed})
    tick.s.rows = {"ENC_STALE.0": RowUp(0.0, 0.0, "old")} if what == "stale" else {}
    if what == "silent":
        drive.received_s = NOW_S - 0.01
    if what == "absent":
        drive.newest = None
    motion.limiter = LimiterState(Twist2(0.4, 0.0))
    wheel = replace(AT_REST, told_radps=4.0, due_radps=4.0, expected_radps=4.0, push=0.25)
    motion.left = motion.right = wheel
    told = wheel_command.command(tick)
    assert tick.s.mode is Mode.ACTIVE
    if corrects is None:  # no reading in this tick: what was found before stays
        assert (motion.left.push, motion.right.push) == (0.25, 0.25)
    elif corrects:
        assert 0.25 < motion.right.push < motion.left.push
        assert told.left_radps > told.right_radps
    else:
        assert (motion.left.push, motion.right.push) == (0.0, 0.0)
