"""Chinese ends that an order has anyhow, and ends that nobody can tell."""

from __future__ import annotations

import pytest

from planner.language.grammar import Context
from planner.language.grammar import plan as plan_in
from planner.language.grammar.zh.until_phrases import without_known_ends
from planner.plan import EVERY_KIND, AnswerPlan, Clarify, Code, Follow, Refuse, StepPlan
from tests.planner.language.grammar.conftest import HOME


def plan(text: str) -> StepPlan | AnswerPlan | Clarify | Refuse:
    return plan_in(text, HOME, Context(runnable=EVERY_KIND))


@pytest.mark.parametrize("thing", ["红杯子", "猫", "遥控器", "妈妈"])
@pytest.mark.parametrize(
    "said",
    ["一间一间找，找到{t}为止", "一间一间地找{t}，找到为止", "去每个房间找{t}，直到找到为止",
     "一直找到{t}为止", "挨个房间找{t}，直到找到它为止", "你到处找{t}，一直找到为止"],
)  # fmt: skip
def test_a_search_ends_when_it_is_found_anyhow(thing: str, said: str) -> None:
    assert plan(said.format(t=thing)) == plan(f"找{thing}")


def test_a_place_of_the_search_stays_its_place() -> None:
    assert plan("在客厅找杯子，一直找到为止") == plan("去客厅找杯子")
    assert plan("去厨房找杯子，找到为止，然后回来") == plan("去厨房找杯子，然后回来")


@pytest.mark.parametrize(
    "said",
    ["找杯子，找到瓶子为止", "找杯子，找到天黑为止", "找杯子，直到我回来", "走到看见人为止",
     "跟着我，直到我到厨房为止", "跟着我，直到我说西瓜", "往前走，直到我说停"],
)  # fmt: skip
def test_any_other_end_is_refused_as_a_condition(said: str) -> None:
    made = plan(said)
    assert isinstance(made, Refuse)
    assert made.code is Code.CONDITIONAL


@pytest.mark.parametrize("word", ["停", "停下", "好了", "可以了", "够了"])
@pytest.mark.parametrize(
    "said",
    ["一直跟着我，我说{w}再停", "跟着我，直到我说{w}", "跟着我，等我说{w}你再停",
     "跟我走，直到我说{w}为止"],
)  # fmt: skip
def test_a_stop_word_ends_the_walk_behind_somebody_anyhow(word: str, said: str) -> None:
    assert plan(said.format(w=word)) == plan("跟着我")


def test_on_and_on_is_no_more_than_to_follow() -> None:
    for said in ("一直跟着我", "请一直跟着我", "一直跟着"):
        made = plan(said)
        assert isinstance(made, StepPlan)
        assert isinstance(made.steps[-1], Follow)
        assert made == plan("跟着我")


def test_an_end_that_nobody_can_tell_is_named() -> None:
    made = plan("跟着我，我洗完澡再停")
    assert isinstance(made, Refuse)
    assert made.code is Code.CONDITIONAL
    assert "我洗完澡再停" in made.reason.zh
    assert not isinstance(plan("待在客厅看到晚上七点"), StepPlan)
    assert plan("走到沙发那里再停") == plan("去沙发")


@pytest.mark.parametrize("said", ["没有的话", "要是没有就", "没有就", "找不到就"])
@pytest.mark.parametrize("there", ["去卧室找", "去卧室找找", "去卧室看看", "卧室那边也看一下"])
def test_what_is_not_there_is_searched_in_the_next_place(said: str, there: str) -> None:
    made = plan(f"去厨房找杯子，{said}{there}")
    assert isinstance(made, StepPlan), (said, there)
    assert made.steps[-1] in (
        *plan_steps("如果厨房没有杯子，就去卧室找杯子"),
        *plan_steps("去厨房找杯子，找不到就去卧室找杯子"),
    )


def plan_steps(text: str) -> tuple[object, ...]:
    made = plan(text)
    assert isinstance(made, StepPlan)
    return tuple(made.steps)


@pytest.mark.parametrize(
    "never_mind", ["找不到就算了", "没有就算了", "找不到的话就算了", "实在找不到也就算了"]
)
def test_what_is_not_found_is_left_at_that(never_mind: str) -> None:
    assert plan(f"去客厅找杯子，{never_mind}") == plan("去客厅找杯子")
    assert plan(f"去客厅找杯子，{never_mind}，回来") == plan("去客厅找杯子，然后回来")
    assert without_known_ends(f"别去客厅,{never_mind}") == f"别去客厅,{never_mind}"
    assert not isinstance(plan("去厨房找杯子，没有就拿个碗"), StepPlan)
    assert not isinstance(plan("去厨房找杯子，要是没有就别找了"), StepPlan)
