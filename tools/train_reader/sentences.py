"""Read writers' sentences, and check them: ``python -m tools.train_reader.sentences FILE ...``.

A sentence must hold what its label names: the words in quotes letter for letter but for capitals,
places by their names.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.grammar.sentence_text import normalise, squash
from planner.language.semantic_parser.plan_grammar import (
    ALL,
    FORMS,
    POINTED_BEFORE,
    LabelledPlan,
    NotationError,
    SlotKind,
    parse_plan,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

COLUMNS = ("id", "language", "persona", "situation", "home", "label", "words")
_PLACES = (SlotKind.PLACE, SlotKind.PLACES, SlotKind.ROUND)
_QUOTED = (SlotKind.WORDS, SlotKind.THING)


@dataclass(frozen=True, slots=True)
class WrittenSentence:
    """Hold one row of a writer's file."""

    id: str
    language: str
    persona: str
    situation: str
    home: tuple[str, ...]
    label: str
    words: str

    @property
    def category(self) -> str:
        """Return what kind of sentence was asked of the writer."""
        return self.id.split("-", 2)[-1]


def read_sentences(path: Path) -> tuple[WrittenSentence, ...]:
    """Return the rows of a file; rows that are not of seven fields are left out."""
    rows = (line.split("\t") for line in path.read_text("utf-8").splitlines())
    found = (row for row in rows if len(row) == len(COLUMNS) and row[0] != COLUMNS[0])
    return tuple(
        WrittenSentence(
            id_, language, persona, situation, tuple(home.split(" | ")), label, words.strip()
        )
        for id_, language, persona, situation, home, label, words in found
    )


def slots_of(plan: LabelledPlan) -> Iterator[tuple[SlotKind, str]]:
    """Yield what the slots of a plan hold, in the order of writing."""
    for node in plan:
        for slot, value in zip(FORMS[node.form].slots, node.slots, strict=False):
            yield from ((slot.kind, text) for text in value)
        yield from slots_of(node.condition)
        for block in node.blocks:
            yield from slots_of(block)


def fault_of(row: WrittenSentence) -> str:
    """Return what is wrong with a row; empty where nothing is."""
    if not row.words:
        return "no words"
    try:
        plan = parse_plan(row.label)
    except NotationError as error:
        return f"label: {error}"
    spoken, known = squash(row.words), {squash(place) for place in row.home}
    for kind, text in slots_of(plan):
        if text in (ALL, POINTED_BEFORE.get(kind)):
            continue
        if kind in _PLACES and squash(text) not in known:
            return f"the home has no place: {text}"
        if kind in _PLACES and squash(text) not in spoken:
            return f"the place isn't in the words: {text}"
        if kind in _QUOTED and normalise(text) not in normalise(row.words):
            return f"the quoted words aren't in the words: {text}"
    return ""


def main() -> int:
    """Print each faulty row, and how many there are."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="+", type=Path)
    rows = [row for path in parser.parse_args().files for row in read_sentences(path)]
    faults = [(row, fault) for row in rows if (fault := fault_of(row))]
    for row, fault in faults:
        sys.stdout.write(f"{row.id}: {fault}\n    {row.words}\n    {row.label}\n")
    sys.stdout.write(f"{len(rows)} rows, {len(faults)} at fault\n")
    return 1 if faults else 0


if __name__ == "__main__":
    raise SystemExit(main())
