"""Hold what the network learns from: a sentence's units, and the actions that write its plan."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from planner.language.semantic_parser.decoding import allowed_actions
from planner.language.semantic_parser.linear_plan import (
    TOKEN_NUMBERS,
    Action,
    GrammarWalk,
    UnknownWords,
    read_actions,
    write_actions,
)
from planner.language.semantic_parser.normal_plan import normalise_plan
from planner.language.semantic_parser.plan_grammar import NotationError, parse_plan
from planner.language.semantic_parser.units import MAX_UNITS, Gazetteer, SentenceUnits, cut_units
from tools.train_reader.sentences import fault_of, read_sentences

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from planner.language.semantic_parser.plan_grammar import LabelledPlan


@dataclass(frozen=True, slots=True)
class PlanExample:
    """Hold one sentence with its plan."""

    writer: str
    category: str
    said: SentenceUnits
    plan: LabelledPlan
    actions: tuple[Action, ...]
    allowed: tuple[tuple[list[int], list[int]], ...]
    """At each action the tokens and the units that the grammar and the sentence allow."""
    parts: tuple[int, ...]
    """Which part of a plan each action is of."""


def make_example(writer: str, category: str, said: SentenceUnits, label: str) -> PlanExample | None:
    """Return an example; None where the sentence is too long or lacks what its label names.

    Raises:
        NotationError: the label is not a plan.
    """
    if not 0 < len(said.units) <= MAX_UNITS:
        return None
    plan = normalise_plan(parse_plan(label))
    try:
        actions = write_actions(plan, said)
    except UnknownWords:
        return None
    walked = walk_actions(actions, said)
    if walked is None:
        return None
    meant = normalise_plan(read_actions(actions, said))
    return PlanExample(writer, category, said, meant, actions, *walked)


def walk_actions(
    actions: Sequence[Action], said: SentenceUnits
) -> tuple[tuple[tuple[list[int], list[int]], ...], tuple[int, ...]] | None:
    """Return what is allowed at each action and which part it is of; None where one is not."""
    walk, allowed, parts = GrammarWalk(), [], []
    for action in actions:
        tokens, units = allowed_actions(walk.next_actions(), said)
        if TOKEN_NUMBERS[action] not in tokens if isinstance(action, str) else action not in units:
            return None
        allowed.append((tokens, units))
        parts.append(walk.part_number)
        walk.take(action)
    return tuple(allowed), tuple(parts)


def written_examples(path: Path) -> Iterator[PlanExample]:
    """Yield the examples of a writer's file; faulty rows are left out."""
    for row in read_sentences(path):
        if fault_of(row):
            continue
        said = cut_units(row.words, Gazetteer({place: place for place in row.home}))
        try:
            example = make_example(path.stem, row.category, said, row.label)
        except NotationError:
            continue
        if example is not None:
            yield example
