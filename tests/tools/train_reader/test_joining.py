"""Two sentences of steps become one whose plan is both plans in a row; others stay as they are."""

from __future__ import annotations

from dataclasses import replace
from random import Random

import pytest

from planner.language.semantic_parser.linear_plan import read_actions
from planner.language.semantic_parser.units import Gazetteer, SentenceUnits, Unit, cut_units
from tests.known import known
from tools.train_reader.examples import PlanExample, make_example
from tools.train_reader.joining import SentenceJoiner

HOME = Gazetteer({"kitchen": "kitchen", "hall": "hall"})


def example(words: str, label: str) -> PlanExample:
    return known(make_example("en_01", "plain", cut_units(words, HOME), label))


LOOK = example("have a look round the hall for me.", "look(in hall)")
FIND = example("find my red cup in the hall, two minutes", 'find("red cup", in hall); wait(2 min)')


@pytest.mark.parametrize("seed", range(8))
def test_two_sentences_become_the_steps_of_both_in_their_order(seed: int) -> None:
    joined = SentenceJoiner([FIND]).join(LOOK, Random(seed))
    text = " ".join(unit.key for unit in joined.said.units)
    spans = SentenceUnits(text, _place_units(joined))
    assert joined is not LOOK
    assert read_actions(joined.actions, spans) == (*LOOK.plan, *FIND.plan)


@pytest.mark.parametrize(
    ("words", "label"), [("thanks for that", "none"), ("stop at once", "stop")]
)
def test_what_is_no_row_of_steps_is_joined_to_nothing(words: str, label: str) -> None:
    alone = example(words, label)
    assert SentenceJoiner([FIND]).join(alone, Random(1)) is alone
    assert SentenceJoiner([alone]).join(LOOK, Random(1)) is LOOK


def _place_units(joined: PlanExample) -> tuple[Unit, ...]:
    at, units = 0, []
    for unit in joined.said.units:
        units.append(replace(unit, start=at, end=at + len(unit.key)))
        at += len(unit.key) + 1
    return tuple(units)
