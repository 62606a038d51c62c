"""A sentence that takes itself back orders what stands behind the correction, and nothing else."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.grammar import Context, plan
from planner.language.grammar.self_correction import take_last_word
from planner.plan import EVERY_KIND, Clarify, Refuse, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
EN = (
    ", no sorry, ",
    ", no wait, ",
    ", no, ",
    ". Oh no, sorry, ",
    ", er, no, I meant ",
)
ZH = ("，不对，", "，呃不对不对，", "，哦不，", "。说错了，", "，不是，")
ORDERS = ("go to the {p}", "look around in the {p}", "count the chairs in the {p}")
ORDERS_ZH = ("去{p}", "去{p}看看", "数一下{p}的椅子")


@pytest.mark.parametrize("back", EN)
@pytest.mark.parametrize("order", ORDERS)
def test_a_place_takes_the_place_of_the_one_before(home: Vocabulary, order: str, back: str) -> None:
    meant = plan(order.format(p="study"), home, WHOLE)
    assert isinstance(meant, StepPlan)
    assert plan(order.format(p="kitchen") + back + "the study", home, WHOLE) == meant


@pytest.mark.parametrize("back", ZH)
@pytest.mark.parametrize("order", ORDERS_ZH)
def test_so_it_does_in_chinese(home: Vocabulary, order: str, back: str) -> None:
    meant = plan(order.format(p="书房"), home, WHOLE)
    assert isinstance(meant, StepPlan)
    assert plan(order.format(p="厨房") + back + "书房", home, WHOLE) == meant


@pytest.mark.parametrize("back", EN)
def test_a_whole_order_stands_alone(home: Vocabulary, back: str) -> None:
    meant = plan("find the red cup", home, WHOLE)
    assert plan(f"go to the kitchen{back}find the red cup", home, WHOLE) == meant


@pytest.mark.parametrize(
    "said",
    [
        *("go to the kitchen, no, don't", "go to the kitchen, no, I don't want you to go there"),
        *("go to the kitchen and the study, no sorry, the bedroom", "no, the study"),
        *("go to the kitchen, I mean the study, no wait, the bedroom", "go to the kitchen, no"),
        *("go to the kitchen, not the study", "he went to the kitchen, no, the study"),
        *("去厨房，不，别去", "去厨房和书房，不对，卧室", "别去厨房，不对，书房"),
    ],
)
def test_in_doubt_nothing_moves(home: Vocabulary, said: str) -> None:
    assert isinstance(plan(said, home, WHOLE), Clarify | Refuse)


@given(st.text(max_size=40))
def test_any_text_is_read_or_left(text: str) -> None:
    left = take_last_word(text)
    assert left is None or left
