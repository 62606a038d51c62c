"""Prove the drive before anybody may arm it. Waits for missing messages; raises faults.

The drive's own dead-man is proven by withholding commands until the drive says that it has timed
out, which is the one exception to one command per tick. A drive that has a dead-man and does not
report it can't be proven so: row DEAD_MAN slows it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.modes.mode_table import Fact
from bridge.core.modes.transition import go
from bridge.core.sensing.sensor_update import BASELINE_SCANS, sees
from bridge.core.state import SelfTest
from wire import Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bridge.core.modes.mode_table import Cause
    from bridge.core.tick_context import TickContext

FRESH_S = 0.25
STILL_S = 0.5
MOVING_S = 1.0
"""Wheels that turn without torque for so long: pushed, or not as disabled as they say."""
PATIENCE_S = 0.3
"""Beyond lag and its own time-out, what a drive may take to say that it has timed out."""

ECHO, WITHHOLD, RETURN, DONE = "echo", "withhold", "return", "done"


def run(tick: TickContext) -> None:
    """Take the self test one tick further."""
    s = tick.s
    if s.mode is not Mode.SELFTEST:
        return
    wrong = _wrong(tick)
    if wrong is not None:
        go(tick, Fact.WRONG, wrong)
        return
    _prove_dead_man(tick)
    if next(waits_for(tick), None) is None:
        s.selftest = replace(s.selftest, passed=True)
        go(tick, Fact.PROVEN, "selftest")


def enter(tick: TickContext, cause: Cause, why: str) -> None:
    """Begin the self test anew, by the mode table."""
    if go(tick, cause, why):
        tick.s.selftest = SelfTest(since_s=tick.now_s)


def withholds(tick: TickContext) -> bool:
    """Tell whether this tick sends no command, so that the drive's own dead-man shows itself."""
    return tick.s.mode is Mode.SELFTEST and tick.s.selftest.phase == WITHHOLD


def waits_for(tick: TickContext) -> Iterator[str]:
    """Yield a code for each thing that has not arrived or is not yet proven."""
    s = tick.s
    if not _reports(tick):
        yield "drive"
    if s.selftest.phase == ECHO:
        yield "drive_echo"
    elif s.selftest.phase != DONE:
        yield "drive_timeout"
    if not tick.still_for(STILL_S):
        yield "encoders_still"
    yield from _untold(tick)
    if s.lidar.received_s is None or not tick.now_s - s.lidar.received_s <= FRESH_S:
        yield "lidar"
    if s.lidar.baseline_scans < BASELINE_SCANS:
        covered = s.lidar.picture is not None and not sees(s.lidar.picture)
        yield "lidar_blind" if covered else "lidar_baseline"
    if tick.config.robot.inputs.estop_link and s.buttons.link_received_s is None:
        yield "estop_link"


def _untold(tick: TickContext) -> Iterator[str]:
    """Yield a code for inputs of the drive that nobody can read: they count as pressed."""
    state = tick.s.drive.newest
    if state is None:
        return  # the drive itself is waited for
    if state.estop_pressed is None:
        yield "stop_input"
    if state.bumper_front is None or state.bumper_rear is None or state.cliff is None:
        yield "contact_inputs"


def _reports(tick: TickContext) -> bool:
    received_s = tick.s.drive.received_s
    return received_s is not None and tick.now_s - received_s <= FRESH_S


def _wrong(tick: TickContext) -> str | None:
    fence, drive = tick.config.fence, tick.s.drive
    if fence is None:
        return "fence_missing"
    if fence.map_id != tick.config.map_id:
        return "fence_of_another_map"
    if drive.moving_since_s is not None and tick.now_s - drive.moving_since_s >= MOVING_S:
        return "encoders_moving"
    test = tick.s.selftest
    robot = tick.config.robot
    patience_s = robot.drive.timeout_s + robot.drive.late_s + PATIENCE_S
    if test.phase == WITHHOLD and _reports(tick) and tick.now_s - test.since_s > patience_s:
        return "drive_moves_on" if drive.moving_since_s is not None else "drive_no_timeout"
    return None


def _prove_dead_man(tick: TickContext) -> None:
    s = tick.s
    state = s.drive.newest
    if state is None or not _reports(tick):
        _phase(tick, ECHO)
        return
    echoes = state.echo_boot == tick.config.boot
    phase = s.selftest.phase
    if phase == ECHO and echoes and tick.still_for(STILL_S):
        if not tick.config.robot.drive.reports_dead_man:
            _phase(tick, DONE)  # of wheels that stand silence shows nothing: row DEAD_MAN is up
        elif state.timed_out is False:
            _phase(tick, WITHHOLD)
    elif phase == WITHHOLD and echoes and state.timed_out and tick.still_for(0.0):
        _phase(tick, RETURN)
    elif phase == RETURN and echoes and state.timed_out is False:
        _phase(tick, DONE)


def _phase(tick: TickContext, phase: str) -> None:
    test = tick.s.selftest
    if test.phase not in {phase, DONE}:
        tick.s.selftest = replace(test, phase=phase, since_s=tick.now_s)
