"""Say whether a row that failed may be played again, and wait for calm before it is.

A machine that does not keep time fails a good bridge: that is measured here, not asked of the
bridge, which may be late by its own fault. Each try is told, and the last one's result stands.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from pons.conformance import verdict
from pons.conformance.scheduler_probe import until_calm

if TYPE_CHECKING:
    from collections.abc import Callable

    from pons.conformance.adapter import Adapter
    from pons.conformance.scheduler_probe import HostTiming
    from pons.conformance.verdict import MatrixCell

WAIT_S = 60.0
EXTRA_S = 180.0
"""In a whole run: after so much of waiting, and of tries that do not count, no more are excused."""
ON_ANY_MACHINE = ("speed", "contacts")
"""Seen, they are facts: no machine that is late makes a robot too fast, or touch something."""


class Timer(Protocol):
    """Measure whether the machine keeps time."""

    def timing_since(self, from_s: float) -> HostTiming:
        """Judge the time since then."""

    def look(self) -> HostTiming:
        """Judge the next moments."""


@dataclass(frozen=True, slots=True)
class Try:
    """Hold one try of a row that failed."""

    failed: dict[str, str]
    """By column: the figure."""
    machine: str
    """How the machine kept time meanwhile."""
    kept_time: bool
    excused: bool
    """It may be played again after calm."""

    def __str__(self) -> str:
        cells = "; ".join(f"{name}: {figure}" for name, figure in self.failed.items())
        kept = "kept time" if self.kept_time else "did not keep time"
        return f"{cells} (the machine {kept}: {self.machine})"


class Fairness:
    """Judge failed tries of one run."""

    def __init__(
        self,
        timer: Timer,
        say: Callable[[str], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._timer, self._say, self._clock = timer, say, clock
        self.left_s = EXTRA_S

    def timing_since(self, from_s: float) -> HostTiming:
        """Say how the machine has kept time since then."""
        return self._timer.timing_since(from_s)

    def judge(self, adapter: Adapter, cells: dict[str, MatrixCell], from_s: float) -> Try | None:
        """Return the failure since then and whether the machine caused it; None without one."""
        bad = {name: cell for name, cell in cells.items() if cell.ok is False}
        if not bad:
            return None
        seen, now_s = self._timer.timing_since(from_s), self._clock()
        held_up = verdict.held_up(adapter.record, adapter.bounds, from_s, now_s)
        kept_time = seen.time and not held_up
        fact = any(name in bad and bad[name].measured for name in ON_ANY_MACHINE)
        excused = not kept_time and not fact and self.left_s > 0.0
        self.left_s -= now_s - from_s if excused else 0.0
        told = f"{seen}, the simulator was held up" if held_up else str(seen)
        figures = {name: cell.figure for name, cell in bad.items()}
        return Try(figures, told, kept_time, excused)

    def wait(self, what: str, failed: Try) -> None:
        """Wait until the machine keeps time, as long as that is allowed."""
        began_s = self._clock()
        limit_s = max(0.0, min(WAIT_S, self.left_s))
        self._say(f"{what} failed: {failed}; waiting up to {limit_s:.0f} s for calm")
        seen = until_calm(self._timer.look, limit_s, self._clock)
        waited_s = self._clock() - began_s
        self.left_s -= waited_s
        calm = "calm" if seen.time else "no calm"
        self._say(f"{calm} after {waited_s:.0f} s ({seen}); {what} is played again")
