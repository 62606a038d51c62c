"""Shape the requested twist into this tick's command: the only way a velocity changes.

Owns rates: acceleration, deceleration and jerk at the wheels, and the memory they need, which is
the last value really sent (before dead-zone feed-forward) and never one that was measured: what an
encoder says must not become a speed that wheels are told. ``sent = last + k (target - last)`` with
one k, so v and w arrive together; limits hold at the wheels, because that is where torque is.
Towards zero is deceleration whatever the sign; a wheel that reverses decelerates to zero first.

Jerk bounds the growth of the fastest wheel's acceleration and lets it fade towards the target. It
never lets a robot that is told to slow down speed up first, and it yields when the stop would need
more than the room there is. Knows no modes and no time but the tick's length.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from bridge.core.config import PERIOD_S
from bridge.core.geometry.kinematics import fastest_rim, rim_speeds, saturate
from bridge.core.state_motion import LimiterState, Profile
from wire.geometry import STILL, Twist2

if TYPE_CHECKING:
    from wire.robot import Base, Limits


def shape(
    target: Twist2,
    memory: LimiterState,
    base: Base,
    limits: Limits,
    dt_s: float,
    *,
    period_s: float = PERIOD_S,
    profile: Profile = Profile.NORMAL,
    room_m: float | None = None,
) -> LimiterState:
    """Return this tick's limiter state; its ``sent`` is the tick's velocity.

    Args:
        target: what is asked; anything not finite is standstill. Saturated here once more.
        memory: this function's last answer; at rest, as it is made, once torque was off.
        base: wheel geometry.
        limits: robot.toml's bounds.
        dt_s: time since the last tick; held within half a period and two.
        period_s: the loop's period.
        profile: follow, stop, or stop hardest.
        room_m: path length in which the robot must be able to stand, drive lag already taken off;
            None where nothing is in the way.
    """
    last = saturate(memory.sent, base, limits)
    wanted = saturate(target, base, limits) if profile is Profile.NORMAL else STILL
    dt_s = tick_length(dt_s, period_s)
    left, right = rim_speeds(last, base.wheel_separation_m)
    left_to, right_to = rim_speeds(wanted, base.wheel_separation_m)
    left_by, right_by = left_to - left, right_to - right
    if left_by == right_by == 0.0:
        return LimiterState(wanted)
    hardest = profile is Profile.FASTEST
    decel = limits.hardest_decel_mps2 if hardest else limits.max_decel_mps2
    accel = limits.max_accel_mps2
    k = min(_share(left, left_by, accel, decel, dt_s), _share(right, right_by, accel, decel, dt_s))
    if not hardest:
        had = max(_along(memory.left_mps2, left_by), _along(memory.right_mps2, right_by))
        calms = _calms(left, left_by) and _calms(right, right_by)
        if not calms:
            k = min(k, _jerk_share(left_by, right_by, had, limits.max_jerk_mps3, dt_s))
        elif room_m is None or stopping_m(last, had, base, limits, dt_s) <= room_m:
            k = min(k, _jerk_share(left_by, right_by, had, limits.stop_jerk_mps3, dt_s))
    return LimiterState(_between(last, wanted, k), k * left_by / dt_s, k * right_by / dt_s)


def tick_length(dt_s: float, period_s: float) -> float:
    """Hold a tick's length between half a period and two; NaN counts as one period."""
    if not 0.0 < period_s <= 1.0:
        period_s = PERIOD_S
    if 0.5 * period_s <= dt_s <= 2 * period_s:
        return dt_s
    if dt_s > 2 * period_s:
        return 2 * period_s
    return 0.5 * period_s if dt_s < 0.5 * period_s else period_s


def _calms(speed: float, by: float) -> bool:
    """Tell whether a wheel is not to turn faster than it does, or away from rest."""
    return by == 0.0 or (speed > 0.0 > by) or (speed < 0.0 < by)


def _between(last: Twist2, wanted: Twist2, k: float) -> Twist2:
    if k >= 1.0:
        return wanted  # exactly: a stop ends at zero, not beside it
    return Twist2(
        last.v_mps + k * (wanted.v_mps - last.v_mps),
        last.w_radps + k * (wanted.w_radps - last.w_radps),
    )


def _share(speed: float, by: float, accel: float, decel: float, dt_s: float) -> float:
    """Return how much of its change one wheel can make: first down to zero, then up from it."""
    if by == 0.0:
        return 1.0
    change, down = abs(by), 0.0
    if speed * by < 0.0:
        down = min(change, abs(speed))
    braking_s = down / decel
    reach = decel * dt_s if braking_s >= dt_s else down + accel * (dt_s - braking_s)
    return reach / change if reach < change else 1.0


def _jerk_share(
    left_by: float, right_by: float, had_mps2: float, jerk: float, dt_s: float
) -> float:
    """Return how much of the change the jerk limit allows.

    The fastest wheel's acceleration may grow by jerk x dt, from whatever either wheel already has
    in this direction, and is at most sqrt(2 jerk x rest), so that it fades out at the target.
    """
    most = max(abs(left_by), abs(right_by))
    return min(had_mps2 + jerk * dt_s, sqrt(2 * jerk * most)) * dt_s / most


def _along(accel: float, by: float) -> float:
    """Return the part of an acceleration that already goes the way of a change."""
    if by > 0.0:
        return max(0.0, accel)
    return -accel if by < 0.0 and accel < 0.0 else 0.0


def stopping_m(twist: Twist2, had_mps2: float, base: Base, limits: Limits, dt_s: float) -> float:
    """Return the path a jerk-limited stop needs [m], one tick included; never too little.

    At the wheels, where d holds: without jerk m^2/2d for the faster rim's speed m; building the
    deceleration up from ``had`` delays it by (d - had)^2 / 2dj, fading it out adds d^3 / 24 j^2.
    The body's path is v/m of the rim's.
    """
    rim = fastest_rim(twist, base.wheel_separation_m)
    if not rim > 0.0:
        return 0.0
    d, j = limits.max_decel_mps2, limits.stop_jerk_mps3
    missing = max(0.0, d - had_mps2)
    late_s = missing * missing / (2 * d * j) + dt_s
    rim_m = rim * rim / (2 * d) + rim * late_s + d * d * d / (24 * j * j)
    return rim_m * abs(twist.v_mps) / rim
