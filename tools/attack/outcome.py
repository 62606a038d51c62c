"""Hold what came of an attack and print it as a table. Judges a row by its own goal alone."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from tools.bench.figures import NONE_SEEN_95
from tools.bench.report import align_columns

if TYPE_CHECKING:
    from collections.abc import Iterable

HEAD = ("attack", "n", "wrong", "3/n", "memory MB", "goal", "met", "note")
GROWTH_MB = 10.0
"""What a process may have grown by after an attack: a parser's caches, and no leak."""


@dataclass(frozen=True, slots=True)
class AttackOutcome:
    """Hold one line of the table."""

    attack: str
    n: int
    """Inputs, requests or connections that were really tried."""
    wrong: int
    """Crashes, 5xx, hangs, or whatever the goal speaks of."""
    goal: str
    before_mb: float | None = None
    after_mb: float | None = None
    growth_mb: float = GROWTH_MB
    """Most that memory may have grown by."""
    note: str = ""
    skipped: bool = False
    """The tool for it is missing here, which is said and is no failure."""

    @property
    def is_met(self) -> bool:
        """Return whether something was tried, nothing went wrong and memory stayed flat."""
        if self.skipped:
            return True
        return self.n > 0 and self.wrong == 0 and self.flat

    @property
    def flat(self) -> bool:
        """Return whether memory grew no more than it may; true where none was measured."""
        if self.before_mb is None or self.after_mb is None:
            return True
        return self.after_mb - self.before_mb <= self.growth_mb

    def cells(self) -> tuple[str, ...]:
        """Return the line as text."""
        grown = ""
        if self.before_mb is not None and self.after_mb is not None:
            grown = f"{self.before_mb:.0f} -> {self.after_mb:.0f}"
        rate = f"{NONE_SEEN_95 / self.n:.1e}" if self.n and not self.wrong else ""
        met = "skipped" if self.skipped else "yes" if self.is_met else "NO"
        return (
            self.attack, f"{self.n}", f"{self.wrong}", rate, grown, self.goal, met, self.note
        )  # fmt: skip

    def record(self) -> dict[str, Any]:
        """Return the line as JSON can hold it."""
        return {**asdict(self), "met": self.is_met}


def table(outcomes: Iterable[AttackOutcome]) -> str:
    """Return outcomes as an aligned table."""
    return align_columns(HEAD, [outcome.cells() for outcome in outcomes])
