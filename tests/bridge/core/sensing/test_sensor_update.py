"""Hold what is taken over from each sensor, and what it is placed and aged by."""

from __future__ import annotations

from dataclasses import replace
from math import radians
from typing import Any

import pytest

from bridge.core.authority.epoch import revoke
from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.inbox import Inbox, LoopFacts
from bridge.core.sensing import sensor_update
from bridge.core.sensing.sensor_update import (
    DRIFT_M,
    DRIFT_RAD,
    SLIP_GAP_S,
    SLIP_RADPS,
    look_m,
    recorder_lack,
    sight_m,
)
from bridge.core.state_motion import Braking
from bridge.core.state_senses import Drift, LidarMemory, PoseMemory
from bridge.core.tick_context import TickContext
from tests.bridge.core.fake_planner import BOOT, MAP_ID
from tests.bridge.core.reached import reached, tick_of
from tests.bridge.core.table import table
from wire import IDENTITY, DriveState, Imu, Localization, Pose2, RobotDescription, Scan

NOW_S = 50.0
EPS = 1e-6
BASE = {"wheel_radius_m": 0.125, "wheel_separation_m": 0.5}
"""So that the very bounds of standing, 0.02 m/s and 0.05 rad/s, are speeds of these wheels."""
ROBOT = RobotDescription.model_validate({"base": BASE})


def at(start: str = "active", **inbox: Any) -> TickContext:
    tick = tick_of(reached(start))
    tick.now_s, tick.inbox = NOW_S, Inbox(**({"recorder_ok": True, "real_time": True} | inbox))
    tick.config = replace(tick.config, robot=ROBOT)
    return tick


def state_of(tick: TickContext, **change: Any) -> DriveState:
    newest = tick.s.drive.newest
    assert newest is not None
    return newest.model_copy(update={"seq": newest.seq + 1, "stamp_s": NOW_S} | change)


@table(
    ("boot_id", "later", "heard", "reborn"),
    [("d0", 1, True, False), ("d0", 0, False, False), ("d0", -1, False, False),
     ("d1", 1, True, True), ("d1", 0, True, True), ("d1", -9, True, True)],
)  # fmt: skip
def test_a_reading_counts_once_and_another_life_begins_anew(
    boot_id: str, later: int, heard: bool, reborn: bool
) -> None:
    tick = at()
    drive = tick.s.drive
    before, base = drive.newest, drive.behind_base
    assert before is not None
    drive.reborn_s, drive.received_s = 1.0, NOW_S - 0.1
    state = state_of(tick, boot_id=boot_id, seq=before.seq + later)
    tick.inbox = replace(tick.inbox, drive=(state,))
    sensor_update.sense(tick)
    assert drive.newest is (state if heard else before)
    assert drive.received_s == (NOW_S if heard else NOW_S - 0.1)
    assert drive.reborn_s == (NOW_S if reborn else 1.0)
    assert drive.behind_base == (tick.s.command_seq if reborn else base)
    assert tick.reasons == ([] if heard else ["drive_state_old"])


@table(
    ("echo_boot", "echo_seq", "base", "behind"),
    [(BOOT, 90, 0, 10), (BOOT, 100, 0, 0), (BOOT, 101, 0, 0), ("other", 99, 0, 100),
     (None, 99, 0, 100), (BOOT, 90, 95, 5), ("other", 99, 95, 5)],
)  # fmt: skip
def test_how_far_the_echo_lags(
    echo_boot: str | None, echo_seq: int, base: int, behind: int
) -> None:
    tick = at()
    tick.s.command_seq, tick.s.drive.behind_base, tick.s.drive.behind = 100, base, 77
    sensor_update._hear_drive(tick, state_of(tick, echo_boot=echo_boot, echo_seq=echo_seq))
    assert tick.s.drive.behind == behind


@table(
    ("left", "right", "stands"),
    [(0.0, 0.0, True), (0.15, 0.15, True), (0.16, 0.16, False), (-0.16, -0.16, False),
     (-0.09, 0.09, True), (-0.1, 0.1, False), (0.1, -0.1, False)],
)  # fmt: skip
def test_standing_and_moving_are_timed_from_when_they_began(
    left: float, right: float, stands: bool
) -> None:
    for still_s, moving_s in ((None, 3.0), (4.0, None), (None, None)):
        tick = at()
        tick.s.drive.still_since_s, tick.s.drive.moving_since_s = still_s, moving_s
        sensor_update._hear_drive(tick, state_of(tick, left_radps=left, right_radps=right))
        times = (tick.s.drive.still_since_s, tick.s.drive.moving_since_s)
        assert times == ((still_s or NOW_S, None) if stands else (None, moving_s or NOW_S))


@table(
    ("stamp_s", "same_host", "kept_s"),
    [(49.0, True, 49.0), (51.0, True, NOW_S), (49.0, False, NOW_S), (51.0, False, NOW_S)],
)
def test_a_trail_of_24_readings_says_where_the_robot_was(
    stamp_s: float, same_host: bool, kept_s: float
) -> None:
    tick = at(sensors_same_host=same_host)
    trail = tuple((float(i), Pose2(float(i), 0.0, 0.0)) for i in range(24))
    tick.s.trail = trail
    sensor_update._hear_drive(tick, state_of(tick, stamp_s=stamp_s))
    assert tick.s.trail == (*trail[1:], (kept_s, tick.s.odometry.base_in_odom))


@table(("at_s", "x_m"), [(3.0, 3.0), (3.5, 3.0), (9.0, 5.0), (2.0, 2.0), (1.0, 2.0), (5.0, 5.0)])
def test_a_scan_is_placed_where_it_was_taken(at_s: float, x_m: float) -> None:
    tick = at()
    tick.s.trail = tuple((float(i), Pose2(float(i), 0.0, 0.0)) for i in range(2, 6))
    assert sensor_update._place_at(tick, at_s).x_m == x_m
    tick.s.trail = ()
    assert sensor_update._place_at(tick, at_s) is tick.s.odometry.base_in_odom


def scan_of(tick: TickContext, **change: Any) -> Scan:
    newest = tick.s.lidar.newest
    assert newest is not None
    return newest.model_copy(update={"seq": newest.seq + 1, "stamp_s": 3.0} | change)


@table(("again", "equal", "from_m"), [(True, 4, 1.5), (False, 1, 7.0)])
def test_scans_that_are_the_same_again_are_counted(again: bool, equal: int, from_m: float) -> None:
    tick = at()
    scan = scan_of(tick)
    if not again:
        scan = scan.model_copy(update={"ranges_m": (1.0,) * len(scan.ranges_m)})
    tick.s.odometry = replace(tick.s.odometry, travelled_m=7.0)
    tick.s.lidar = replace(tick.s.lidar, equal=3, equal_from_m=1.5)
    sensor_update._hear_scan(tick, scan)
    assert (tick.s.lidar.equal, tick.s.lidar.equal_from_m) == (equal, from_m)


@table(
    ("had", "mean", "scans", "after"),
    [(0, 0.0, 1, 40.0), (3, 20.0, 4, 25.0), (19, 20.0, 20, 21.0), (20, 20.0, 20, 20.0)],
)
def test_what_is_normal_is_the_mean_of_the_first_20_scans(
    had: int, mean: float, scans: int, after: float
) -> None:
    tick = at()
    scan = scan_of(tick)
    count = len(scan.ranges_m)
    scan = scan.model_copy(update={"ranges_m": (2.0,) * 40 + (None,) * (count - 40)})
    tick.s.lidar = LidarMemory(baseline_scans=had, baseline_returns=mean)
    sensor_update._hear_scan(tick, scan)
    assert (tick.s.lidar.baseline_scans, tick.s.lidar.baseline_returns) == (scans, after)


@table(
    ("share", "beams", "teaches"),
    [(0.1, 360, True), (0.1 - 1 / 360, 360, False), (0.0, 360, False), (0.0, 0, False)],
)
def test_a_covered_lidar_teaches_nothing_of_what_is_normal(
    share: float, beams: int, teaches: bool
) -> None:
    tick = at()
    returned = round(share * beams)
    ranges = (2.0,) * returned + (None,) * (beams - returned)
    scan = scan_of(tick).model_copy(update={"ranges_m": ranges})
    tick.s.lidar = LidarMemory(baseline_scans=3, baseline_returns=300.0)
    assert (
        sensor_update.sees(ScanPicture.from_scan(scan, IDENTITY, tick.config.robot.lidar))
        is teaches
    )
    sensor_update._hear_scan(tick, scan)
    assert tick.s.lidar.baseline_scans == (4 if teaches else 3)
    assert tick.s.lidar.baseline_returns == (300.0 - 66.0 if teaches else 300.0)


def placed(**change: Any) -> Localization:
    said: dict[str, Any] = {"odom_id": BOOT, "map_id": MAP_ID, "seq": 1, "stamp_s": NOW_S}
    said |= {"odom_in_map": IDENTITY, "quality": 1.0}
    return Localization.model_construct(None, **(said | change))


@table(
    ("x_m", "y_m", "known"),
    [(1e4, -1e4, True), (-1e4, 1e4, True), (1e4 + 0.1, 0.0, False), (0.0, -1e4 - 0.1, False)],
)
def test_beyond_the_edge_of_the_world_is_no_place(x_m: float, y_m: float, known: bool) -> None:
    tick = at()
    tick.s.odometry = replace(tick.s.odometry, base_in_odom=IDENTITY)
    tick.s.pose = replace(
        tick.s.pose, localization=placed(odom_in_map=Pose2(x_m, y_m, 0.0)), received_s=NOW_S
    )
    sensor_update.locate(tick)
    assert tick.robot_in_map == (Pose2(x_m, y_m, 0.0) if known else None)


@table(
    ("now_s", "received_s", "quality", "trusted"),
    [(0.3, 0.0, 0.5, True), (0.3 + 1e-9, 0.0, 1.0, False), (0.3, 0.0, 0.5 - 1e-9, False),
     (0.3, None, 1.0, False)],
)  # fmt: skip
def test_a_pose_is_trusted_while_it_is_young_and_good(
    now_s: float, received_s: float | None, quality: float, trusted: bool
) -> None:
    tick = at()
    tick.now_s = now_s
    said = placed(quality=quality, stamp_s=0.0)
    tick.s.pose = replace(tick.s.pose, localization=said, received_s=received_s)
    assert (sensor_update.pose_trouble(tick) is None) is trusted
    tick.s.pose = replace(tick.s.pose, localization=None, received_s=0.0)
    assert sensor_update.pose_trouble(tick) is not None


def test_a_gyro_is_remembered_with_when_it_came() -> None:
    imu = Imu(boot_id="g0", seq=1, stamp_s=1.0, yaw_rate_radps=0.5, accel_x_mps2=0, accel_y_mps2=0)
    tick = at(imu=imu)
    before = tick.s.pose
    sensor_update.sense(tick)
    assert tick.s.pose == replace(before, imu=imu, imu_received_s=NOW_S)
    tick.inbox, after = Inbox(), tick.s.pose
    sensor_update.sense(tick)
    assert tick.s.pose is after


@table(
    ("number", "had", "now", "told"),
    [(1, True, False, []), (2, True, False, ["disk_full"]), (2, False, True, ["recorder_up"]),
     (2, True, True, []), (2, False, False, [])],
)  # fmt: skip
def test_recorder_and_rights_are_taken_over_and_a_change_is_told(
    number: int, had: bool, now: bool, told: list[str]
) -> None:
    for rights in (True, False):
        tick = at(recorder_ok=now, recorder_says="disk_full: none is left", real_time=rights)
        tick.s.tick = number
        tick.s.loop = replace(tick.s.loop, recorder_ok=had, real_time=True)
        sensor_update.sense(tick)
        assert (tick.s.loop.recorder_ok, tick.s.loop.real_time) == (now, rights)
        assert [code for code, _ in tick.events] == told


@table(
    ("change", "heard"),
    [({}, True), ({"odom_id": "b9"}, False), ({"map_id": "c" * 16}, False)],
)
def test_a_place_in_another_odom_or_map_is_none(change: dict[str, str], heard: bool) -> None:
    tick = at()
    before, new = tick.s.pose, placed(**change)
    sensor_update._hear_localization(tick, new)
    assert tick.s.pose == (
        replace(before, localization=new, received_s=NOW_S, good=new) if heard else before
    )  # fmt: skip
    assert tick.reasons == ([] if heard else ["localization_foreign"])


FIVE_RAD = radians(5.0)


@table(
    ("here", "old", "new", "quality", "jumps"),
    [
        # by how far, and by how much; exactly so far is no jump
        (IDENTITY, IDENTITY, Pose2(0.1, 0.0, 0.0), 1.0, False),
        (IDENTITY, IDENTITY, Pose2(0.0, -0.1 - EPS, 0.0), 1.0, True),
        (IDENTITY, IDENTITY, Pose2(0.0, 0.0, FIVE_RAD), 1.0, False),
        (IDENTITY, IDENTITY, Pose2(0.0, 0.0, -FIVE_RAD - EPS), 1.0, True),
        (Pose2(3.0, 4.0, 1.0), IDENTITY, Pose2(0.06, 0.06, 0.0), 1.0, False),
        (Pose2(3.0, 4.0, 1.0), IDENTITY, Pose2(0.08, 0.08, 0.0), 1.0, True),
        # ten metres off a hundredth of a turn is a tenth of a metre
        (Pose2(10.0, 0.0, 0.0), IDENTITY, Pose2(0.0, 0.0, 0.012), 1.0, True),
        (Pose2(10.0, 0.0, 0.0), IDENTITY, Pose2(0.0, -0.12, 0.012), 1.0, False),
        # a poor one displaces nobody, whatever it says
        (IDENTITY, IDENTITY, Pose2(2.0, 0.0, 0.0), 0.5, True),
        (IDENTITY, IDENTITY, Pose2(2.0, 0.0, 0.0), 0.5 - EPS, False),
        (IDENTITY, None, Pose2(2.0, 0.0, 0.0), 1.0, False),
    ],
)
def test_a_jump_takes_the_grant_and_the_way_and_is_told(
    here: Pose2, old: Pose2 | None, new: Pose2, quality: float, jumps: bool
) -> None:
    tick = at()
    last = None if old is None else placed(odom_in_map=old)
    poor = placed(odom_in_map=Pose2(9.0, 9.0, 1.0), quality=0.4)
    tick.s.pose = replace(tick.s.pose, localization=poor, good=last, jumped_s=1.0)
    tick.s.odometry = replace(tick.s.odometry, base_in_odom=here)
    granted, leg = tick.s.grants, tick.s.leg
    assert None not in (granted.mission, leg.horizon, leg.path)
    said = placed(odom_in_map=new, quality=quality)
    if sensor_update._hear_localization(tick, said):
        revoke(tick)
    assert tick.s.pose.good == (last if quality < 0.5 else said), "what is compared with next"
    assert tick.s.pose.jumped_s == (NOW_S if jumps else 1.0)
    assert tick.s.grants == (granted.return_budget() if jumps else granted)
    assert tick.s.leg == (replace(leg, horizon=None, path=None) if jumps else leg)
    assert [code for code, _ in tick.events] == (["pose_jump"] if jumps else [])


@table(
    ("says", "lack"),
    [
        ("disk_full: no space: none", ("disk_full", "no space: none")),
        ("disk_full", ("disk_full", "the tick recorder takes no records")),
        ("", ("recorder_down", "the tick recorder takes no records")),
    ],
)
def test_why_nothing_is_recorded(says: str, lack: tuple[str, str]) -> None:
    assert recorder_lack(Inbox(recorder_says=says)) == lack


def test_a_place_that_is_not_ours_displaces_nobody() -> None:
    tick = at()
    assert sensor_update._hear_localization(tick, placed(odom_id="b9")) is False


def test_a_drift_of_just_what_odometry_may_err_is_no_jump() -> None:
    for drift in (Drift(x_m=DRIFT_M), Drift(y_m=-DRIFT_M), Drift(yaw_rad=DRIFT_RAD)):
        for more, jumps in ((0.0, False), (EPS, True)):
            tick = at()
            odometry = tick.s.odometry
            had = replace(
                drift,
                x_m=drift.x_m * (1 + more),
                y_m=drift.y_m * (1 + more),
                yaw_rad=drift.yaw_rad * (1 + more),
                travelled_m=odometry.travelled_m,
                turned_rad=odometry.turned_rad,
            )
            tick.s.pose = replace(tick.s.pose, good=placed(), drift=had)
            assert sensor_update._hear_localization(tick, placed(seq=2)) is jumps


@table(
    ("off_radps", "since_s", "slipped_rad"),
    [
        (0.4, 0.01, 0.004),
        (SLIP_RADPS - EPS, 0.01, 0.0),
        (SLIP_RADPS + EPS, 0.01, 0.01 * SLIP_RADPS),
        (-SLIP_RADPS - EPS, 0.01, 0.01 * SLIP_RADPS),
        (2.0, SLIP_GAP_S - EPS, 2.0 * SLIP_GAP_S),
        (2.0, SLIP_GAP_S + EPS, 0.0),
        (2.0, -0.01, 0.0),
        (2.0, None, 0.0),
    ],
)
def test_turns_that_wheels_and_gyro_tell_differently_add_up(
    off_radps: float, since_s: float | None, slipped_rad: float
) -> None:
    tick = at()
    heard_s = None if since_s is None else tick.now_s - since_s
    tick.s.pose = replace(tick.s.pose, imu_received_s=heard_s, slipped_rad=1.0)
    measured = replace(tick.s.odometry.measured, w_radps=0.4)
    tick.s.odometry = replace(tick.s.odometry, measured=measured)
    imu = Imu(
        boot_id="d0",
        seq=1,
        stamp_s=NOW_S,
        yaw_rate_radps=0.4 + off_radps,
        accel_x_mps2=0.0,
        accel_y_mps2=0.0,
    )
    tick.inbox = replace(tick.inbox, imu=imu)
    sensor_update.sense(tick)
    assert tick.s.pose.slipped_rad - 1.0 == pytest.approx(slipped_rad, abs=3e-6)
    assert tick.s.pose.imu_received_s == tick.now_s


def test_a_slip_forgives_the_heading_alone_and_once() -> None:
    odometry = at().s.odometry
    had = Drift(0.1, 0.0, 0.15, odometry.travelled_m, odometry.turned_rad, slipped_rad=2.0)
    pose = PoseMemory(drift=had, slipped_rad=2.05)
    after = sensor_update._add_drift(pose, 0.0, 0.0, 0.0, odometry)
    assert (after.x_m, after.yaw_rad) == pytest.approx((0.1, 0.10))
    again = sensor_update._add_drift(replace(pose, drift=after), 0.0, 0.0, 0.0, odometry)
    assert (again.x_m, again.yaw_rad) == pytest.approx((0.1, 0.10))


@table(
    ("late_s", "dt_s", "late", "gap"),
    [(0.005, 0.1, 0, 0), (0.005 + EPS, 0.1, 1, 0), (0.005, 0.1 + EPS, 0, 1)],
)
def test_just_on_its_edge_a_tick_is_neither_late_nor_a_gap(
    late_s: float, dt_s: float, late: int, gap: int
) -> None:
    tick = at(loop=LoopFacts(late_s=late_s))
    tick.dt_s = dt_s
    before = tick.s.loop
    tick.s.loop = replace(before, late_at_s=(), gaps_at_s=())
    sensor_update.note_lateness(tick)
    assert (len(tick.s.loop.late_at_s), len(tick.s.loop.gaps_at_s)) == (late, gap)


def robot_of(**parts: dict[str, float]) -> RobotDescription:
    return RobotDescription.model_validate(parts)


CART = robot_of(limits={"max_decel_mps2": 0.8, "stop_jerk_mps3": 5.0})


"""Brakes at 0.8 m/s2 and takes 0.08 s of mean delay to build that up; 0.06 s late; 0.5 m wide."""


@table(
    ("robot", "known_as", "look"),
    [
        # v d / 2 j + v rim / 2 d + v (0.15 + scan + lag), and a millimetre
        (CART, Braking(), 0.04 + 0.5 * 0.75 / 1.6 + 0.5 * 0.31),
        (CART, Braking(0.1, 0.5), 0.04 + 0.5 * 0.75 / 0.8 + 0.5 * 0.41),
        (robot_of(limits={"max_wheel_radps": 6.0}), Braking(), 0.025 + 0.5 * 0.6 / 2 + 0.155),
        (robot_of(lidar={"scan_s": 0.05}), Braking(), 0.025 + 0.1875 + 0.5 * 0.26),
        # a late drive: the limiter wants 2 v (tick + lag) + d^3 / 24 j^2 more
        (
            robot_of(limits={"max_decel_mps2": 0.8, "stop_jerk_mps3": 2.5}, drive={"lag_s": 0.4}),
            Braking(),
            0.08 + 0.5 * 0.75 / 1.6 + 0.41 + 0.512 / 150,
        ),
        (robot_of(limits={"max_speed_mps": 0.2, "max_turn_radps": 0.5}), Braking(), 0.3),
        (robot_of(limits={"max_speed_mps": 1.0, "max_decel_mps2": 0.2}), Braking(), 1.999),
    ],
)
def test_how_far_anybody_needs_to_look(
    robot: RobotDescription, known_as: Braking, look: float
) -> None:
    assert look_m(robot, known_as) == pytest.approx(look + 0.001)
    moved_m = robot.limits.max_speed_mps * 0.15
    assert sight_m(robot, known_as) == pytest.approx(look + 0.001 + 0.3 + 0.05 + moved_m + 0.002)
