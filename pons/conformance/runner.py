"""Play fault after fault on one bridge and judge each from outside.

Every fault begins with a good brain that drives, and ends with the same brain driving again: the
end of one is the beginning of the next.
"""

from __future__ import annotations

import time
from contextlib import closing
from dataclasses import dataclass
from random import Random
from typing import TYPE_CHECKING

from pons.conformance import verdict
from pons.conformance.driver import BrainDriver, mute, plain
from pons.conformance.fault import W, X
from pons.conformance.fault_context import FaultContext, NotBegun
from pons.conformance.reference_client import METRES, ReferenceBrain
from pons.conformance.retry_policy import Fairness
from pons.conformance.scheduler_probe import Pulse
from pons.conformance.verdict import NOT_ASKED, MatrixCell
from pons.conformance.worker_processes import HelperPool
from wire import Mode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from pons.conformance.adapter import Adapter
    from pons.conformance.fault import Fault
    from pons.conformance.retry_policy import Try
    from pons.conformance.track import TestTrack
    from wire import OpKind, OwnerKind

AGAIN = "drives again"
COLUMNS = ("speed", "acceleration", "stands", "unasked", "ticks", "contacts", AGAIN)
AGAIN_S = 9.0
ACT_S = 0.2
PATIENCE_S = 3.0
TRIES = 4
GIVE_UP = 3
"""A bridge that can't be driven after so many faults running has failed all that is left."""
NAMES: dict[OwnerKind, str] = {X: "velocity", W: "waypoints"}


@dataclass(frozen=True, slots=True)
class MatrixRow:
    """Give one row of the matrix."""

    fault: str
    what: str
    brain: str
    cells: dict[str, MatrixCell]
    """Of its last try."""
    tried: tuple[Try, ...] = ()
    """Those that failed, the last one too."""

    @property
    def has_passed(self) -> bool:
        """Tell whether every cell that is asked for holds."""
        return all(cell.ok is not False for cell in self.cells.values())

    @property
    def has_failed(self) -> bool:
        """Tell whether a cell failed; one that could not be judged has not."""
        return any(cell.ok is False and cell.judged for cell in self.cells.values())


def play_all(
    adapter: Adapter,
    track: TestTrack,
    faults: tuple[Fault, ...],
    seed: int,
    say: Callable[[str], None],
) -> Iterator[MatrixRow]:
    """Play every fault with each brain that it concerns, brain by brain."""
    with Pulse() as pulse, closing(HelperPool(adapter)) as helpers:
        helpers.load()
        fair = Fairness(pulse, say)
        for kind in (X, W):
            mine = [fault for fault in faults if kind in fault.kinds]
            if mine:
                brain = ReferenceBrain(kind, f"kit-{NAMES[kind]}", track)
                runner = Runner(adapter, helpers, brain, fair, seed)
                with closing(runner.driver):
                    yield from runner.play(mine)


class Runner:
    """Play faults with one brain."""

    def __init__(
        self,
        adapter: Adapter,
        helpers: HelperPool,
        brain: ReferenceBrain,
        fair: Fairness,
        seed: int,
    ) -> None:
        self._adapter, self._helpers, self._fair = adapter, helpers, fair
        self._name = NAMES[brain.kind]
        self._chance = Random(f"{seed} {brain.kind}")
        self.driver = BrainDriver(brain, adapter.status, adapter.say)

    def play(self, faults: list[Fault]) -> Iterator[MatrixRow]:
        """Play one after another; a fault that can't be played has failed."""
        drives = self.drive_well()
        lost = 0
        for fault in faults:
            tried: tuple[Try, ...] = ()
            if lost < GIVE_UP:
                cells, tried = self._play_fairly(fault, drives=drives.ok is True)
            else:
                cells = dict.fromkeys(COLUMNS, NOT_ASKED) | {AGAIN: MatrixCell(False, "not played")}
            drives = cells[AGAIN]
            lost = 0 if drives.ok else lost + 1
            yield MatrixRow(fault.name, fault.what, self._name, cells, tried)

    def _play_fairly(
        self, fault: Fault, *, drives: bool
    ) -> tuple[dict[str, MatrixCell], tuple[Try, ...]]:
        """Play it; again where it could not begin, or failed while the machine kept no time."""
        from_s = facts_s = time.monotonic()
        tried: list[Try] = []
        while True:
            cells, began = self._play(fault, from_s, facts_s, drives=drives)
            failed = self._fair.judge(self._adapter, cells, from_s)
            judged_s = time.monotonic()
            if failed is None:
                break
            tried.append(failed)
            if not (failed.excused or (cells[AGAIN].ok and not began)) or len(tried) == TRIES:
                break
            if failed.excused:
                self._fair.wait(f"{self._name} {fault.name}", failed)
            drives = self.drive_well().ok is True
            if failed.excused:  # it has driven all the while: facts leave no gap
                from_s, facts_s = time.monotonic(), judged_s
        return cells, tuple(tried)

    def _play(
        self, fault: Fault, from_s: float, facts_s: float, *, drives: bool
    ) -> tuple[dict[str, MatrixCell], bool]:
        """Play it once; return its cells and whether it could begin.

        Args:
            fault: what is played.
            from_s: since when all must hold, on the monotonic clock.
            facts_s: since when what no machine excuses must hold; not after ``from_s``.
            drives: the good brain drives.
        """
        stage = self._stage()
        trouble = self._try(stage, fault) if drives else "the good brain does not drive"
        drives_again = self.drive_well()
        self._helpers.load()
        stands = MatrixCell(False, trouble) if trouble else _stands(stage, fault)
        cells = self._judge(from_s, facts_s) | {"stands": stands, AGAIN: drives_again}
        return cells, trouble is None

    def _try(self, stage: FaultContext, fault: Fault) -> str | None:
        """Play it once; return why it could not begin."""
        with stage.stack:
            try:
                if not fault.rest:
                    stage.until(stage.drives_fast, "driving fast")
                fault.play(stage)
            except NotBegun as why:
                return str(why)
            finally:
                if stage.to_s is None:
                    stage.end()
        return None

    def _judge(self, from_s: float, facts_s: float) -> dict[str, MatrixCell]:
        """Judge the claims that must hold at every moment, up to now."""
        record, bounds, to_s = self._adapter.record, self._adapter.bounds, time.monotonic()
        return {
            "speed": verdict.speed(record, bounds, facts_s, to_s),
            "acceleration": verdict.acceleration(record, bounds, from_s, to_s),
            "unasked": verdict.hold_unasked_motion(record, from_s, to_s),
            "ticks": verdict.alive(record, bounds, from_s, to_s, self._fair.timing_since(from_s)),
            "contacts": verdict.contacts(record, facts_s, to_s),
        }

    def drive_well(self) -> MatrixCell:
        """Let the good brain drive, with a person who does what the bridge waits for."""
        brain = self.driver.brain
        if brain.metres != METRES:
            brain.metres = METRES
            brain.new_mission()
        brain.asks, self.driver.breaker = True, plain
        stage = self._stage()
        began_s, next_s = time.monotonic(), 0.0
        acts: dict[str, None] = {}
        while not (stage.moves() and self._owns()):
            now_s = time.monotonic()
            if now_s - began_s > AGAIN_S:
                self.driver.breaker = mute
                return MatrixCell(False, f"not within {AGAIN_S:.0f} s: {stage.describe()}")
            act = self._needed_request()
            if act is not None and now_s >= next_s:
                self._adapter.operate(act)
                acts[act] = None
                next_s = now_s + ACT_S
            time.sleep(0.005)
        return MatrixCell(True, ", ".join((f"{time.monotonic() - began_s:.1f} s", *acts)))

    def _stage(self) -> FaultContext:
        return FaultContext(self._adapter, self.driver, self._helpers, self._chance, PATIENCE_S)

    def _owns(self) -> bool:
        status = self._adapter.status()
        owner = status.owner if status is not None else None
        return owner is not None and owner.planner_id == self.driver.brain.brain_id

    def _needed_request(self) -> OpKind | None:
        """Return a person's next request."""
        status = self._adapter.status()
        if status is None:
            return None
        if status.mode in (Mode.ESTOPPED, Mode.FAULT):
            return "reset"
        if status.mode is Mode.DISARMED:
            return "arm"
        return "resume" if status.held is not None else None


def _stands(stage: FaultContext, fault: Fault) -> MatrixCell:
    noticed_s = fault.noticed_s.get(stage.brain.kind)
    if noticed_s is None and not fault.rest:
        return NOT_ASKED
    if stage.from_s is None or stage.to_s is None:
        return MatrixCell(False, "it never began")
    adapter = stage.adapter
    return verdict.stands(adapter.record, adapter.bounds, stage.from_s, stage.to_s, noticed_s)
