"""A question and a condition that leans on it are one plan: the one of the condition in full."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, Ask, Clarify, Code, Find, If, Look, Refuse, Say, StepPlan

if TYPE_CHECKING:
    from planner.plan import Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
ORDERS = (
    ("come back", "go to the bedroom"),
    ("say hello", "come back"),
    ("go to the kitchen, then come back", "look around"),
    ("tell him dinner is ready", "go look in the bedroom"),
)
ORDERS_ZH = (("回来", "去卧室"), ("告诉他吃饭了", "去卧室看看"), ("说你好", "回来"))


@pytest.mark.parametrize("who", ["Dad", "Anna", "the dog"])
@pytest.mark.parametrize(("yes", "no"), ORDERS)
@pytest.mark.parametrize(
    "before",
    [
        *("is {w} in the study? if {h} is, ", "go and see if {w} is in the study, if so "),
        "check whether {w} is in the study and if {h} is ",
    ],
)
def test_it_is_the_plan_of_the_condition_in_full(
    home: Vocabulary, before: str, who: str, yes: str, no: str
) -> None:
    he = "it" if who == "the dog" else "he"
    whole = plan(f"if {who} is in the study, {yes}, otherwise {no}", home, WHOLE)
    parted = plan(f"{before.format(w=who, h=he)}{yes}, otherwise {no}", home, WHOLE)
    if who == "the dog" and "him" in yes:
        assert not isinstance(parted, StepPlan)
        return
    assert parted == whole
    assert isinstance(whole, StepPlan)
    assert isinstance(whole.steps[0], If)


@pytest.mark.parametrize(("yes", "no"), ORDERS_ZH)
@pytest.mark.parametrize(
    "before", ["爸爸在书房吗？在的话就", "去看看爸爸在不在书房，如果他在就", "去书房，如果爸爸在就"]
)
def test_so_it_is_in_chinese(home: Vocabulary, before: str, yes: str, no: str) -> None:
    whole = plan(f"如果书房有爸爸，就{yes}，否则{no}", home, WHOLE)
    assert isinstance(whole, StepPlan)
    assert plan(f"{before}{yes}，不然就{no}", home, WHOLE) == whole


@pytest.mark.parametrize(
    ("said", "words"),
    [
        ("if Dad is in the study, tell him dinner is ready", "Dad, dinner is ready"),
        (
            "if Dad is in the study, tell him to come to the kitchen",
            "Dad, please come to the kitchen",
        ),
        ("if somebody is in the study, tell them dinner is ready", "dinner is ready"),
        ("如果爸爸在书房，就告诉他吃饭了", "爸爸,吃饭了"),
        ("如果书房有人，就跟他说吃饭了", "吃饭了"),
    ],
)
def test_words_for_one_who_is_named_begin_with_the_name(
    home: Vocabulary, said: str, words: str
) -> None:
    """No eye tells who is who: it is looked for anybody, and the name says whom it is for."""
    made = plan(said, home, WHOLE)
    assert isinstance(made, StepPlan)
    branch = made.steps[0]
    assert isinstance(branch, If)
    assert isinstance(branch.when, Look)
    assert "Dad" not in branch.when.question
    assert "爸爸" not in branch.when.question
    assert branch.then == (Say(text=words),)


def test_motion_hangs_on_the_very_person(home: Vocabulary) -> None:
    """Who is there can't be told: then neither branch is walked (ADR 0060)."""
    made = plan("if Dad is in the study, come back", home, WHOLE)
    assert isinstance(made, StepPlan)
    branch = made.steps[0]
    assert isinstance(branch, If)
    assert isinstance(branch.when, Look)
    assert branch.when.question == "is Dad in the study"


@pytest.mark.parametrize(
    "said",
    [
        "is Dad in the study? if he is, don't go to the kitchen",
        "is Dad in the study? if he is hungry, go to the kitchen",
        "is Dad in the study? if it rains, go to the kitchen",
        "go to the kitchen and the study; if he is, come back",
        "爸爸在书房吗？如果他在，就别去厨房",
        "爸爸在书房吗？如果他饿了就去厨房",
    ],
)
def test_other_conditions_and_denials_still_hold_back(home: Vocabulary, said: str) -> None:
    assert isinstance(plan(said, home, WHOLE), Clarify | Refuse)


@pytest.mark.parametrize(
    ("said", "question"),
    [
        ("ask Anna in the kitchen if she wants tea", "Anna, do you want tea?"),
        ("ask Anna in the kitchen whether she's ready", "Anna, are you ready?"),
        ("ask my mum in the kitchen if she'd like tea", "mum, would you like tea?"),
        ("ask Tom in the kitchen what he needs", "Tom, what do you need?"),
        ("问问厨房的妈妈要不要喝茶", "妈妈,要不要喝茶"),
        ("去厨房问妈妈她想吃什么", "妈妈,你想吃什么"),
    ],
)
def test_a_question_is_asked_of_them_directly(home: Vocabulary, said: str, question: str) -> None:
    made = plan(said, home, WHOLE)
    assert isinstance(made, StepPlan)
    assert made.steps[-1] == Ask(question=question)
    assert any(isinstance(step, Find) for step in made.steps)


@pytest.mark.parametrize("verb", ["tell {} in the study that", "go to the study and tell {}"])
@pytest.mark.parametrize("who", ["Anna", "Priya"])
def test_a_name_that_nobody_knows_is_somebody_to_eyes(
    home: Vocabulary, verb: str, who: str
) -> None:
    made = plan(f"{verb.format(who)} lunch is ready", home, WHOLE)
    assert isinstance(made, StepPlan)
    assert made.steps[-1] == Say(text=f"{who}, lunch is ready")


@pytest.mark.parametrize(
    "said",
    [
        "how many chairs are in the attic",
        "count the cups in the cellar",
        "how many cups are in our garage",
    ],
)
def test_what_is_counted_in_an_unknown_room_is_not_counted_elsewhere(
    home: Vocabulary, said: str
) -> None:
    made = plan(said, home, WHOLE)
    assert isinstance(made, Clarify)
    assert made.code is Code.UNKNOWN_PLACE
