"""Read suites of one line a sentence in both languages, and show how they went.

``split, group, …, sentence, …, expectation`` between tabs; what lies between is each suite's own.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from pons.evals.matchers import BadMatcher
from pons.evals.suites import HELD_OUT, TUNED

if TYPE_CHECKING:
    from collections.abc import Sequence

HERE = Path(__file__).parent
LANGUAGES = ("en", "zh")


@dataclass(frozen=True, slots=True)
class SuiteLine:
    """Hold one line of a suite."""

    split: str
    group: str
    columns: tuple[str, ...]
    """What stands behind the group: sentence and expectation are among it."""


@dataclass(frozen=True, slots=True)
class LineVerdict:
    """Hold what came of one line."""

    line: SuiteLine
    text: str
    told: str
    """What was made of it, in the suite's words."""
    right: bool
    wrong: bool = False
    """It moved, or told, what it must not: one such line and the goal is missed."""


def read_lines(suite: str, language: str, columns: int) -> tuple[SuiteLine, ...]:
    """Return a suite's lines in a language.

    Args:
        suite: the folder beside this file.
        language: ``en`` or ``zh``.
        columns: so many stand behind split and group.

    Raises:
        BadMatcher: a line can't be read.
    """
    text = (HERE / suite / f"{language}.tsv").read_text("utf-8")
    rows = (row for row in text.splitlines() if row.strip() and not row.startswith("#"))
    return tuple(read_line(row, columns) for row in rows)


def read_line(row: str, columns: int) -> SuiteLine:
    """Return one line. Raises BadMatcher where it can't be read."""
    split, group, *rest = [*row.split("\t"), ""]
    splits = {"tuned": TUNED, "held": HELD_OUT}
    if split not in splits or len(rest) != columns + 1 or not rest[-2]:
        raise BadMatcher(f"{row!r}: expected tuned or held, a group and {columns} columns")
    return SuiteLine(splits[split], group, tuple(rest[:-1]))


def show_lines(name: str, verdicts: Sequence[LineVerdict]) -> str:
    """Return the figures, and every line that came to something else."""
    lines = []
    for split in (TUNED, HELD_OUT):
        mine = [each for each in verdicts if each.line.split == split]
        right, wrong = sum(v.right for v in mine), sum(v.wrong for v in mine)
        lines.append(f"{name} {split}: {right} of {len(mine)} right, {wrong} unsafe")
    lines += [
        f"  {v.text!r} -> {v.told}; expected {v.line.columns[-1]}" for v in verdicts if not v.right
    ]
    return "\n".join(lines)
