"""Detect a loop that wakes late, by what the shell measured and by the ticks' own times.

A host that stalls for 30 ms must not disarm anyone: cap, then hold, disarm on persistence.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bridge.core.faults.fault_latch import Dirty
    from bridge.core.tick_context import Tick

LATE_S = 0.005
LATES = 5
LATES_WITHIN_S = 1.0
MISSED = 2
GAP_S = 0.1
GAPS = 3
GAPS_WITHIN_S = 10.0


def loop(tick: Tick, dirty: Dirty) -> None:
    """Judge this tick's lateness."""
    facts, s = tick.inbox.loop, tick.s
    if facts.missed_ticks:
        s.loop = replace(s.loop, missed=s.loop.missed + facts.missed_ticks)
    if facts.late_s > LATE_S:
        late_at_s = (*s.loop.late_at_s[-(LATES - 1) :], tick.now_s)
        s.loop = replace(s.loop, late_at_s=late_at_s)
        if len(late_at_s) == LATES and tick.now_s - late_at_s[0] <= LATES_WITHIN_S:
            dirty.append(("LOOP_LATE.0", f"{LATES} late ticks within {LATES_WITHIN_S} s"))
    if facts.missed_ticks >= MISSED and not dirty_has(dirty, "LOOP_LATE.0"):
        dirty.append(("LOOP_LATE.0", f"{facts.missed_ticks} ticks missed"))
    if s.tick > 1 and not tick.dt_s <= GAP_S:
        gaps_at_s = (*s.loop.gaps_at_s[-(GAPS - 1) :], tick.now_s)
        s.loop = replace(s.loop, gaps_at_s=gaps_at_s)
        dirty.append(("LOOP_LATE.1", f"a gap of {1000 * tick.dt_s:.0f} ms"))
        if len(gaps_at_s) == GAPS and tick.now_s - gaps_at_s[0] <= GAPS_WITHIN_S:
            dirty.append(("LOOP_LATE.2", f"{GAPS} gaps within {GAPS_WITHIN_S} s"))


def rights(tick: Tick, dirty: Dirty) -> None:
    """Judge whether the system granted real time. On a virtual drive it is only shown."""
    if not (tick.s.loop.real_time or tick.config.robot.drive.virtual):
        dirty.append(("NOT_RT.0", "scheduling or memory rights refused"))


def dirty_has(dirty: Dirty, name: str) -> bool:
    """Tell whether a stage was already found dirty in this tick."""
    return any(stage == name for stage, _ in dirty)
