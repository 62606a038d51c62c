"""What can be done with one thing alone is not done with one where several were ordered."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context, plan
from planner.language.grammar.noun_phrases import several
from planner.plan import EVERY_KIND, Clarify, Code, Find, StepPlan, Vocabulary

SEES = Context(
    room="study", runnable=EVERY_KIND, things=frozenset({"chair", "cup", "椅子", "杯子"})
)
COUNTED = {
    "find all cups": "count the cups",
    "find two cups": "count the cups",
    "find all of the red cups in the kitchen": "count the red cups in the kitchen",
    "look for every cup": "count the cups",
    "find all the cups on the chair": "count the cups on the chair",
    "find everybody": "count the people",
    "look for all the people in the kitchen": "count the people in the kitchen",
    "go to each chair": "count the chairs",
    "go to all the chairs": "count the chairs",
    "go to two chairs in the kitchen": "count the chairs in the kitchen",
    "找所有的杯子": "数杯子",
    "找两个杯子": "数杯子",
    "把杯子都找出来": "数杯子",
    "去厨房找三个苹果": "去厨房数苹果",
    "找所有人": "数人",
    "去所有的椅子那里": "数椅子",
    "去每把椅子旁边": "数椅子",
}
ONE_WILL_DO = {
    "find some cups": "cups",
    "find cups": "cups",
    "find a cup": "cup",
    "find the 2 litre bottle": "2 litre bottle",
    "find my glasses": "glasses",
    "找一个杯子": "杯子",
    "找三明治": "三明治",
    "找都江堰的照片": "都江堰的照片",
}


@pytest.mark.parametrize(("text", "order"), COUNTED.items())
def test_several_are_asked_about_and_a_count_is_offered(
    text: str, order: str, home: Vocabulary
) -> None:
    made = plan(text, home, SEES)
    assert isinstance(made, Clarify)
    assert made.code is Code.INCOMPLETE
    assert [option.text for option in made.options] == [order]
    offered = plan(order, home, SEES)
    assert isinstance(offered, StepPlan)
    assert offered.steps[-1].kind == "count"


@pytest.mark.parametrize(("text", "thing"), ONE_WILL_DO.items())
def test_words_that_one_thing_fulfils_are_a_search(text: str, thing: str, home: Vocabulary) -> None:
    assert plan(text, home, SEES) == StepPlan(steps=(Find(object=thing),))


def test_several_of_what_takes_an_arm_are_offered_as_one_search(home: Vocabulary) -> None:
    made = plan("bring me two cups", home, SEES)
    assert isinstance(made, Clarify)
    assert [option.text for option in made.options] == ["find the cups"]
    assert isinstance(plan("find the cups", home, SEES), StepPlan)


@pytest.mark.parametrize("words", ["all", "two", "every", "", "glasses", "都", "两", "个"])
def test_no_thing_is_made_of_an_amount_alone(words: str) -> None:
    assert several(words) is None
