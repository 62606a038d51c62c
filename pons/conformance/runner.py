"""Play fault after fault on one bridge and judge each from outside.

Every fault begins with a good brain that drives, and ends with the same brain driving again: the
end of one is the beginning of the next.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from random import Random
from typing import TYPE_CHECKING

from pons.conformance import verdict
from pons.conformance.brain import METRES, Brain
from pons.conformance.driver import Driver, mute, plain
from pons.conformance.fault import W, X
from pons.conformance.stage import NotBegun, Stage
from pons.conformance.verdict import NOT_ASKED, Cell
from wire import Mode

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from pons.conformance.adapter import Adapter
    from pons.conformance.fault import Fault
    from pons.conformance.track import Track
    from wire import OpKind, OwnerKind

COLUMNS = ("speed", "acceleration", "stands", "unasked", "ticks", "contacts", "drives again")
AGAIN_S = 12.0
ACT_S = 0.2
SPARE_S = 1.0
PATIENCE_S = 3.0
GIVE_UP = 3
"""A bridge that so many times running can't be driven any more has failed all that is left."""
NAMES: dict[OwnerKind, str] = {X: "velocity", W: "waypoints"}


@dataclass(frozen=True, slots=True)
class Line:
    """Give one row of the matrix."""

    fault: str
    what: str
    brain: str
    cells: dict[str, Cell]

    @property
    def passed(self) -> bool:
        """Tell whether every cell that is asked for holds."""
        return all(cell.ok is not False for cell in self.cells.values())


def play_all(adapter: Adapter, track: Track, faults: Iterable[Fault], seed: int) -> Iterator[Line]:
    """Play every fault with each brain that it concerns, brain by brain."""
    faults = tuple(faults)
    for kind in (X, W):
        mine = [fault for fault in faults if kind in fault.kinds]
        if not mine:
            continue
        brain = Brain(kind, f"kit-{NAMES[kind]}", track)
        driver = Driver(brain, adapter.status, adapter.say)
        try:
            yield from _brain(adapter, driver, mine, Random(f"{seed} {kind}"))
        finally:
            driver.close()


def _brain(adapter: Adapter, driver: Driver, faults: list[Fault], chance: Random) -> Iterator[Line]:
    lost = 0
    drives = again(adapter, driver).ok
    for fault in faults:
        if lost >= GIVE_UP:
            cells = dict.fromkeys(COLUMNS, NOT_ASKED)
            cells["drives again"] = Cell(False, "not played: it can't be driven any more")
        else:
            cells = _play(adapter, driver, fault, chance, drives=bool(drives))
        drives = cells["drives again"].ok
        lost = 0 if drives else lost + 1
        yield Line(fault.name, fault.what, NAMES[driver.brain.kind], cells)


def _play(
    adapter: Adapter, driver: Driver, fault: Fault, chance: Random, *, drives: bool
) -> dict[str, Cell]:
    stage = Stage(adapter, driver, chance, PATIENCE_S)
    began_s, trouble = time.monotonic(), None
    with stage.stack:
        try:
            if not drives:
                raise NotBegun(f"the good brain does not drive; {stage.describe()}")
            if not fault.rest:
                stage.until(stage.drives_fast, "driving fast")
            fault.play(stage)
        except NotBegun as why:
            trouble = str(why)
        if stage.to_s is None:
            stage.end()
    last = again(adapter, driver)
    return _judge(stage, fault, began_s, trouble) | {"drives again": last}


def _judge(stage: Stage, fault: Fault, began_s: float, trouble: str | None) -> dict[str, Cell]:
    record, bounds = stage.adapter.record, stage.adapter.bounds
    now_s = time.monotonic()
    return {
        "speed": verdict.speed(record, bounds, began_s, now_s),
        "acceleration": verdict.acceleration(record, bounds, began_s, now_s),
        "stands": Cell(False, trouble) if trouble else _stands(stage, fault),
        "unasked": verdict.unasked(record, began_s, now_s),
        "ticks": verdict.alive(record, bounds, began_s, now_s),
        "contacts": verdict.contacts(record, began_s, now_s),
    }


def _stands(stage: Stage, fault: Fault) -> Cell:
    noticed_s = fault.noticed_s.get(stage.brain.kind)
    if noticed_s is None and not fault.rest:
        return NOT_ASKED
    if stage.from_s is None or stage.to_s is None:
        return Cell(False, "it never began")
    adapter = stage.adapter
    return verdict.stands(adapter.record, adapter.bounds, stage.from_s, stage.to_s, noticed_s)


def again(adapter: Adapter, driver: Driver) -> Cell:
    """Let the good brain drive, with a person who does what the bridge waits for."""
    brain = driver.brain
    if brain.metres != METRES:
        brain.metres = METRES
        brain.new_mission()
    brain.asks, driver.breaker = True, plain
    stage = Stage(adapter, driver, Random(0), PATIENCE_S)
    began_s, acts, next_s = time.monotonic(), [], 0.0
    while not stage.moves():
        now_s = time.monotonic()
        if now_s - began_s > AGAIN_S:
            driver.breaker = mute
            return Cell(False, f"not within {AGAIN_S:.0f} s: {stage.describe()}")
        act = _needed(adapter)
        if act is not None and now_s >= next_s:
            adapter.operate(act)
            acts.append(act)
            next_s = now_s + ACT_S
        time.sleep(0.005)
    took_s = time.monotonic() - began_s
    return Cell(True, f"{took_s:.1f} s" + (f", {', '.join(dict.fromkeys(acts))}" if acts else ""))


def _needed(adapter: Adapter) -> OpKind | None:
    """Return what a person would do now."""
    status = adapter.status()
    if status is None:
        return None
    if status.mode in (Mode.ESTOPPED, Mode.FAULT):
        return "reset"
    if status.mode is Mode.DISARMED:
        return "arm"
    return "resume" if status.held is not None else None
