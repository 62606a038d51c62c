"""Chinese conditions said in other words: one order of words, "unless", and what can't be told."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context
from planner.language.grammar import plan as plan_in
from planner.plan import EVERY_KIND, AnswerPlan, Clarify, Code, Find, If, Refuse, Say, StepPlan
from tests.planner.language.grammar.conftest import HOME

PLACES = ("厨房", "书房", "客厅", "沙发")


def plan(text: str) -> StepPlan | AnswerPlan | Clarify | Refuse:
    return plan_in(text, HOME, Context(runnable=EVERY_KIND))


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(
    "said",
    ["{p}要是没人就回去充电", "{p}如果没人在，你就回去充电", "要是{p}没人坐，马上回去充电",
     "万一{p}没有人在那里就立刻回去充电"],
)  # fmt: skip
def test_the_order_of_words_changes_nothing(place: str, said: str) -> None:
    assert plan(said.format(p=place)) == plan(f"如果{place}没有人，就回去充电")


@pytest.mark.parametrize("place", PLACES)
def test_unless_is_the_contrary_condition(place: str) -> None:
    nobody = plan(f"如果{place}没有人，就去卧室")
    assert plan(f"除非{place}有人，不然就去卧室") == nobody
    assert plan(f"去卧室，除非{place}有人") == nobody
    assert plan(f"除非{place}没人，你才去卧室") == nobody
    assert plan(f"除非{place}没人，否则去卧室") == plan(f"如果{place}有人，就去卧室")
    assert plan(f"除非{place}有人，否则去卧室") != plan(f"如果{place}有人，就去卧室")


def test_there_is_the_place_of_the_condition() -> None:
    assert plan("除非书房有人，不然就进去看看") == plan("如果书房没有人，就去书房看看")
    assert plan("如果书房有人，就过去") == plan("如果书房有人，就去书房")
    assert plan("书房要是没人你就去那边等着，有人就回去充电") == plan(
        "如果书房没人，就去书房，否则回去充电"
    )


@pytest.mark.parametrize(
    "said",
    ["除非卧室有人在睡觉，不然就去卧室", "除非下雨，否则去厨房", "除非他来了，否则去厨房",
     "儿子要是还没睡就去卧室", "如果有人躺在地上就去厨房", "如果厨房有人在做饭就去厨房",
     "奶奶要是坐在沙发上睡着了就去厨房"],
)  # fmt: skip
def test_a_state_that_no_eye_tells_moves_nothing(said: str) -> None:
    assert not isinstance(plan(said), StepPlan)


def test_who_sits_somewhere_is_there() -> None:
    assert plan("如果有人坐在沙发上，就说你好") == plan("如果沙发上有人，就说你好")


def test_whether_something_is_still_there_is_whether_it_is_there() -> None:
    assert plan("餐桌上要是还有杯子，就去厨房") == plan("如果餐桌上有杯子，就去厨房")
    assert plan("餐桌上要是还有杯子，就告诉我") == plan("如果餐桌上有杯子，就告诉我")


def test_who_is_called_is_looked_for_and_called_by_name() -> None:
    made = plan("餐桌上要是还有杯子，就去叫小王")
    assert isinstance(made, StepPlan)
    assert isinstance(made.steps[0], If)
    assert made.steps[0].then == (Find(object="小王"), Say(text="小王"))
    assert not isinstance(plan("去叫他"), StepPlan)


@pytest.mark.parametrize(
    "said",
    ["如果厨房没人就不要去厨房", "厨房如果有人就别进去", "如果厨房没人，就去厨房，不对，别去"],
)
def test_a_denied_branch_moves_nothing(said: str) -> None:
    made = plan(said)
    assert isinstance(made, Refuse | Clarify)
    assert made.code in (Code.NEGATED, Code.CONDITIONAL, Code.NOT_UNDERSTOOD)


@pytest.mark.parametrize(
    "said", ["去厨房等着", "去厨房，在那里等着", "在厨房守着", "待在厨房", "你就待在厨房里"]
)
def test_to_wait_somewhere_is_to_go_there_and_stay(said: str) -> None:
    assert plan(said) == plan("去厨房")


def test_to_wait_without_a_place_or_a_time_is_asked_about() -> None:
    for said in ("等着", "在这里等着"):
        made = plan(said)
        assert isinstance(made, Clarify)
        assert made.code is Code.INCOMPLETE
    assert not isinstance(plan("别待在厨房"), StepPlan)
