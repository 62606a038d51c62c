"""Decide the mode from the rows that are up, in one place and one order, every tick.

Protective stop, then the worst row, then the stop in progress, then what the robot is called to do.
Rows are evaluated here and never from callbacks.

A stop that is measured to be too slow or too long ends in FAULT with the torque cut: something
pushes, or the drive does not do what it is told. Where the drive reports nothing there is nothing
to judge: such a stop ends with the torque off when its time is over (row ENC_STALE).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.authority import external_velocity
from bridge.core.authority.epoch import hold, revoke
from bridge.core.authority.leg_tracking import forget_horizon, has_arrived
from bridge.core.authority.ownership import end_grant
from bridge.core.faults import fault_latch
from bridge.core.faults.detectors import DETECTORS, ENC_LONG_S
from bridge.core.modes import selftest
from bridge.core.modes.mode_table import Fact
from bridge.core.modes.operator import estop
from bridge.core.modes.transition import escalate, forget_stop, go, note_slow, too_long, too_slow
from bridge.core.tick_context import fill
from wire import SEVERITY, STILL, Action, HeldReason, Mode

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext

REVOKED_S = 30.0
"""A mission that a HOLD2 has kept waiting for so long needs a person to go on."""
REVOKED_BLOCKED_S = 300.0

_FOLLOWS = frozenset({Mode.HOLD, Mode.ACTIVE, Mode.TELEOP})
_HOLD2 = SEVERITY[Action.HOLD2]


def detect(tick: TickContext) -> None:
    """Run every detector and keep its finding as long as its row says."""
    dirty: fault_latch.Dirty = []
    for detector in DETECTORS:
        detector(tick, dirty)
    fault_latch.update(tick, dirty)
    for name, evidence in dirty:
        if name == "ESTOP.0":
            estop(tick, "estop")
            tick.reasons.append(evidence)
        elif name == "STUCK.0":
            revoke(tick)  # whatever pushes on would go on for the next grant, too


def decide(tick: TickContext) -> None:
    """Bring the mode up to date."""
    s = tick.s
    if s.mode is Mode.BOOT:
        selftest.enter(tick, Fact.UP, "up")
    selftest.run(tick)
    action, why, reset_needed = fault_latch.worst(tick)
    if s.gate.blocked and s.mode is Mode.ACTIVE and not SEVERITY[action] >= _HOLD2:
        action, why = Action.HOLD2, s.gate.by
    must_stop = SEVERITY[action] >= _HOLD2
    if must_stop and s.mode in _FOLLOWS:
        go(tick, action, why, reset_needed=reset_needed)
    elif must_stop and s.mode is Mode.STOPPING:
        escalate_stop(tick, action, why, reset_needed=reset_needed)
    judge(tick)
    expire_holding(tick, must_stop=must_stop)
    if not must_stop:
        activate(tick)


def expire_holding(tick: TickContext, *, must_stop: bool) -> None:
    """While holding: forget a horizon grown old, and revoke a mission that waits for too long.

    A stale horizon matters while it moves the robot; a standing one just needs another.
    """
    s = tick.s
    waits = s.mode is Mode.HOLD and s.grants.mission is not None
    blocked = s.gate.blocked
    if not (waits and (must_stop or blocked)):
        s.waits_since_s = None
    elif s.waits_since_s is None:
        s.waits_since_s = tick.now_s
    elif tick.now_s - s.waits_since_s >= (REVOKED_S if must_stop else REVOKED_BLOCKED_S):
        why = fault_latch.worst(tick)[1] if must_stop else s.gate.by
        tick.say("mission_revoked", f"{s.grants.mission} {why}")
        end_grant(tick)
        s.waits_since_s = None
        hold(tick, HeldReason.FAULT, why)
    if (
        s.mode is Mode.HOLD
        and s.leg.horizon is not None
        and not tick.s.leg.has_usable_horizon(tick.s.grants.mission, tick.now_s)
    ):
        forget_horizon(tick)


def escalate_stop(tick: TickContext, action: Action, why: str, *, reset_needed: bool) -> None:
    """Answer a row that is worse than the stop in progress: cut the torque, or brake harder."""
    if action is Action.CUT0:
        go(tick, action, why)
    else:
        escalate(tick, action, why, reset_needed=reset_needed)


def arrive(tick: TickContext, *, at_end: bool) -> None:
    """Leave ACTIVE when the request is done and the robot stands."""
    s = tick.s
    if s.mode is not Mode.ACTIVE:
        return
    if s.source == "X":
        if not external_velocity.asks_to_move(tick) and tick.still_for(0.0):
            go(tick, Fact.ARRIVED, "released")
    elif has_arrived(tick, at_end=at_end):
        go(tick, Fact.ARRIVED, "reached" if s.leg.reached else "no_points")


def activate(tick: TickContext) -> None:
    """Go to ACTIVE where somebody with a grant asks for motion and nothing forbids it."""
    s = tick.s
    if s.mode is Mode.STOPPING and s.stopping is not None and s.stopping.resumes:
        fact = Fact.CLEARED
    elif s.mode is Mode.HOLD:
        fact = Fact.CALLED
    else:
        return
    if s.held is not None or s.grants.mission is None or s.gate.blocked or tick.stopped:
        return
    if tick.s.leg.has_usable_horizon(tick.s.grants.mission, tick.now_s):
        source = "W"
    elif external_velocity.asks_to_move(tick):
        source = "X"
    else:
        return
    go(tick, fact, s.grants.mission, source=source)  # the table has both


DWELL_S = 0.2
SLOW_S = 0.15


def judge(tick: TickContext) -> None:
    """End the stop in progress if it is over or fails."""
    s = tick.s
    stop = s.stopping
    if stop is None:
        return
    if tick.still_for(DWELL_S) and s.motion.limiter.sent == STILL:
        _end_stop(tick)
        return
    if _is_unmeasured(tick):
        if too_long(stop.plan, tick.now_s - stop.since_s, tick.config.robot.drive.lag_s):
            tick.say("stop_unmeasured", stop.cause)
            _end_stop(tick)
        return
    failure = _failure(tick)
    if failure is None:
        return
    if s.mode is Mode.ESTOPPED:
        forget_stop(tick)  # latched already: what is left to do is to cut the torque
        tick.say("stop_failed", failure)
    else:
        go(tick, Fact.TOO_SLOW, failure)


def _end_stop(tick: TickContext) -> None:
    s = tick.s
    stop = s.stopping
    if stop is None or s.mode is not Mode.STOPPING:
        forget_stop(tick)  # HOLD after teleop, or ESTOPPED: the ramp is over, the mode stays
    elif stop.reset_needed:
        go(tick, Fact.STOOD_FAULT, stop.cause)
    elif stop.action is Action.HOLD2:
        go(tick, Fact.STOOD_HOLD, stop.cause)
    else:
        go(tick, Fact.STOOD_DISARM, stop.cause)


def _is_unmeasured(tick: TickContext) -> bool:
    """Tell whether the drive has been silent for so long that ENC_STALE takes the torque away."""
    received_s = tick.s.drive.received_s
    return received_s is None or not tick.now_s - received_s <= ENC_LONG_S


def _failure(tick: TickContext) -> str | None:
    s = tick.s
    stop = s.stopping
    if stop is None:
        return None
    robot = tick.config.robot
    lag_s, elapsed_s = robot.drive.late_s, tick.now_s - stop.since_s
    slow = too_slow(stop.plan, s.odometry.measured, elapsed_s, lag_s, robot.base)
    if slow or stop.slow_s > 0.0:
        stop = note_slow(tick, stop, fill(stop.slow_s, tick.dt_s, SLOW_S, dirty=slow))
        if slow and stop.slow_s >= SLOW_S:
            return "stop_too_slow"
    if not tick.still_for(0.0) and too_long(stop.plan, elapsed_s, lag_s):
        return "stop_too_long"
    return None
