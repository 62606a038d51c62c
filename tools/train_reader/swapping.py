"""Put others' words in the place of quoted ones, so that their borders are learnt, not the words.

"Find the red cup" with the words of another sentence's search is "find grandpa's glasses": as good
a sentence with as sure a plan.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.semantic_parser.linear_plan import PARTS, QUOTED
from planner.language.semantic_parser.plan_grammar import FORMS
from planner.language.semantic_parser.units import MAX_UNITS, SentenceUnits
from tools.train_reader.examples import walk_actions

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from random import Random

    from planner.language.semantic_parser.linear_plan import Action
    from planner.language.semantic_parser.units import Unit
    from tools.train_reader.examples import PlanExample

    Kind = tuple[str, str, int]
    """A language, a form and the part of it."""
    QuotedSpan = tuple[Kind, int, int]
    """The kind of words, and their first and last unit."""
SWAPPED = 0.6
"""Of the quoted words of a sentence that is changed."""


def quoted_spans(example: PlanExample) -> Iterator[QuotedSpan]:
    """Yield the quoted words of an example's plan."""
    form = ""
    pairs = list(zip(example.actions, example.parts, strict=True))
    for at, (action, part) in enumerate(pairs):
        if isinstance(action, str):
            form = action if action in FORMS else form
        elif PARTS[part][0] == "slot" and PARTS[part][1] in QUOTED:
            yield (example.writer[:2], form, part), action, int(example.actions[at + 1])


class WordSwapper:
    """Change the quoted words of examples for those of others of their kind."""

    def __init__(self, examples: Sequence[PlanExample]) -> None:
        self._words: defaultdict[Kind, list[tuple[Unit, ...]]] = defaultdict(list)
        for example in examples:
            for kind, first, last in quoted_spans(example):
                self._words[kind].append(example.said.units[first : last + 1])

    def swap(self, example: PlanExample, random: Random) -> PlanExample:
        """Return the example with some of its quoted words changed; itself where none can be."""
        spans = sorted(set(quoted_spans(example)), key=lambda span: -span[1])
        units, actions, floor = list(example.said.units), example.actions, len(example.said.units)
        for kind, first, last in spans:  # from the end: those before stay where they are
            if last >= floor:
                return example  # words within words
            floor = first
            if random.random() < SWAPPED:
                others = random.choice(self._words[kind])
                units[first : last + 1] = others
                actions = _move(actions, first, last, len(others))
        said = SentenceUnits("", tuple(units))
        walked = walk_actions(actions, said) if len(units) <= MAX_UNITS else None
        if walked is None or actions == example.actions:
            return example
        return replace(example, said=said, actions=actions, allowed=walked[0], parts=walked[1])


def _move(actions: Sequence[Action], first: int, last: int, count: int) -> tuple[Action, ...]:
    """Return the actions after the units from ``first`` to ``last`` have become so many."""
    moved: list[Action] = []
    is_end = False
    for action in actions:
        if isinstance(action, str):
            moved.append(action)
        elif action in (first, last):
            is_end = action == last and (first != last or is_end)
            moved.append(first + count - 1 if is_end else first)
            is_end = first == last and not is_end
        else:
            moved.append(action + count - (last - first + 1) if action > last else action)
    return tuple(moved)
