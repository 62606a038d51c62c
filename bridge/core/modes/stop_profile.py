"""Plan the ramp of a stop in closed form, and judge a real one against it.

Owns the curve that the limiter will follow once a stop has begun: "too slow" and "too long" of the
mode table compare what is measured with it. Knows no wall clock; elapsed time is an argument.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import fastest_rim, scale_twist
from bridge.core.state_motion import NO_STOP, LimiterState, Profile, StopPlan
from wire.geometry import STILL, Twist2

if TYPE_CHECKING:
    from wire.robot import Base, Limits

GRACE_S = 0.2
"""Beyond the drive's lag, what a loop tick, a state message and friction may take."""
SLACK_MPS = 0.10


def plan_stop(memory: LimiterState, base: Base, limits: Limits, profile: Profile) -> StopPlan:
    """Plan the stop that begins at the twist sent last.

    Peak deceleration from m = (peak^2 - first^2) / 2j + peak^2 / 2j when the speed m is too small
    to reach the limit; otherwise what those two ramps leave is braked flat.
    """
    rim = fastest_rim(memory.sent, base.wheel_separation_m)
    if not 0.0 < rim <= 1e3:
        return NO_STOP
    if profile is Profile.FASTEST:
        hard = limits.hardest_decel_mps2
        return StopPlan(memory.sent, rim, hard, hard, 0.0, rim / hard, 0.0)
    d, j = limits.max_decel_mps2, limits.stop_jerk_mps3
    first = min(_braking(memory, base), d, sqrt(2 * j * rim))
    peak = min(d, sqrt(j * rim + first * first / 2))
    ramps = (2 * peak * peak - first * first) / (2 * j)
    flat_s = max(0.0, rim - ramps) / peak
    return StopPlan(memory.sent, rim, first, peak, max(0.0, peak - first) / j, flat_s, peak / j)


def _braking(memory: LimiterState, base: Base) -> float:
    """Return the deceleration already under way at the wheels [m/s2], never negative."""
    half = memory.sent.w_radps * base.wheel_separation_m / 2
    left, right = memory.sent.v_mps - half, memory.sent.v_mps + half
    return max(0.0, _against(left, memory.left_mps2), _against(right, memory.right_mps2))


def _against(speed: float, accel: float) -> float:
    return -accel if speed > 0.0 else accel if speed < 0.0 else 0.0


def planned_twist(plan: StopPlan, elapsed_s: float) -> Twist2:
    """Return the twist to send ``elapsed_s`` after the stop began; before it, the start."""
    if not plan.rim_mps > 0.0:
        return STILL
    return scale_twist(plan.start, planned_rim_mps(plan, elapsed_s) / plan.rim_mps)


def planned_rim_mps(plan: StopPlan, elapsed_s: float) -> float:
    """Return the planned speed of the faster rim [m/s] at a time after the stop began."""
    if not elapsed_s > 0.0:
        return plan.rim_mps
    left_s = plan.duration_s - elapsed_s
    if not left_s > 0.0:
        return 0.0
    if left_s <= plan.fall_s:
        return min(plan.rim_mps, plan.peak_mps2 * left_s * left_s / (2 * plan.fall_s))
    if elapsed_s <= plan.rise_s:
        slope = (plan.peak_mps2 - plan.first_mps2) / plan.rise_s
        return plan.rim_mps - (plan.first_mps2 + slope * elapsed_s / 2) * elapsed_s
    return min(plan.rim_mps, plan.peak_mps2 * (plan.fall_s / 2 + left_s - plan.fall_s))


def too_slow(plan: StopPlan, measured: Twist2, elapsed_s: float, lag_s: float, base: Base) -> bool:
    """Tell whether the robot is faster than the plan, delayed by the lag, ever allows.

    True only once lag and grace have passed; the caller waits until it has been so for 150 ms.
    What is not a number is too slow.
    """
    delay_s = lag_s + GRACE_S
    if not elapsed_s > delay_s:
        return False
    allowed = planned_rim_mps(plan, elapsed_s - delay_s) + SLACK_MPS
    return not fastest_rim(measured, base.wheel_separation_m) <= allowed


def too_long(plan: StopPlan, elapsed_s: float, lag_s: float) -> bool:
    """Return whether the stop, its dwell at standstill not counted, outlasts its plan."""
    return not elapsed_s <= 1.5 * (plan.duration_s + lag_s) + 0.3
