"""Change the mode, by the table alone, and do each mode's entry actions.

The only writer of ``mode``. A stop that begins anywhere is planned here, so that it can be judged.
No mode that has torque touches what was sent last: stop, follower and hand all go on from it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.authority.epoch import hold
from bridge.core.modes.mode_table import RequestCause, after
from bridge.core.modes.stop_profile import plan_stop
from bridge.core.state_motion import Stopping, profile_of
from bridge.core.tick_context import MOVING, POWERED
from wire import SEVERITY, Action, HeldReason, Mode

if TYPE_CHECKING:
    from bridge.core.modes.mode_table import Cause
    from bridge.core.state_motion import StopPlan
    from bridge.core.tick_context import TickContext


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
