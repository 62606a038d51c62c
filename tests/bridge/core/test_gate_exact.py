"""Hold what the gates let through, when they call it blocked, and what ends that."""

from __future__ import annotations

from dataclasses import replace

import pytest

from bridge.core.geometry.fence import build_fence
from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.motion.contact_gate import contact_gate
from bridge.core.motion.motion_gates import _note, _shut_by, apply, look, reconsider, scan_age_s
from bridge.core.sensing.look_distance import look_m
from bridge.core.state_motion import Gate
from bridge.core.tick_context import TickContext
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from tests.bridge.core.test_quick_core import ROBOT, tick_of
from wire import STILL, Mode, Pose2, Twist2

EPS = 1e-6
AHEAD = Twist2(0.5, 0.0)


def driving(ranges_m: float | None = 3.0, *, start: str = "active", **drive: bool) -> TickContext:
    """Return a tick with a scan that shows the same distance all around, taken here and now."""
    tick = tick_of(reached(start))
    scan = tick.s.lidar.newest
    assert scan is not None
    scan = scan.model_copy(
        update={"ranges_m": (ranges_m,) * len(scan.ranges_m), "stamp_s": tick.now_s}
    )
    picture = ScanPicture.from_scan(scan, tick.s.odometry.base_in_odom, ROBOT.lidar)
    tick.s.lidar = replace(tick.s.lidar, newest=scan, picture=picture, received_s=tick.now_s)
    state = tick.s.drive.newest
    assert state is not None
    tick.s.drive.newest = state.model_copy(update=drive)
    tick.robot_in_map = Pose2(0.0, 0.0, 0.0)
    tick.s.motion.bound_by, tick.s.motion.free_m, tick.room_m = "robot", 9.0, 9.0
    tick.s.gate = Gate(shut_since_s=1.0)
    return tick


def test_standstill_passes_and_forgets() -> None:
    tick = driving()
    assert apply(tick, STILL) == STILL
    assert (tick.s.motion.free_m, tick.room_m, tick.s.gate) == (None, None, Gate())


def test_without_a_scan_nothing_passes() -> None:
    tick = driving()
    tick.s.lidar = replace(tick.s.lidar, picture=None)
    tick.s.gate = Gate()
    assert apply(tick, AHEAD) == STILL
    assert (tick.s.motion.bound_by, tick.s.gate.shut_since_s) == ("no_scan", tick.now_s)
    assert (tick.s.motion.free_m, tick.room_m) == (None, None)


def test_a_free_way_passes_whole() -> None:
    tick = driving()
    assert apply(tick, AHEAD) == AHEAD
    assert tick.s.motion.bound_by == "robot"
    assert tick.s.gate.shut_since_s is None
    assert tick.s.motion.free_m == look_m(ROBOT)
    assert tick.room_m is not None
    assert tick.room_m == pytest.approx(
        tick.s.motion.free_m - tick.s.odometry.measured.v_mps * ROBOT.drive.lag_s
    )


@table("v_mps", [0.5, -0.5])
def test_a_near_thing_slows(v_mps: float) -> None:
    tick = driving(0.45)
    passed = apply(tick, Twist2(v_mps, 0.0))
    assert 0.02 <= passed.v_mps / v_mps * 0.5 < 0.45
    assert tick.s.motion.bound_by == "obstacle"
    assert tick.s.gate.shut_since_s is None


def test_a_thing_too_near_shuts() -> None:
    tick = driving(ROBOT.base.radius_m + 0.03)
    tick.s.gate = Gate()
    assert apply(tick, AHEAD).v_mps == 0.0
    assert (tick.s.motion.bound_by, tick.s.gate.shut_since_s) == ("obstacle", tick.now_s)


@table(
    ("asked", "passed", "by"),
    [
        (AHEAD, Twist2(0.2, 0.0), "unseen"),
        (Twist2(-0.4, 0.2), Twist2(-0.2, 0.1), "unseen"),
        (Twist2(0.2, 0.0), Twist2(0.2, 0.0), "robot"),
        (Twist2(0.0, 0.5), Twist2(0.0, 0.5), "robot"),
    ],
)
def test_where_nothing_comes_back_speed_is_capped(asked: Twist2, passed: Twist2, by: str) -> None:
    tick = driving(None)
    got = apply(tick, asked)
    assert (got.v_mps, got.w_radps) == pytest.approx((passed.v_mps, passed.w_radps))
    assert tick.s.motion.bound_by == by


def test_a_pressed_bumper_shuts() -> None:
    tick = driving(bumper_front=True)
    tick.s.gate = Gate()
    assert apply(tick, AHEAD) == STILL
    assert (tick.s.motion.bound_by, tick.s.gate.shut_since_s) == ("contact", tick.now_s)


@table(
    ("seen", "inside", "felt", "gate"),
    [
        (AHEAD, AHEAD, AHEAD, ""),
        (AHEAD, AHEAD, STILL, "contact"),
        (AHEAD, STILL, STILL, "fence"),
        (STILL, STILL, STILL, "obstacle"),
        (Twist2(0.0, 0.3), Twist2(0.0, 0.3), Twist2(0.0, 0.2), "obstacle"),
    ],
)
def test_the_first_gate_that_leaves_no_way_has_shut_it(
    seen: Twist2, inside: Twist2, felt: Twist2, gate: str
) -> None:
    assert _shut_by(AHEAD, seen, inside, felt) == gate


@table(
    ("shut", "start", "before", "turned_rad", "after"),
    [
        (False, "active", Gate(-0.1, 0.2, free_scans=2), 0.0, Gate(None, 0.1975, free_scans=2)),
        (False, "active", Gate(None, 0.001), 0.0, Gate()),
        (False, "active", Gate(), 0.0, Gate()),
        (False, "active", Gate(-0.1, 0.0), 0.0, Gate()),
        (False, "active", Gate(None, 0.2), 0.3, Gate(None, 0.1975)),
        (True, "active", Gate(), 0.3, Gate(0.0, 0.01)),
        (True, "active", Gate(-0.3, 0.3), 0.05 - EPS, Gate(-0.3, 0.31)),
        (True, "active", Gate(-0.3, 0.3), 0.05 + EPS, Gate(-0.3, 0.01)),
        (True, "active", Gate(-0.3, 0.3), -0.05 - EPS, Gate(-0.3, 0.01)),
        (True, "active", Gate(None, 0.3), 0.0, Gate(0.0, 0.31)),
        (True, "active", Gate(-0.5, 0.49 - EPS), 0.0, Gate(-0.5, 0.5 - EPS)),
        (True, "active", Gate(None, 0.49 + EPS), 0.0, Gate(blocked=True, by="fence")),
        (False, "active", Gate(-0.5, 0.5), 0.0, Gate(None, 0.4975)),
        (True, "teleop", Gate(-0.6, 0.5), 0.0, Gate(-0.6, 0.5)),
        (True, "active", Gate(-0.6, 0.5, blocked=True), 0.0, Gate(-0.6, 0.5, blocked=True)),
    ],
)
def test_shut_for_half_a_second_without_turning_away_is_blocked(
    shut: bool, start: str, before: Gate, turned_rad: float, after: Gate
) -> None:
    """Times are told from now, headings from the robot's."""
    tick = driving(start=start)
    yaw_rad = tick.s.odometry.base_in_odom.yaw_rad

    def dated(gate: Gate, heading_rad: float) -> Gate:
        since_s = None if gate.shut_since_s is None else tick.now_s + gate.shut_since_s
        return replace(gate, shut_since_s=since_s, shut_yaw_rad=heading_rad)

    tick.s.gate = dated(before, yaw_rad - turned_rad)
    _note(tick, "fence" if shut else "")
    began = after.shut_s == 0.01
    expected = dated(after, yaw_rad if began else yaw_rad - turned_rad)
    blocked = after.blocked and not before.blocked
    if blocked:
        expected = after
    got = tick.s.gate
    assert replace(got, shut_s=0.0) == replace(expected, shut_s=0.0)
    assert got.shut_s == pytest.approx(expected.shut_s, abs=EPS / 10)
    assert [code for code, _ in tick.events] == ["blocked"] * blocked


def test_a_tick_now_and_then_in_which_something_passes_opens_no_way() -> None:
    tick = driving()
    tick.s.gate = Gate()
    for index in range(200):
        _note(tick, "obstacle" if index % 2 else "")
    assert [code for code, _ in tick.events] == ["blocked"]
    tick = driving()
    tick.s.gate = Gate()
    for index in range(2000):
        _note(tick, "" if index % 6 else "obstacle")
    assert tick.events == [], "one tick in six passes for none"


@table(
    ("start", "before", "asked", "range_m", "bumper", "after"),
    [
        ("hold", Gate(blocked=True, free_scans=3), AHEAD, 3.0, False, 4),
        ("stopping_by_row", Gate(blocked=True, free_scans=3), AHEAD, 3.0, False, 4),
        ("active", Gate(blocked=True, free_scans=3), AHEAD, 3.0, False, 4),
        ("teleop", Gate(blocked=True, free_scans=3), AHEAD, 3.0, False, None),
        ("hold", Gate(blocked=False, free_scans=3), AHEAD, 3.0, False, None),
        ("hold", Gate(blocked=True, free_scans=3), AHEAD, 0.5, False, 0),
        ("hold", Gate(blocked=True, free_scans=3), AHEAD, 3.0, True, 0),
        ("hold", Gate(blocked=True, free_scans=3), Twist2(-0.5, 0.0), 3.0, True, 4),
        ("hold", Gate(blocked=True, free_scans=3), STILL, 3.0, False, 0),
    ],
)
def test_free_scans_are_counted_on_what_would_be_asked(
    start: str, before: Gate, asked: Twist2, range_m: float, bumper: bool, after: int | None
) -> None:
    tick = driving(range_m, start=start, bumper_front=bumper)
    tick.s.gate = before
    reconsider(tick, asked)
    if after is None:
        assert tick.s.gate == before
        return
    scan = tick.s.lidar.newest
    assert scan is not None
    assert tick.s.gate == Gate(blocked=True, free_scans=after, judged_scan=scan.seq)
    reconsider(tick, asked)
    assert tick.s.gate.free_scans == after, "the same scan counts once"


@table(("edge_m", "free"), [(0.18, 4), (0.151, 0)])
def test_a_scan_is_free_where_the_fence_leaves_of_the_wish_what_is_a_speed(
    edge_m: float, free: int
) -> None:
    """More than the robot can do is no wish: of 9 m/s nothing would be left in either case."""
    tick = driving(start="hold")
    square = ((-5.0, -5.0), (edge_m, -5.0), (edge_m, 5.0), (-5.0, 5.0))
    tick.config = replace(tick.config, fence=build_fence(MAP_ID, (square,)))
    tick.s.gate = Gate(blocked=True, free_scans=3)
    reconsider(tick, Twist2(9.0, 0.0))
    assert tick.s.gate.free_scans == free


def test_five_free_scans_end_a_block() -> None:
    tick = driving(start="hold")
    tick.s.gate = Gate(blocked=True, free_scans=4)
    reconsider(tick, AHEAD)
    assert tick.s.gate == Gate()
    assert tick.events == [("unblocked", "")]


def test_a_scan_is_as_old_as_its_row_judges() -> None:
    tick = driving()
    tick.now_s += 0.07
    assert scan_age_s(tick) == pytest.approx(0.07)
    scan = tick.s.lidar.newest
    assert scan is not None
    tick.s.lidar = replace(
        tick.s.lidar, newest=scan.model_copy(update={"stamp_s": tick.now_s - 0.2})
    )
    assert scan_age_s(tick) == pytest.approx(0.2)
    tick.inbox = replace(tick.inbox, sensors_same_host=False)
    assert scan_age_s(tick) == pytest.approx(0.07)
    tick.now_s -= 1.0
    assert scan_age_s(tick) == 0.0
    free = look(tick, AHEAD)
    assert free is not None
    assert free.s_m == look_m(ROBOT)
    assert tick.s.mode is Mode.ACTIVE


@table(
    ("asked", "passed"),
    [
        (Twist2(-0.05, 0.1), Twist2(-0.05, 0.1)),
        (Twist2(-0.2, 0.0), Twist2(-0.1, 0.0)),
        (Twist2(-0.2, 0.2), Twist2(-0.1, 0.1)),
        (Twist2(-0.1, 0.6), Twist2(-0.05, 0.3)),
        (Twist2(0.0, 0.1), Twist2(0.0, 0.1)),
        (Twist2(0.0, -0.6), Twist2(0.0, -0.3)),
        (STILL, STILL),
    ],
)
def test_away_from_a_contact_one_creeps(asked: Twist2, passed: Twist2) -> None:
    state = driving(bumper_front=True).s.drive.newest
    got = contact_gate(state, asked)
    assert (got.v_mps, got.w_radps) == pytest.approx((passed.v_mps, passed.w_radps))
