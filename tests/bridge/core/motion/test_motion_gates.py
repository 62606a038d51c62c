"""Hold what the gates let through, when they call it blocked, and what ends that."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest

from bridge.core.geometry.fence import build_fence
from bridge.core.geometry.kinematics import scale_twist
from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.geometry.stopping import reaction_s
from bridge.core.motion.motion_gates import (
    _inside_fence,
    _note,
    _shut,
    apply,
    fence_scale,
    look,
    reconsider,
    scan_age_s,
)
from bridge.core.sensing.sensor_update import look_m
from bridge.core.state_motion import Gate, Learnt
from bridge.core.tick_context import TickContext
from tests.bridge.core.fake_planner import MAP_ID
from tests.bridge.core.reached import at, reached
from tests.bridge.core.scripted import ROBOT
from tests.bridge.core.table import table
from wire import STILL, Mode, Pose2, Twist2

EPS = 1e-6
AHEAD = Twist2(0.5, 0.0)


def driving(ranges_m: float | None = 3.0, *, start: str = "active", **drive: bool) -> TickContext:
    """Return a tick with a scan that shows the same distance all around, taken here and now."""
    tick = at(start)
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
        (True, "active", Gate(-0.3, 0.3), 0.05, Gate(-0.3, 0.01)),
        (True, "active", Gate(-0.3, 0.3), -0.05, Gate(-0.3, 0.01)),
        (True, "active", Gate(None, 0.3), 0.0, Gate(0.0, 0.31)),
        (True, "active", Gate(-0.5, 0.49 - EPS), 0.0, Gate(-0.5, 0.5 - EPS)),
        (True, "active", Gate(None, 0.49), 0.0, Gate(blocked=True, by="fence")),
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
    tick.s.odometry = replace(tick.s.odometry, base_in_odom=Pose2(0.0, 0.0, turned_rad))

    def dated(gate: Gate, heading_rad: float) -> Gate:
        since_s = None if gate.shut_since_s is None else tick.now_s + gate.shut_since_s
        return replace(gate, shut_since_s=since_s, shut_yaw_rad=heading_rad)

    tick.s.gate = dated(before, 0.0)
    _note(tick, "fence" if shut else "")
    began = after.shut_s == 0.01
    expected = dated(after, turned_rad if began else 0.0)
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


@table("learnt", [Learnt(), Learnt(lag_more_s=0.2, decel_share=0.5)])
@table("start", ["active", "teleop"])
@table("v_mps", [0.4, 0.1, -0.4])
def test_the_fence_counts_what_was_learnt_of_the_brakes(
    learnt: Learnt, start: str, v_mps: float
) -> None:
    tick = at(start)
    edge_m = reached(start).here.x_m + 0.16
    square = ((-5.0, -5.0), (edge_m, -5.0), (edge_m, 5.0), (-5.0, 5.0))
    fence = build_fence(MAP_ID, (square,))
    tick.config, tick.robot_in_map = replace(tick.config, fence=fence), reached(start).here
    tick.s.learnt, tick.s.motion.bound_by = learnt, "robot"
    twist = Twist2(v_mps, 0.0)
    reaction = reaction_s(0.0, 0.1, ROBOT.drive.lag_s + learnt.lag_more_s, ROBOT.limits)
    scale = fence_scale(
        fence, reached(start).here, twist, ROBOT.base, ROBOT.limits, reaction, learnt.decel_share
    )
    if scale < 1.0 and start == "teleop":
        scale = max(scale, min(1.0, 0.2 / abs(v_mps)))
    assert _inside_fence(tick, twist) == scale_twist(twist, scale)
    assert tick.s.motion.bound_by == ("robot" if v_mps < 0.0 else "fence")
    tick.config = replace(tick.config, fence=None)
    assert _inside_fence(tick, twist) is twist


@table("start", ["active", "active_external", "teleop"])
def test_where_the_fence_is_cannot_be_told_without_a_pose_so_a_hand_alone_passes(
    start: str,
) -> None:
    """No row is up here: the gate asks none."""
    tick = at(start)
    tick.robot_in_map, tick.s.motion.bound_by = None, "robot"
    passes = start == "teleop"
    assert _inside_fence(tick, AHEAD) == (AHEAD if passes else STILL)
    assert tick.s.motion.bound_by == ("robot" if passes else "pose_lost")
    tick.config = replace(tick.config, fence=None)
    assert _inside_fence(tick, AHEAD) is AHEAD


@table("start", ["active", "active_external", "teleop"])
@table("v_mps", [0.4, -0.4])
def test_further_outside_than_the_fence_is_known_a_hand_alone_moves_it(
    start: str, v_mps: float
) -> None:
    """Inward or not: how far it is to the fence is told up to 1 m, so no gain can be shown."""
    tick, far = at(start), Pose2(3.0, 0.0, pi)
    fence = build_fence(MAP_ID, (((-5.0, -5.0), (1.5, -5.0), (1.5, 5.0), (-5.0, 5.0)),))
    tick.config, tick.robot_in_map = replace(tick.config, fence=fence), far
    passed = 0.2 if start == "teleop" else 0.0
    assert abs(_inside_fence(tick, Twist2(v_mps, 0.0)).v_mps) == pytest.approx(passed)
    tick.robot_in_map = Pose2(2.4, 0.0, pi)
    inward = passed if passed or v_mps < 0.0 else 0.15
    assert abs(_inside_fence(tick, Twist2(v_mps, 0.0)).v_mps) == pytest.approx(inward)


@table(
    ("start", "margins_m", "said"),
    [
        ("teleop", (0.3, 0.05, 1e-9), 0),
        ("teleop", (0.3, 0.05, -1e-3), 1),
        ("teleop", (-1e-3, 0.02, -0.02, 0.14, -0.3, -1.0), 1),  # noise, and a hand to and fro
        ("teleop", (-1e-3, 0.16, -1e-3, 0.0, -1e-3), 2),
        ("active", (-1e-3, -0.02), 0),
    ],
)
def test_a_hand_that_crosses_the_fence_is_told_of_once_a_crossing(
    start: str, margins_m: tuple[float, ...], said: int
) -> None:
    tick = at(start)
    fence = build_fence(MAP_ID, (((-5.0, -5.0), (1.5, -5.0), (1.5, 5.0), (-5.0, 5.0)),))
    tick.config = replace(tick.config, fence=fence)
    for margin_m in margins_m:
        tick.robot_in_map = Pose2(1.5 - margin_m, 0.0, 0.0)
        _inside_fence(tick, AHEAD)
    assert [code for code, _ in tick.events] == ["outside_fence"] * said


def test_what_a_hand_took_out_and_a_planner_brought_in_may_be_taken_out_anew() -> None:
    tick = at()
    tick.s.watch.outside = True
    tick.robot_in_map = Pose2(0.0, 0.0, 0.0)
    _inside_fence(tick, AHEAD)
    assert not tick.s.watch.outside


@pytest.mark.parametrize(
    ("asked", "passed", "shut"),
    [
        (Twist2(0.3, 0.0), Twist2(0.0, 0.0), True),
        (Twist2(0.3, 0.5), Twist2(0.0, 0.5), True),
        (Twist2(0.3, 0.0), Twist2(0.02, 0.0), False),
        (Twist2(-0.02, 0.0), Twist2(-0.0199, 0.0), True),
        (Twist2(-0.02, 0.0), Twist2(-0.02, 0.0), False),
        (Twist2(0.0, 0.5), Twist2(0.0, 0.0), True),
        (Twist2(0.0, -0.05), Twist2(0.0, 0.049), True),
        (Twist2(0.0, -0.5), Twist2(0.0, -0.05), False),
        (Twist2(0.0199, 0.049), Twist2(0.0, 0.0), False),
    ],
)
def test_a_way_is_shut_where_nothing_of_it_passes(
    asked: Twist2, passed: Twist2, shut: bool
) -> None:
    assert _shut(asked, passed) is shut


def test_a_hand_on_the_stick_crosses_the_fence_slowly() -> None:
    world = reached("teleop")
    edge_m = world.here.x_m + 0.4
    square = ((-5.0, -5.0), (edge_m, -5.0), (edge_m, 5.0), (-5.0, 5.0))
    world.core = replace(world.core, fence=build_fence(MAP_ID, (square,)))
    for _ in range(40):
        world.teleop(0.4, held=True)
        world.run(0.05)
    assert world.is_in(Mode.TELEOP)
    assert world.here.x_m > edge_m, "a person may"
    assert world.sent.v_mps == pytest.approx(0.2, abs=1e-6)
    assert world.state.motion.bound_by == "fence"


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
    assert look(tick, AHEAD) is None
    tick.s.lidar = replace(tick.s.lidar, newest=None)
    assert scan_age_s(tick) == 0.0
