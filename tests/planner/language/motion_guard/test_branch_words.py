"""Check that each branch of a condition does what the words of its own side order, and no more."""

from __future__ import annotations

import pytest

from planner.language.motion_guard import PersonWords, find_unasked
from planner.plan import (
    Attempt,
    ComeBack,
    GoTo,
    If,
    Look,
    Recall,
    ReturnHome,
    Say,
    Step,
    StepPlan,
    list_nodes,
)
from pons.evals.evidence import forge_evidence
from tests.planner.brain.conftest import HOME

KITCHEN, STUDY, HALL = GoTo(place="kitchen"), GoTo(place="study"), GoTo(place="hallway")
LIVING_ROOM = GoTo(place="living_room")
LOOK = Look(question="is anybody there?", place="kitchen")
SEEN = Recall(object="person", place="kitchen", span="today")
HELLO = Say(text="hello")


def is_asked_about(text: str, *steps: Step, every_quote: bool = False) -> bool:
    """Tell whether a person is asked, by the whole sentence or by all that may be quoted of it."""
    person, made = PersonWords((text,), room="study"), StepPlan(steps=steps)
    whole = made.model_copy(update={"asked_by": (text,) * len(list_nodes(steps))})
    tries = forge_evidence(made, text, HOME) if every_quote else (whole,)
    return all(find_unasked(each, person, HOME) for each in tries)


LOOKS_FIRST = (
    ("check whether somebody is in the kitchen; if so, come back, if not, go to the hallway", HALL),
    ("see if anybody is in the kitchen. If yes, come back. If no, go to the hallway.", HALL),
    ("go to the kitchen and if somebody is there come back, otherwise go home", ReturnHome()),
    ("看看厨房有没有人，有的话就回来，没有的话就去走廊", HALL),
    ("去看看厨房有没有人，有人就回来，没人就回家", ReturnHome()),
)


@pytest.mark.parametrize(("order", "other"), LOOKS_FIRST, ids=[text for text, _ in LOOKS_FIRST])
def test_what_was_ordered_before_the_condition_is_done_in_neither_branch(
    order: str, other: Step
) -> None:
    assert not is_asked_about(order, If(when=LOOK, then=(ComeBack(),), otherwise=(other,)))
    for wrong in (
        If(when=LOOK, then=(KITCHEN,), otherwise=(other,)),
        If(when=LOOK, then=(ComeBack(),), otherwise=(KITCHEN,)),
        If(when=LOOK, otherwise=(KITCHEN,)),
    ):
        assert is_asked_about(order, wrong, every_quote=True)


@pytest.mark.parametrize(
    "order",
    ["if nobody was in the kitchen today go to the kitchen", "要是今天没人来过厨房就去厨房"],
)
def test_one_order_upon_a_condition_stands_in_one_branch(order: str) -> None:
    assert not is_asked_about(order, If(when=SEEN, otherwise=(KITCHEN,)))
    assert not is_asked_about(order, If(when=SEEN, then=(KITCHEN,)))
    both = If(when=SEEN, then=(KITCHEN,), otherwise=(KITCHEN,))
    assert is_asked_about(order, both, every_quote=True)


@pytest.mark.parametrize(
    "order",
    [
        "if you saw somebody in the kitchen today go to the kitchen, else go home",
        "如果今天在厨房看见过人就去厨房，没有就回家",
        "要是今天有人来过厨房就去厨房，否则回家",
    ],
)
def test_who_is_sent_home_is_sent_nowhere_else(order: str) -> None:
    assert not is_asked_about(order, If(when=SEEN, then=(KITCHEN,), otherwise=(ReturnHome(),)))
    wrong = If(when=SEEN, then=(KITCHEN,), otherwise=(KITCHEN,))
    assert is_asked_about(order, wrong, every_quote=True)


def test_what_was_ordered_behind_the_condition_may_end_each_branch() -> None:
    order = "if anybody is in the kitchen say hello. Then go to the hallway."
    assert not is_asked_about(order, If(when=LOOK, then=(HELLO, HALL), otherwise=(HALL,)))


def test_an_order_before_its_condition_hangs_on_it_though_the_other_branch_follows() -> None:
    order = "go to the hallway if anybody is in the kitchen, otherwise come back"
    assert not is_asked_about(order, If(when=LOOK, then=(HALL,), otherwise=(ComeBack(),)))
    assert is_asked_about(order, If(when=LOOK, otherwise=(HALL,)), every_quote=True)
    assert is_asked_about(order, HALL, every_quote=True)


def test_there_is_the_place_that_was_spoken_of_last_before_it() -> None:
    order = "if you saw a person in the kitchen today, go there, else go to the living room"
    assert not is_asked_about(order, If(when=SEEN, then=(KITCHEN,), otherwise=(LIVING_ROOM,)))
    wrong = If(when=SEEN, then=(LIVING_ROOM,), otherwise=(KITCHEN,))
    assert is_asked_about(order, wrong, every_quote=True)


@pytest.mark.parametrize(
    "order",
    ["drive to the kitchen, or if you can't, to the hallway",
     "go to the kitchen; if you can't get in, to the hallway"],
)  # fmt: skip
def test_a_bare_way_behind_a_condition_is_an_order(order: str) -> None:
    assert not is_asked_about(order, Attempt(steps=(KITCHEN,), on_failure=(HALL,)))


def test_who_is_to_stay_here_is_led_nowhere_by_it() -> None:
    assert is_asked_about("stay here until somebody comes and then go to the kitchen", STUDY)
    assert is_asked_about("wait here", STUDY, every_quote=True)
