"""Change the mode, by the table alone, and do each mode's entry actions.

The only writer of ``mode``. A stop that begins anywhere is planned here, in closed form, so that
it can be judged: the curve is the one that the limiter will follow, and "too slow" and "too long"
of the mode table compare what is measured with it. No mode that has torque touches what was sent
last: stop, follower and hand all go on from it. Knows no wall clock; elapsed time is an argument.
"""

from __future__ import annotations

from dataclasses import replace
from math import sqrt
from typing import TYPE_CHECKING

from bridge.core.authority.epoch import hold
from bridge.core.geometry.kinematics import fastest_rim, scale_twist
from bridge.core.modes.mode_table import RequestCause, after
from bridge.core.state_motion import NO_STOP, LimiterState, Profile, Stopping, StopPlan, profile_of
from bridge.core.tick_context import MOVING, POWERED
from wire import SEVERITY, Action, HeldReason, Mode
from wire.geometry import STILL, Twist2

if TYPE_CHECKING:
    from bridge.core.modes.mode_table import Cause
    from bridge.core.tick_context import TickContext
    from wire.robot import Base, Limits


def go(
    tick: TickContext, cause: Cause, why: str, *, reset_needed: bool = False, source: str = ""
) -> bool:
    """Follow the table; tell whether the mode is now what the cause leads to.

    Args:
        tick: the tick in the making.
        cause: what happened.
        why: row, order or code, in lower case, for events and the stop's record.
        reset_needed: the stop that begins ends in FAULT, because its row clears by reset alone.
        source: the letter of what moves the robot from now on, where the cause leads to motion.
    """
    s = tick.s
    before = s.mode
    to = after(before, cause)
    if to is None:
        return False
    if to is Mode.STOPPING:
        _begin_stop(tick, _stop_action(cause), why, cause, reset_needed=reset_needed)
    elif to is Mode.ESTOPPED:
        _begin_estop(tick, why)
    elif to is Mode.HOLD:
        _stand(tick, before, why)
    elif to in MOVING:
        s.stopping = None
        s.source = source
    else:
        _power_down(tick, to, why)
    s.mode = to
    if to is not before:
        s.mode_since_s = tick.now_s
        tick.say("mode", f"{before.value} {to.value} {why}")
    return True


def escalate(tick: TickContext, action: Action, why: str, *, reset_needed: bool) -> None:
    """Make the stop in progress end harder, never milder; a harder ramp is planned anew."""
    s = tick.s
    stop = s.stopping
    if stop is None or not SEVERITY[action] > SEVERITY[stop.action]:
        if stop is not None and reset_needed and not stop.reset_needed:
            s.stopping = replace(stop, reset_needed=True, cause=why)
        return
    faster = profile_of(action) is not profile_of(stop.action)
    s.stopping = replace(
        stop,
        action=action,
        cause=why,
        resumes=False,
        reset_needed=stop.reset_needed or reset_needed,
        since_s=tick.now_s if faster else stop.since_s,
        plan=_plan(tick, action) if faster else stop.plan,
        slow_s=0.0 if faster else stop.slow_s,
    )
    tick.say("stop_escalated", f"{action.value} {why}")


def forget_stop(tick: TickContext) -> None:
    """End the record of a stop whose ramp is over, or has failed, while the mode stays."""
    tick.s.stopping = None


def note_slow(tick: TickContext, stop: Stopping, slow_s: float) -> Stopping:
    """Remember for how long the stop in progress has been measured to be too slow."""
    noted = tick.s.stopping = replace(stop, slow_s=slow_s)
    return noted


def _stop_action(cause: Cause) -> Action:
    if isinstance(cause, Action):
        return cause
    return Action.STOP1 if cause is RequestCause.DISARM else Action.HOLD2


def _plan(tick: TickContext, action: Action) -> StopPlan:
    robot = tick.config.robot
    return plan_stop(tick.s.motion.limiter, robot.base, robot.limits, profile_of(action))


def _begin_stop(
    tick: TickContext, action: Action, why: str, cause: Cause, *, reset_needed: bool
) -> None:
    s = tick.s
    by_row = isinstance(cause, Action)
    if s.mode is Mode.STOPPING:
        escalate(tick, action, why, reset_needed=reset_needed)  # what grows harder never goes on
        return
    s.stopping = Stopping(
        action=action,
        cause=why,
        since_s=tick.now_s,
        plan=_plan(tick, action),
        source=s.source,
        resumes=by_row and action is Action.HOLD2 and s.mode is Mode.ACTIVE,
        reset_needed=reset_needed,
    )


def _begin_estop(tick: TickContext, why: str) -> None:
    s = tick.s
    if s.mode in POWERED:
        action = Action.FAST1
        s.stopping = Stopping(action, why, tick.now_s, _plan(tick, action), s.source, resumes=False)
    else:
        s.stopping = None
        s.motion.forget_sent()
    s.source = ""
    _hold_for_fault(tick, why)


def _stand(tick: TickContext, before: Mode, why: str) -> None:
    """Enter HOLD. After teleop the robot may still move: that ramp is judged like a stop."""
    s = tick.s
    if before is Mode.TELEOP:
        action = Action.HOLD2
        s.stopping = Stopping(action, why, tick.now_s, _plan(tick, action), s.source, resumes=False)
    else:
        s.stopping = None
    s.source = ""


def _power_down(tick: TickContext, to: Mode, why: str) -> None:
    s = tick.s
    if to is Mode.FAULT:
        s.fault = why
        _hold_for_fault(tick, why)
    elif to is Mode.DISARMED and s.stopping is not None and s.stopping.cause != RequestCause.DISARM:
        _hold_for_fault(tick, s.stopping.cause)
    elif to is Mode.SELFTEST:
        s.fault = None
    if to is Mode.DISARMED:
        s.fault = None
    s.stopping = None
    s.source = ""
    s.motion.forget_sent()


def _hold_for_fault(tick: TickContext, why: str) -> None:
    """Hold until a person has mended the fault, unless somebody already asked for a hold."""
    if tick.s.held is None:
        hold(tick, HeldReason.FAULT, why)


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
