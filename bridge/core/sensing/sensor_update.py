"""Take in the messages of drive, lidar, localization, gyro and buttons, and their ages.

First in a tick, so that orders are judged on the newest facts. Writes only what it remembers. A
scan's points beyond what a tick can need are left out once, so that ten ticks after it need not
look at them; the gates look as far by the same function.
"""

from __future__ import annotations

from dataclasses import replace
from math import hypot, radians
from typing import TYPE_CHECKING

from bridge.core.config import PERIOD_S
from bridge.core.geometry.kinematics import advance
from bridge.core.geometry.lidar_scan import ScanPicture
from bridge.core.sensing.blind_sector import COARSE_RAD, coarse_words, watch_sectors
from bridge.core.sensing.stop_inputs import hear_link
from bridge.core.state_motion import AS_CONFIGURED, Braking
from bridge.core.state_senses import Drift, PoseMemory
from bridge.core.tick_context import STANDING_MPS, STANDING_RADPS, sensor_age_s
from wire import compose, margins, wrap
from wire.geometry import MAX_COORDINATE_M

if TYPE_CHECKING:
    from bridge.core.geometry.kinematics import OdometryState
    from bridge.core.inbox import Inbox
    from bridge.core.tick_context import TickContext
    from wire import DriveState, Imu, Localization, Pose2, Scan
    from wire.robot import RobotDescription

POOR_QUALITY = 0.5
POSE_OLD_S = 0.3
JUMP_M = 0.1
JUMP_RAD = radians(5.0)
DRIFT_M = 0.2
"""Localizers that share no noise with us wander by 0.1 m around a robot that stands."""
DRIFT_RAD = radians(10.0)
FORGIVEN_M_PER_M = 0.1
"""Wheels on carpet, before calibration, measure a way wrong by a twentieth."""
FORGIVEN_RAD_PER_M = 0.05
FORGIVEN_RAD_PER_RAD = 0.1
SLIP_RADPS = 0.1
"""Wheels and gyro that differ by more have slipped: what odometry then has wrong is forgiven."""
SLIP_GAP_S = 0.05
"""Between two readings of the gyro; for a longer silence no slip is counted."""
JUMPS = 3
JUMPS_WITHIN_S = 60.0
DRIVE_LOST_S, SCAN_LOST_S = 0.25, 0.25
"""So long a silence holds the robot by a row of its own; what comes then may count anew."""
SEQ_AHEAD = 1_000
"""No sender that lives skips so many: who does counts for itself."""
LATE_S, LATES = 0.005, 5
"""A tick that begins later than this is late; so many of them are remembered."""
GAP_S, GAPS = 0.1, 3
BASELINE_SCANS = 20
SEES_SHARE = 0.1
"""In homes nine beams of ten come back, under a cover next to none: fewer teach nothing normal."""
_TRAIL = 24
"""Readings kept to place a scan: 0.24 s, as old as a scan may be."""


def sense(tick: TickContext) -> None:
    """Take in all readings of this tick."""
    inbox, s = tick.inbox, tick.s
    for state in inbox.drive:
        _hear_drive(tick, state)
    if inbox.scan is not None:
        _hear_scan(tick, inbox.scan)
    if inbox.imu is not None:
        pose = s.pose  # every tick: a replace would take three times as long
        s.pose = PoseMemory(
            pose.localization,
            pose.received_s,
            pose.jumped_s,
            inbox.imu,
            tick.now_s,
            pose.good,
            pose.drift,
            pose.slipped_rad + _slip_rad(tick, inbox.imu),
        )
    if inbox.estop_link is not None:
        hear_link(tick, inbox.estop_link)
    changed = s.loop.recorder_ok != inbox.recorder_ok
    if changed and s.tick > 1:
        code, detail = ("recorder_up", "") if inbox.recorder_ok else recorder_lack(inbox)
        tick.say(code, detail)
    if changed or s.loop.real_time != inbox.real_time:
        s.loop = replace(s.loop, real_time=inbox.real_time, recorder_ok=inbox.recorder_ok)
    facts = inbox.loop
    if facts.missed_ticks or facts.late_s > LATE_S or not tick.dt_s <= GAP_S:
        note_lateness(tick)


def _slip_rad(tick: TickContext, imu: Imu) -> float:
    """Return by how much wheels and gyro turned differently since the gyro's last reading [rad]."""
    heard_s = tick.s.pose.imu_received_s
    if heard_s is None or not 0.0 <= tick.now_s - heard_s <= SLIP_GAP_S:
        return 0.0
    off_radps = abs(tick.s.odometry.measured.w_radps - imu.yaw_rate_radps)
    return off_radps * (tick.now_s - heard_s) if off_radps > SLIP_RADPS else 0.0


def note_lateness(tick: TickContext) -> None:
    """Remember ticks that began late, ticks missed, and gaps, as the shell measured them."""
    facts, s = tick.inbox.loop, tick.s
    if facts.missed_ticks:
        s.loop = replace(s.loop, missed=s.loop.missed + facts.missed_ticks)
    if facts.late_s > LATE_S:
        s.loop = replace(s.loop, late_at_s=(*s.loop.late_at_s[-(LATES - 1) :], tick.now_s))
    if s.tick > 1 and not tick.dt_s <= GAP_S:
        s.loop = replace(s.loop, gaps_at_s=(*s.loop.gaps_at_s[-(GAPS - 1) :], tick.now_s))


def locate(tick: TickContext) -> bool:
    """Take in localization, and say where the robot is in ``map`` if that may be trusted.

    Returns:
        Whether localization has displaced the robot: what was granted before is void.
    """
    s = tick.s
    displaced = False
    if tick.inbox.localization is not None:
        displaced = _hear_localization(tick, tick.inbox.localization)
    if pose_trouble(tick) is None and s.pose.localization is not None:
        here = compose(s.pose.localization.odom_in_map, s.odometry.base_in_odom)
        if abs(here.x_m) <= MAX_COORDINATE_M and abs(here.y_m) <= MAX_COORDINATE_M:
            tick.robot_in_map = here  # anywhere else is no place, and POSE_LOST
    return displaced


def pose_trouble(tick: TickContext) -> str | None:
    """Say why the pose in ``map`` is not to be trusted; None if it is."""
    pose = tick.s.pose
    if pose.localization is None or pose.received_s is None:
        return "no localization of this odom_id and map"
    same_host = tick.inbox.localization_same_host
    stamp_s = pose.localization.stamp_s
    age_s = sensor_age_s(tick.now_s, pose.received_s, stamp_s, same_host=same_host)
    if not age_s <= POSE_OLD_S:
        return f"localization is {age_s:.2f} s old"
    if not pose.localization.quality >= POOR_QUALITY:
        return f"localization quality {pose.localization.quality:.2f}"
    return None


def _hear_drive(tick: TickContext, state: DriveState) -> None:
    s = tick.s
    drive = s.drive
    last = drive.newest
    reborn = last is not None and last.boot_id != state.boot_id
    if last is not None and not reborn:
        told = order_of(state.seq - last.seq, tick.now_s, drive.received_s, DRIVE_LOST_S)
        if told == "again":
            reborn = True  # that it counts anew says that it lives anew, whatever it is called
        elif told:
            tick.drop(f"drive_state_{told}")
            return
    if reborn:
        drive.reborn_s = tick.now_s
    if reborn or last is None:
        drive.behind_base = s.command_seq  # it cannot echo what was said before it lived
    s.odometry = advance(s.odometry, state, tick.config.robot.base, rezero=reborn)
    drive.newest, drive.received_s = state, tick.now_s
    ours = state.echo_boot == tick.config.boot
    echoed = state.echo_seq if ours else 0
    drive.echoed_us = drive.echoed_us or ours
    drive.echoes_other = "" if ours or not drive.echoed_us else state.echo_boot or ""
    drive.ahead = max(0, echoed - s.command_seq)
    drive.behind = max(0, s.command_seq - max(echoed, drive.behind_base))
    measured = s.odometry.measured
    if abs(measured.v_mps) < STANDING_MPS and abs(measured.w_radps) < STANDING_RADPS:
        drive.moving_since_s = None
        if drive.still_since_s is None:
            drive.still_since_s = tick.now_s
    else:
        drive.still_since_s = None
        if drive.moving_since_s is None:
            drive.moving_since_s = tick.now_s
    stamp_s = min(state.stamp_s, tick.now_s) if tick.inbox.sensors_same_host else tick.now_s
    s.trail = (*s.trail[-(_TRAIL - 1) :], (stamp_s, s.odometry.base_in_odom))


def _hear_scan(tick: TickContext, scan: Scan) -> None:
    s = tick.s
    lidar = s.lidar
    last = lidar.newest
    if last is not None and last.boot_id == scan.boot_id:
        told = order_of(scan.seq - last.seq, tick.now_s, lidar.received_s, SCAN_LOST_S)
        if told not in {"", "again"}:
            tick.drop(f"scan_{told}")
            return
    step_rad = scan.angle_increment_rad
    if step_rad > COARSE_RAD and (last is None or last.angle_increment_rad != step_rad):
        tick.say("scan_coarse", coarse_words(step_rad))
    equal = last is not None and last.ranges_m == scan.ranges_m
    taken_s = scan.stamp_s if tick.inbox.sensors_same_host else tick.now_s
    robot = tick.config.robot
    seen_m = sight_m(robot, s.learnt.in_force())
    picture = ScanPicture.from_scan(scan, _place_at(tick, taken_s), robot.lidar, seen_m)
    learns = lidar.baseline_scans < BASELINE_SCANS and sees(picture)
    scans = lidar.baseline_scans + 1 if learns else lidar.baseline_scans
    mean = lidar.baseline_returns
    s.lidar = replace(
        lidar,
        newest=scan,
        received_s=tick.now_s,
        picture=picture,
        equal=lidar.equal + 1 if equal else 1,
        equal_from_m=lidar.equal_from_m if equal else s.odometry.travelled_m,
        baseline_scans=scans,
        baseline_returns=mean + (picture.returns - mean) / scans if learns else mean,
        sectors=watch_sectors(lidar.sectors, picture, s.odometry.travelled_m, tick.now_s),
    )


def order_of(further: int, now_s: float, received_s: float | None, lost_s: float) -> str:
    """Classify a sequence number so far beyond the last: nothing, old, ahead, again.

    After a silence any number counts, or a single false one would shut out for ever whom it
    pretended to be; until then one that is far ahead is not believed.
    """
    if further == 0:
        return "old"
    if received_s is None or not now_s - received_s <= lost_s:
        return "" if further > 0 else "again"
    if further < 0:
        return "old"
    return "" if further <= SEQ_AHEAD else "ahead"


def sees(picture: ScanPicture) -> bool:
    """Tell whether as many beams came back as of a lidar that nothing covers."""
    return picture.beams > 0 and picture.returns >= SEES_SHARE * picture.beams


def _place_at(tick: TickContext, at_s: float) -> Pose2:
    """Return where odometry says the robot was; the oldest known place for anything older."""
    trail = tick.s.trail
    for stamp_s, base_in_odom in reversed(trail):
        if stamp_s <= at_s:
            return base_in_odom
    return trail[0][1] if trail else tick.s.odometry.base_in_odom


def _hear_localization(tick: TickContext, new: Localization) -> bool:
    s = tick.s
    if new.odom_id != tick.config.boot or new.map_id != tick.config.map_id:
        tick.drop("localization_foreign")
        return False
    last = s.pose.good
    s.pose = replace(s.pose, localization=new, received_s=tick.now_s)
    if not new.quality >= POOR_QUALITY:
        return False
    s.pose = replace(s.pose, good=new)
    return last is not None and _is_jump(tick, last, new)


def _is_jump(tick: TickContext, last: Localization, new: Localization) -> bool:
    """Tell whether the robot is displaced in ``map`` against the last good one: T_new p, T_old p.

    By one message, or by many that add up to more than odometry may have been wrong.
    """
    s = tick.s
    here = s.odometry.base_in_odom
    before, after = compose(last.odom_in_map, here), compose(new.odom_in_map, here)
    x_m, y_m = after.x_m - before.x_m, after.y_m - before.y_m
    yaw_rad = wrap(after.yaw_rad - before.yaw_rad)
    drift = _add_drift(s.pose, x_m, y_m, yaw_rad, s.odometry)
    jump_m, drift_m = hypot(x_m, y_m), hypot(drift.x_m, drift.y_m)
    small = jump_m <= JUMP_M and abs(yaw_rad) <= JUMP_RAD
    if small and drift_m <= DRIFT_M and abs(drift.yaw_rad) <= DRIFT_RAD:
        s.pose = replace(s.pose, drift=drift)
        return False
    at_s = s.pose.drift.jumps_at_s
    if s.grants.mission is not None:
        at_s = (*at_s[-(JUMPS - 1) :], tick.now_s)
    settled = replace(drift, x_m=0.0, y_m=0.0, yaw_rad=0.0, jumps_at_s=at_s)
    s.pose = replace(s.pose, jumped_s=tick.now_s, drift=settled)
    if small:
        tick.say("pose_drift", f"{drift_m:.2f} m {abs(drift.yaw_rad):.2f} rad bit by bit")
    else:
        tick.say("pose_jump", f"{jump_m:.2f} m {abs(yaw_rad):.2f} rad")
    return True


def _add_drift(
    pose: PoseMemory, x_m: float, y_m: float, yaw_rad: float, odometry: OdometryState
) -> Drift:
    """Add one correction, and forgive the odometry's possible error since the last."""
    had = pose.drift
    moved_m = odometry.travelled_m - had.travelled_m
    turned_rad = odometry.turned_rad - had.turned_rad
    x_m, y_m, yaw_rad = had.x_m + x_m, had.y_m + y_m, had.yaw_rad + yaw_rad
    off_m, off_rad = hypot(x_m, y_m), abs(yaw_rad)
    forgiven_rad = FORGIVEN_RAD_PER_M * moved_m + FORGIVEN_RAD_PER_RAD * turned_rad
    forgiven_rad += pose.slipped_rad - had.slipped_rad
    kept = max(0.0, 1.0 - FORGIVEN_M_PER_M * moved_m / off_m) if off_m > 0.0 else 0.0
    kept_yaw = max(0.0, 1.0 - forgiven_rad / off_rad) if off_rad > 0.0 else 0.0
    return Drift(
        kept * x_m,
        kept * y_m,
        kept_yaw * yaw_rad,
        odometry.travelled_m,
        odometry.turned_rad,
        pose.slipped_rad,
        had.jumps_at_s,
    )


def recorder_lack(inbox: Inbox) -> tuple[str, str]:
    """Return code and sentence of why this run is not being recorded."""
    code, _, detail = inbox.recorder_says.partition(": ")
    return code or "recorder_down", detail or "the tick recorder takes no records"


MARGIN_M = margins.OBSTACLE_MARGIN_M
REACH_M = 2.0
"""Nobody looks further: at the fastest and weakest that robot.toml may say, caps hold before."""
FREE_M = 0.3
"""So much free way ends a block."""


_FRESH_S = 0.15
"""No scan is older where each comes in time and is on its way for half a period."""


ROUNDING_M = 1e-3


def look_m(robot: RobotDescription, braking: Braking = AS_CONFIGURED) -> float:
    """Return how far along an arc one looks as a rule: all that a robot in its limits can need [m].

    That is the path in which it stands still from its fastest, by the gate's law and by the
    limiter's, which wants it besides what the drive's lag takes (see :func:`stopping_m`).
    """
    base, limits = robot.base, robot.limits
    v, d, j = limits.max_speed_mps, limits.max_decel_mps2, limits.stop_jerk_mps3
    lag_s = robot.drive.late_s + braking.lag_more_s
    turning = limits.max_turn_radps * base.wheel_separation_m / 2
    rim = min(v + turning, limits.max_wheel_radps * base.wheel_radius_m)
    gate_s = _FRESH_S + robot.lidar.scan_s + lag_s
    limiter_m = 2 * v * (PERIOD_S + lag_s) + d * d * d / (24 * j * j)
    stop = v * d / (2 * j) + v * rim / (2 * d * braking.decel_share) + max(v * gate_s, limiter_m)
    return min(REACH_M, max(stop, FREE_M) + ROUNDING_M)


def sight_m(robot: RobotDescription, braking: Braking = AS_CONFIGURED) -> float:
    """Return how far from the robot at the scan a point may be that a tick will need [m]."""
    moved_m = robot.limits.max_speed_mps * _FRESH_S
    return look_m(robot, braking) + robot.base.radius_m + MARGIN_M + moved_m + 2 * ROUNDING_M
