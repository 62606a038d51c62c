"""Chinese orders that hang on what somebody answers to a question of yes or no."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context
from planner.language.grammar import plan as plan_in
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Ask,
    Clarify,
    ComeBack,
    Find,
    GoTo,
    If,
    Refuse,
    StepPlan,
)
from tests.planner.language.grammar.conftest import HOME


def plan(text: str) -> StepPlan | AnswerPlan | Clarify | Refuse:
    return plan_in(text, HOME, Context(runnable=EVERY_KIND))


@pytest.mark.parametrize(
    "yes", ["要的话", "要就", "她说要就", "如果她说好就", "要是要喝的话你就", "她要是说是，就"]
)
def test_a_yes_takes_the_branch(yes: str) -> None:
    made = plan(f"问妈妈要不要喝茶，{yes}去厨房")
    asked = Ask(question="妈妈,要不要喝茶")
    wanted = If(when=asked, then=(GoTo(place="kitchen"),))
    assert isinstance(made, StepPlan)
    assert made.steps == (Find(object="妈妈"), wanted)


@pytest.mark.parametrize(
    "no", ["不喝的话", "不喝就", "她说不喝就", "要是不喝就", "她说不用了就", "她说不要就"]
)
def test_a_no_takes_the_other(no: str) -> None:
    made = plan(f"问妈妈喝不喝茶，{no}去厨房")
    assert isinstance(made, StepPlan)
    last = made.steps[-1]
    assert isinstance(last, If)
    assert (last.then, last.otherwise) == ((), (GoTo(place="kitchen"),))


def test_both_branches_are_read() -> None:
    made = plan("去卧室问爸爸吃不吃苹果，吃的话去厨房，不吃就回来")
    assert isinstance(made, StepPlan)
    last = made.steps[-1]
    assert isinstance(last, If)
    assert (last.then, last.otherwise) == ((GoTo(place="kitchen"),), (ComeBack(),))
    assert plan("去卧室问爸爸吃不吃苹果，不吃就回来，吃的话去厨房") == made
    assert plan("去卧室问爸爸吃不吃苹果，吃就去厨房，否则回来") == made


@pytest.mark.parametrize(
    "said",
    ["问妈妈想吃什么，想吃的话去厨房", "问妈妈要茶还是咖啡，要的话回来",
     "问妈妈要不要喝茶，有人就回来",
     "问妈妈是不是不想吃，不想就回来", "问妈妈要不要喝茶，下雨就回来", "问妈妈要不要喝茶，要就去拿",
     "问妈妈要不要喝茶，要就别去厨房"],
)  # fmt: skip
def test_what_no_yes_or_no_tells_is_not_read(said: str) -> None:
    assert not isinstance(plan(said), StepPlan)
