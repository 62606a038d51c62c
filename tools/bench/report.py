"""Hold what was measured and print it as tables. Goals stand beside; nothing is judged here."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from tools.bench.figures import Figures

HEAD = ("what", "n", "p50", "p99", "spread p25-p75", "min", "max", "unit", "goal", "note")


@dataclass(frozen=True, slots=True)
class ReportRow:
    """Hold one measured quantity."""

    what: str
    unit: str
    goal: str
    figures: Figures | None = None
    value: str = ""
    """Where the result is a word or one number."""
    note: str = ""
    valid: bool = True

    def cells(self) -> tuple[str, ...]:
        """Return the row as text."""
        note = self.note if self.valid else f"INVALID: {self.note}"
        if self.figures is None:
            return (self.what, "", self.value, "", "", "", "", self.unit, self.goal, note)
        f = self.figures
        spread = f"{number(f.p25)} - {number(f.p75)}"
        shown = (str(f.n), number(f.p50), number(f.p99), spread, number(f.low), number(f.high))
        return (self.what, *shown, self.unit, self.goal, note)

    def record(self) -> dict[str, Any]:
        """Return the row as JSON can hold it."""
        return asdict(self)


def row_of(
    what: str, unit: str, goal: str, samples: Sequence[float], note: str = "", *, valid: bool = True
) -> ReportRow:
    """Make a row of samples; without any, a row that says so."""
    if not samples:
        return ReportRow(
            what, unit, goal, value="none", note=note or "nothing was measured", valid=False
        )
    return ReportRow(what, unit, goal, Figures.of(samples), note=note, valid=valid)


def number(value: float) -> str:
    """Write a number with three significant digits, never in powers of ten."""
    if value == 0.0:
        return "0"
    decimals = 0 if abs(value) >= 100 else 1 if abs(value) >= 10 else 2 if abs(value) >= 1 else 3
    return f"{value:.{decimals}f}"


def table(rows: Iterable[ReportRow]) -> str:
    """Return rows as an aligned table."""
    return align_columns(HEAD, [row.cells() for row in rows])


def align_columns(head: Sequence[str], body: Sequence[Sequence[str]]) -> str:
    """Return lines of cells under a head, each column as wide as its widest cell."""
    lines = [head, *body]
    widths = [max(len(line[column]) for line in lines) for column in range(len(head))]
    rule = tuple("-" * width for width in widths)
    texts = [
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in (head, rule, *body)
    ]
    return "\n".join(texts)
