"""Latch the detectors' rows for as long as the table says, and find the worst that binds now.

No row masks another: every stage is kept by itself, and the worst of those that bind decides.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.faults.fault_table import ALL, STAGES, Clears
from bridge.core.state import RowUp
from wire import SEVERITY, Action, Mode

if TYPE_CHECKING:
    from collections.abc import Callable

    from bridge.core.faults.fault_table import FaultStage
    from bridge.core.tick_context import TickContext

Dirty = list[tuple[str, str]]
"""Stage names whose trouble is seen in this tick, each with the evidence."""


def binds(stage: FaultStage, letters: str) -> bool:
    """Tell whether a stage acts on these sources."""
    return stage.binds == ALL or any(letter in stage.binds for letter in letters)


def update(tick: TickContext, dirty: Dirty) -> None:
    """Raise the dirty rows, release those that have been clean for long enough."""
    rows = tick.s.rows
    if not (rows or dirty):
        return
    now_s = tick.now_s
    kept: dict[str, RowUp] = {}
    for name, evidence in dirty:
        before = rows.get(name)
        if before is None:
            tick.say("row_up", f"{name} {evidence}")
        kept[name] = RowUp(now_s if before is None else before.since_s, now_s, evidence)
    for name, up in rows.items():
        if name not in kept:
            if _clean(tick, STAGES[name], now_s - up.dirty_s):
                tick.say("row_down", name)
            else:
                kept[name] = up
    tick.s.rows = kept


def _clean(tick: TickContext, stage: FaultStage, for_s: float) -> bool:
    """Return whether a stage whose trouble is over ends by itself.

    BRAIN_LOST ends with an owner's return where nothing moves: without a grant nothing will. It is
    judged anew in every tick, because an owner may come back while the robot is still stopping.
    """
    if stage.row == "BRAIN_LOST":
        stands = tick.s.mode not in {Mode.ACTIVE, Mode.STOPPING}
        return stands and tick.s.ownership.owner is not None
    return stage.clears is Clears.AUTO and for_s >= stage.clean_s


def worst(tick: TickContext) -> tuple[Action, str, bool]:
    """Return the worst action that binds, its row in lower case, and whether it needs a reset.

    ESTOP is left out: it is a mode of its own, entered by request.
    """
    action, why, reset_needed = Action.NONE, "", False
    letters = tick.s.sources()
    for name in tick.s.rows:
        stage = STAGES[name]
        if stage.row == "ESTOP" or not binds(stage, letters):
            continue
        reset_needed = reset_needed or stage.clears is Clears.ON_RESET
        if SEVERITY[stage.action] > SEVERITY[action]:
            action, why = stage.action, stage.row.lower()
    return action, why, reset_needed


def cap(tick: TickContext) -> tuple[float, str]:
    """Return the factor on robot.toml's limits that CAP rows leave, and the row that sets it.

    Brakes learnt to be weak cap as a row does; they are no row (docs/adr/0018-learned-braking.md).
    """
    factor, by = tick.s.learnt.speed_share(), "robot"
    if factor < 1.0:
        by = "weak_brakes"
    if not tick.s.rows:
        return factor, by
    letters = tick.s.sources()
    fastest = tick.config.robot.limits.max_speed_mps
    for name in tick.s.rows:
        stage = STAGES[name]
        if stage.action is Action.CAP and binds(stage, letters):
            share = stage.cap_factor
            if share is None:
                at_most = tick.s.watch.zone_mps if stage.cap_zone else stage.cap_mps
                share = min(1.0, (at_most or 0.0) / fastest)
            if share < factor:
                factor, by = share, stage.row.lower()
    return factor, by


def clear_on_grant(tick: TickContext) -> None:
    """Release rows that a new grant ends; a detector that is still dirty raises its row again."""
    _let_go(tick, lambda stage: stage.clears is Clears.ON_GRANT)


def clear_on_arm(tick: TickContext) -> None:
    """Release the rows that arming ends.

    What needs a reset and rose while the drive was off never made a FAULT that could be reset: the
    person who arms has it before them, and arming has waited until it was clean.
    """
    _let_go(tick, lambda stage: stage.clears not in {Clears.AUTO, Clears.REBOOT})


def clear_on_reset(tick: TickContext) -> None:
    """Release the rows that a reset ends; the caller has seen them clean for 2 s."""
    _let_go(tick, lambda stage: stage.clears is Clears.ON_RESET)


def _let_go(tick: TickContext, ended: Callable[[FaultStage], bool]) -> None:
    rows = tick.s.rows
    gone = [name for name in rows if ended(STAGES[name])]
    if gone:
        tick.s.rows = {name: up for name, up in rows.items() if name not in gone}
        for name in gone:
            tick.say("row_down", name)
