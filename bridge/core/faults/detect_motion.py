"""Detect motion that fits no command, or that a command asks for blindly.

Stuck, running away, turning unlike the gyro, into a sector from which the lidar hears nothing.
"""

from __future__ import annotations

from math import degrees, hypot
from typing import TYPE_CHECKING

from bridge.core.state_senses import SentBounds
from bridge.core.tick_context import STANDING_MPS, fill, sensor_age_s
from wire import STILL, Mode, wrap

if TYPE_CHECKING:
    from bridge.core.faults.fault_latch import Dirty
    from bridge.core.tick_context import TickContext
    from wire import Twist2
    from wire.robot import Base

SLACK_MPS = 0.15
RUNAWAY_S = 0.1
RUNAWAY_LONG_S = 0.25
FOLLOWS_S = 0.2
"""Beyond the drive's lag, as long as something sent may still show."""
BUCKET_S = 0.05

ASKED_MPS = 0.10
MOVED_MPS = 0.03
MOVED_SHARE = 0.2
ASKED_RADPS = 0.2
TURNED_RADPS = 0.05
STUCK_S = 1.0
PROGRESS_M = 0.02
PROGRESS_RAD = 0.05
PROGRESS_S = 5.0
TIMES = 3
WITHIN_S = 300.0

YAW_RADPS = 0.3
YAW_S = 0.5
GYRO_OLD_S = 0.25


def runaway(tick: TickContext, dirty: Dirty) -> None:
    """Judge whether a wheel turns faster, or the other way, than anything sent of late."""
    s = tick.s
    watch, drive = s.watch, s.drive
    half_m = tick.config.robot.base.wheel_separation_m / 2
    sent, real = s.motion.limiter.sent, s.odometry.measured
    side = sent.w_radps * half_m
    _remember(tick, sent.v_mps - side, sent.v_mps + side)
    window_s = tick.config.robot.drive.encoder_window_s
    if drive.received_s is None or not tick.now_s - drive.received_s <= window_s:
        return  # nothing is measured: row ENC_STALE
    side = real.w_radps * half_m
    left, right = real.v_mps - side, real.v_mps + side
    wild = tick.is_powered and not _fits(watch.sent, left, right)
    if not wild and watch.runaway_s == 0.0:
        return
    watch.runaway_s = fill(watch.runaway_s, tick.dt_s, RUNAWAY_LONG_S, dirty=wild)
    if wild and watch.runaway_s >= RUNAWAY_S:
        evidence = f"wheels at {left:.2f} and {right:.2f} m/s, sent {sent.v_mps:.2f} m/s"
        dirty.append(("RUNAWAY.0", evidence))
        if watch.runaway_s >= RUNAWAY_LONG_S:
            dirty.append(("RUNAWAY.1", evidence))


def _fits(sent: tuple[SentBounds, ...], left: float, right: float) -> bool:
    """Return whether wheels follow the command, or stand, or something between; with the slack."""
    fits_left, fits_right = abs(left) <= SLACK_MPS, abs(right) <= SLACK_MPS
    for bounds in reversed(sent):  # the newest most often settles it
        if fits_left and fits_right:
            return True
        fits_left = fits_left or _is_between(left, bounds.left_low, bounds.left_high)
        fits_right = fits_right or _is_between(right, bounds.right_low, bounds.right_high)
    return fits_left and fits_right


def _is_between(speed: float, low: float, high: float) -> bool:
    return min(0.0, low) - SLACK_MPS <= speed <= max(0.0, high) + SLACK_MPS


def _remember(tick: TickContext, left: float, right: float) -> None:
    """Widen the newest bounds by the twist sent, or begin new ones; drop those too old to show."""
    watch, now_s = tick.s.watch, tick.now_s
    newest = watch.sent[-1] if watch.sent else None
    if newest is None or now_s - newest.since_s >= BUCKET_S:
        old_s = now_s - (tick.config.robot.drive.late_s + FOLLOWS_S)
        kept = watch.sent
        while len(kept) > 1 and kept[1].since_s <= old_s:
            kept = kept[1:]
        watch.sent = (*kept, SentBounds(now_s, left, left, right, right))
    elif not (
        newest.left_low <= left <= newest.left_high
        and newest.right_low <= right <= newest.right_high
    ):
        wider = SentBounds(
            newest.since_s,
            min(newest.left_low, left),
            max(newest.left_high, left),
            min(newest.right_low, right),
            max(newest.right_high, right),
        )
        watch.sent = (*watch.sent[:-1], wider)


def progress(tick: TickContext, dirty: Dirty) -> None:
    """Judge whether the robot gets on; where it does not, the motion's source loses its grant."""
    watch = tick.s.watch
    if not tick.is_moving and watch.stuck_s == 0.0:
        watch.progress_at = None
        return
    evidence = _standing_evidence(tick) or _no_progress(tick)
    if evidence is None:
        return
    watch.stuck_s, watch.progress_at = 0.0, None
    watch.stuck_at_s = (*watch.stuck_at_s[-(TIMES - 1) :], tick.now_s)
    dirty.append(("STUCK.0", evidence))
    if len(watch.stuck_at_s) == TIMES and tick.now_s - watch.stuck_at_s[0] <= WITHIN_S:
        dirty.append(("STUCK.1", f"{TIMES} times within {WITHIN_S:.0f} s"))


def _standing_evidence(tick: TickContext) -> str | None:
    s, watch = tick.s, tick.s.watch
    sent, real = (s.motion.limiter.sent if tick.is_moving else STILL), s.odometry.measured
    v_mps, w_radps = abs(sent.v_mps), abs(sent.w_radps)
    held_v = v_mps > ASKED_MPS and abs(real.v_mps) < min(MOVED_MPS, MOVED_SHARE * v_mps)
    held_w = w_radps > ASKED_RADPS and abs(real.w_radps) < TURNED_RADPS
    held = held_v or held_w or _wheel_held(sent, real, tick.config.robot.base)
    if not held and watch.stuck_s == 0.0:
        return None
    watch.stuck_s = fill(watch.stuck_s, tick.dt_s, STUCK_S, dirty=held)
    if not (held and watch.stuck_s >= STUCK_S):
        return None
    return f"sent {sent.v_mps:.2f} m/s {sent.w_radps:.2f} rad/s, measured {real.v_mps:.2f} m/s"


def _wheel_held(sent: Twist2, real: Twist2, base: Base) -> bool:
    """Tell whether one wheel stands that should turn: the robot then drives round it."""
    for side_m in (-base.wheel_separation_m / 2, base.wheel_separation_m / 2):
        moved_mps = abs(real.v_mps + side_m * real.w_radps)
        if moved_mps < MOVED_MPS:
            asked_mps = abs(sent.v_mps + side_m * sent.w_radps)
            if asked_mps > ASKED_MPS and moved_mps < MOVED_SHARE * asked_mps:
                return True
    return False


def _no_progress(tick: TickContext) -> str | None:
    s, watch = tick.s, tick.s.watch
    shut = s.gate.blocked or s.gate.shut_since_s is not None
    if (
        s.mode is not Mode.ACTIVE
        or s.source != "W"
        or shut
        or not tick.s.leg.has_usable_horizon(tick.s.grants.mission, tick.now_s)
    ):
        watch.progress_at = None
        return None
    here, last = s.odometry.base_in_odom, watch.progress_at
    if (
        last is None
        or abs(wrap(here.yaw_rad - last.yaw_rad)) >= PROGRESS_RAD
        or hypot(here.x_m - last.x_m, here.y_m - last.y_m) >= PROGRESS_M
    ):
        watch.progress_at, watch.progress_s = here, tick.now_s
        return None
    waited_s = tick.now_s - watch.progress_s
    return None if waited_s < PROGRESS_S else f"no progress for {waited_s:.1f} s"


def yaw(tick: TickContext, dirty: Dirty) -> None:
    """Judge whether wheels and gyro tell the same turn. Where no gyro is wired nobody can tell."""
    s = tick.s
    if not tick.config.robot.inputs.imu:
        dirty.append(("YAW_DISAGREE.0", "no gyro"))  # no parameter switches a row off
        return
    imu, received_s = s.pose.imu, s.pose.imu_received_s
    if imu is None or received_s is None:
        evidence = "the gyro has said nothing"
    else:
        same_host = tick.inbox.sensors_same_host
        age_s = sensor_age_s(tick.now_s, received_s, imu.stamp_s, same_host=same_host)
        off_radps = abs(s.odometry.measured.w_radps - imu.yaw_rate_radps)
        if not age_s <= GYRO_OLD_S:
            evidence = f"the gyro's reading is {age_s:.2f} s old"
        else:
            evidence = "" if off_radps <= YAW_RADPS else f"{off_radps:.2f} rad/s apart"
    if not evidence and s.watch.yaw_s == 0.0:
        return
    s.watch.yaw_s = fill(s.watch.yaw_s, tick.dt_s, YAW_S, dirty=bool(evidence))
    if evidence and s.watch.yaw_s >= YAW_S:
        dirty.append(("YAW_DISAGREE.0", evidence))


def sector(tick: TickContext, dirty: Dirty) -> None:
    """Judge whether the way asked for leads into a sector that returns nothing; turns may pass."""
    s, watch = tick.s, tick.s.watch
    sectors, asked_mps = s.lidar.sectors, s.motion.asked.v_mps
    hidden = {1.0: sectors.ahead_rad, -1.0: sectors.behind_rad}
    if watch.blind_way and not (
        hidden[watch.blind_way] and watch.blind_mission == s.grants.mission
    ):
        watch.blind_way = 0.0
    if tick.is_moving and abs(asked_mps) >= STANDING_MPS:
        way = 1.0 if asked_mps > 0.0 else -1.0
        watch.blind_way = way if hidden[way] else 0.0
        watch.blind_mission = s.grants.mission
    if watch.blind_way and not s.motion.turns_out:
        where = "ahead" if watch.blind_way > 0.0 else "behind"
        evidence = f"{degrees(hidden[watch.blind_way]):.0f} degrees {where}"
        dirty.append(("LIDAR_SECTOR.0", evidence))
        dirty.append(("LIDAR_SECTOR.1", evidence))
