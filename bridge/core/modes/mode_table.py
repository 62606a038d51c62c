"""Hold the mode table. Absent transitions are forbidden; docs and the exhaustive test use it.

The key is the mode and what happened: the worst action of the active rows, an operator's request,
or a fact about the robot. Output follows from the mode alone: outside MOVING the target is zero.
"""

from __future__ import annotations

from enum import StrEnum

from wire import Action, Mode


class RequestCause(StrEnum):
    """Name a person's requests. ARM and RESET mean: asked, proven and all conditions met."""

    ARM = "arm"
    DISARM = "disarm"
    STOP = "stop"
    ESTOP = "estop"
    RESET = "reset"
    TELEOP = "teleop"
    """Dead-man held after being seen released and neutral."""


class Fact(StrEnum):
    """Name the causes that come true by themselves."""

    UP = "the process is up"
    PROVEN = "self test passed"
    WRONG = "self test found a fault"
    CALLED = "grant and waypoints of this epoch and owner, not held"
    ARRIVED = "final reached or no points, and standing"
    RELEASED = "dead-man released or stale"
    STOOD_HOLD = "standing 200 ms, stop keeps torque"
    STOOD_DISARM = "standing 200 ms, stop takes torque away"
    STOOD_FAULT = "standing 200 ms, a row clears by reset"
    CLEARED = "rows cleared, grant still valid"
    TOO_SLOW = "the stop is too slow or too long"
    UNPROVEN_RESET = "reset before the self test has passed"


Cause = Action | RequestCause | Fact

_M = Mode
LATCHED = frozenset({_M.ESTOPPED, _M.FAULT})

TRANSITIONS: dict[tuple[Mode, Cause], Mode] = {
    (_M.BOOT, Fact.UP): _M.SELFTEST,
    (_M.SELFTEST, Fact.PROVEN): _M.DISARMED,
    (_M.SELFTEST, Fact.WRONG): _M.FAULT,
    (_M.DISARMED, RequestCause.ARM): _M.HOLD,
    (_M.HOLD, Fact.CALLED): _M.ACTIVE,
    (_M.ACTIVE, Fact.ARRIVED): _M.HOLD,
    (_M.HOLD, RequestCause.TELEOP): _M.TELEOP,
    (_M.ACTIVE, RequestCause.TELEOP): _M.TELEOP,
    (_M.TELEOP, Fact.RELEASED): _M.HOLD,
    # Any powered mode stops for a row; HOLD already stands, or ramps, for HOLD2.
    (_M.HOLD, Action.STOP1): _M.STOPPING,
    (_M.HOLD, Action.FAST1): _M.STOPPING,
    (_M.ACTIVE, Action.HOLD2): _M.STOPPING,
    (_M.ACTIVE, Action.STOP1): _M.STOPPING,
    (_M.ACTIVE, Action.FAST1): _M.STOPPING,
    (_M.TELEOP, Action.HOLD2): _M.STOPPING,
    (_M.TELEOP, Action.STOP1): _M.STOPPING,
    (_M.TELEOP, Action.FAST1): _M.STOPPING,
    (_M.HOLD, Action.CUT0): _M.FAULT,
    (_M.ACTIVE, Action.CUT0): _M.FAULT,
    (_M.TELEOP, Action.CUT0): _M.FAULT,
    (_M.STOPPING, Action.CUT0): _M.FAULT,
    # A stop by a person: a moving robot ramps and keeps torque, a standing one stays.
    (_M.ACTIVE, RequestCause.STOP): _M.STOPPING,
    (_M.TELEOP, RequestCause.STOP): _M.STOPPING,
    (_M.HOLD, RequestCause.DISARM): _M.STOPPING,
    (_M.ACTIVE, RequestCause.DISARM): _M.STOPPING,
    (_M.TELEOP, RequestCause.DISARM): _M.STOPPING,
    (_M.STOPPING, RequestCause.DISARM): _M.STOPPING,
    (_M.STOPPING, Fact.STOOD_HOLD): _M.HOLD,
    (_M.STOPPING, Fact.STOOD_DISARM): _M.DISARMED,
    (_M.STOPPING, Fact.STOOD_FAULT): _M.FAULT,
    (_M.STOPPING, Fact.CLEARED): _M.ACTIVE,
    (_M.STOPPING, Fact.TOO_SLOW): _M.FAULT,
    # After teleop is let go, HOLD ramps: the same check watches it.
    (_M.HOLD, Fact.TOO_SLOW): _M.FAULT,
    **{(mode, RequestCause.ESTOP): _M.ESTOPPED for mode in _M if mode is not _M.ESTOPPED},
    (_M.ESTOPPED, RequestCause.RESET): _M.DISARMED,
    (_M.FAULT, RequestCause.RESET): _M.DISARMED,
    # A protective stop or a fault during the self test must not be a way around it.
    (_M.ESTOPPED, Fact.UNPROVEN_RESET): _M.SELFTEST,
    (_M.FAULT, Fact.UNPROVEN_RESET): _M.SELFTEST,
}


def after(mode: Mode, cause: Cause) -> Mode | None:
    """Return the mode that a cause leads to; None where it changes nothing."""
    return TRANSITIONS.get((mode, cause))
