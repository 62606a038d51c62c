"""Chinese looks with something that hangs on them: a report is the look, all else a condition."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context
from planner.language.grammar import plan as plan_in
from planner.plan import EVERY_KIND, AnswerPlan, Clarify, Code, Refuse, StepPlan
from tests.planner.language.grammar.conftest import HOME


def plan(text: str) -> StepPlan | AnswerPlan | Clarify | Refuse:
    return plan_in(text, HOME, Context(runnable=EVERY_KIND))


@pytest.mark.parametrize(
    "tell", ["就叫我", "就告诉我一声", "你就跟我说", "的话喊我一声", "就马上通知我"]
)
def test_a_report_upon_a_state_is_the_look(tell: str) -> None:
    look = plan("看看客厅的灯开着没有")
    assert isinstance(look, StepPlan)
    assert plan(f"看看客厅的灯开着没有，开着{tell}") == look
    assert plan(f"看看客厅的灯开着没有，没关{tell}") == look
    if "就" in tell:
        assert plan(f"看看客厅的灯开着{tell}") == look


@pytest.mark.parametrize(
    "said",
    ["看看客厅的灯开着没有，开着就去厨房", "看看客厅的灯开着就去厨房",
     "看看妈妈睡了没有，睡了就回来",
     "看看客厅的灯开着就关掉", "如果客厅的灯开着就去厨房"],
)  # fmt: skip
def test_any_other_order_upon_a_state_moves_nothing(said: str) -> None:
    assert not isinstance(plan(said), StepPlan)


def test_who_or_what_is_seen_is_a_condition() -> None:
    assert plan("看看厨房有人就回来") == plan("如果厨房有人，就回来")
    assert plan("看看厨房没人就去书房") == plan("如果厨房没有人，就去书房")
    assert plan("看看厨房就回来") == plan("看看厨房，然后回来")


@pytest.mark.parametrize(
    ("said", "part"),
    [("客厅要是超过五个人就去厨房", "客厅要是超过五个人"),
     ("书房要是不到六把椅子就去厨房", "书房要是不到六把椅子"),
     ("儿子要是还没睡就叫他睡觉", "儿子要是还没睡"), ("如果电不够了就回去充电", "如果电不够了")],
)  # fmt: skip
def test_a_condition_that_nobody_can_check_is_named_whole(said: str, part: str) -> None:
    made = plan(said)
    assert isinstance(made, Refuse)
    assert made.code is Code.CONDITIONAL
    assert f"“{part}”" in made.reason.zh


def test_not_to_go_somewhere_is_still_a_denial() -> None:
    for said in ("不到厨房", "不到厨房去"):
        made = plan(said)
        assert isinstance(made, Refuse)
        assert made.code is Code.NEGATED
