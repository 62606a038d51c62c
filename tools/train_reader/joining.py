"""Join two sentences to one of several steps: "look in the hall", "come back" make "…, then …".

What a writer says in one breath is rarer among the sentences than in life, and the plan of two
orders in a row is as sure as that of each.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.semantic_parser.linear_plan import END, PARTS, QUOTED, Action
from planner.language.semantic_parser.plan_grammar import MAX_NODES, STEPS
from planner.language.semantic_parser.units import Gazetteer, SentenceUnits, Unit, cut_units
from tools.train_reader.examples import walk_actions

if TYPE_CHECKING:
    from collections.abc import Sequence
    from random import Random

    from tools.train_reader.examples import PlanExample

MOST_UNITS = 56
BETWEEN = {
    "en": (", then", "and then", ".", ", and", "; after that", "and", ", and when done"),
    "zh": ("，然后", "，再", "。", "，接着", "；", "，", "，完了", "，之后"),
}
_ENDS = frozenset(".。!！?？…~")
_MOST_NODES = 4


class SentenceJoiner:
    """Join examples that are rows of steps."""

    def __init__(self, examples: Sequence[PlanExample]) -> None:
        self._rows: defaultdict[str, list[PlanExample]] = defaultdict(list)
        for each in examples:
            if _is_short_row(each):
                self._rows[each.writer[:2]].append(each)

    def join(self, example: PlanExample, random: Random) -> PlanExample:
        """Return the example with another one behind it; itself where none fits."""
        others = self._rows.get(example.writer[:2], ())
        if not others or not _is_short_row(example):
            return example
        other = random.choice(others)
        before = list(example.said.units)
        while len(before) > 1 and before[-1].key in _ENDS:
            before.pop()
        if len(before) + len(other.said.units) > MOST_UNITS:
            return example
        mark = cut_units(random.choice(BETWEEN[example.writer[:2]]), Gazetteer({})).units
        units = (*before, *mark, *other.said.units)
        offset = len(before) + len(mark)
        actions = (*example.actions[:-1], *_shift_actions(other, units, offset))
        said = SentenceUnits("", units)
        walked = walk_actions(actions, said)
        if walked is None:
            return example
        return replace(example, said=said, actions=actions, allowed=walked[0], parts=walked[1])


def _is_short_row(example: PlanExample) -> bool:
    row = example.plan[0].form in STEPS and example.actions[-1] == END
    return row and len(example.plan) <= min(_MOST_NODES, MAX_NODES // 2)


def _shift_actions(example: PlanExample, units: Sequence[Unit], offset: int) -> list[Action]:
    """Return an example's actions on its units, which begin at ``offset`` now."""
    moved: list[Action] = []
    for action, part in zip(example.actions, example.parts, strict=True):
        if isinstance(action, str):
            moved.append(action)
        elif PARTS[part][1] in QUOTED:
            moved.append(action + offset)
        else:  # a place or an amount is pointed at where it is named first
            at = units[action + offset]
            same = (at.place, at.amount)
            found = (i for i, each in enumerate(units) if (each.place, each.amount) == same)
            moved.append(next(found))
    return moved
