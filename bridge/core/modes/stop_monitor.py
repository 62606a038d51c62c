"""Judge the stop in progress: done, slower than planned, or to be taken back.

A stop that is measured to be too slow or too long ends in FAULT with the torque cut: something
pushes, or the drive does not do what it is told. Where the drive reports nothing there is nothing
to judge: such a stop ends with the torque off when its time is over (row ENC_STALE).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.faults.detectors import ENC_LONG_S
from bridge.core.modes.mode_table import Fact
from bridge.core.modes.stop_profile import too_long, too_slow
from bridge.core.modes.transition import forget_stop, go, note_slow
from bridge.core.tick_context import fill
from wire import STILL, Action, Mode

if TYPE_CHECKING:
    from bridge.core.tick_context import TickContext

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
    lag_s, elapsed_s = robot.drive.lag_s, tick.now_s - stop.since_s
    slow = too_slow(stop.plan, s.odometry.measured, elapsed_s, lag_s, robot.base)
    if slow or stop.slow_s > 0.0:
        stop = note_slow(tick, stop, fill(stop.slow_s, tick.dt_s, SLOW_S, dirty=slow))
        if slow and stop.slow_s >= SLOW_S:
            return "stop_too_slow"
    if not tick.still_for(0.0) and too_long(stop.plan, elapsed_s, lag_s):
        return "stop_too_long"
    return None
