"""A branch in which nothing is done, "instead" within one, and a branch that nobody understands."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.grammar import Context
from planner.language.grammar import plan as plan_in
from planner.language.grammar.branch_words import plain_branches
from planner.plan import EVERY_KIND, AnswerPlan, Clarify, Code, Refuse, StepPlan
from tests.planner.language.grammar.conftest import HOME

ASKED = "if there is somebody in the study, go to the bedroom"
ASKED_ZH = "如果书房里有人，就去卧室"
IDLE = ("otherwise stay here", "else do nothing", "otherwise just wait here", "or else don't move")
IDLE_ZH = ("否则留在原地", "否则什么都不做", "不然就待在这里")


def plan(text: str) -> StepPlan | AnswerPlan | Clarify | Refuse:
    return plan_in(text, HOME, Context(runnable=EVERY_KIND))


@pytest.mark.parametrize("idle", IDLE)
def test_a_branch_in_which_nothing_is_done_is_none(idle: str) -> None:
    assert plan(f"{ASKED}, {idle}") == plan(ASKED)


@pytest.mark.parametrize("idle", IDLE_ZH)
def test_so_it_is_in_chinese(idle: str) -> None:
    assert plan(f"{ASKED_ZH}，{idle}") == plan(ASKED_ZH)


def test_instead_in_a_condition_is_the_order_itself() -> None:
    assert plan(f"{ASKED} instead") == plan(ASKED)
    both = plan(f"{ASKED} instead, otherwise go home")
    assert both == plan(f"{ASKED}, otherwise go home")
    assert plan("如果书房里有人，就改去卧室") == plan(ASKED_ZH)


@pytest.mark.parametrize(
    ("text", "rest"),
    [("if there is somebody in the study, sing a song", "“sing a song”"),
     ("如果书房里有人，就唱首歌", "“就唱首歌”")],
)  # fmt: skip
def test_who_is_refused_hears_which_part_was_not_understood(text: str, rest: str) -> None:
    made = plan(text)
    assert isinstance(made, Refuse)
    assert made.code is Code.CONDITIONAL
    assert rest in made.reason.en
    assert rest in made.reason.zh
    assert "can't check" not in made.reason.en


def test_a_condition_that_nobody_can_check_is_told_as_such() -> None:
    made = plan("if it rains, sing a song")
    assert isinstance(made, Refuse)
    assert "can't check the condition “if it rains”" in made.reason.en


@given(st.text(max_size=80))
def test_no_words_are_added(text: str) -> None:
    assert len(plain_branches(text)) <= len(text)
