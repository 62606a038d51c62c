"""The answer to the grammar's question completes the order that it was about."""

from __future__ import annotations

import pytest

from planner.mission.open_questions import complete_order
from planner.mission.state import Mission
from planner.plan import BrainTag, Clarify
from tests.planner.mission.leaning import FACTS, newest, order_asked_about, plan_of

MUM = newest(order_asked_about("tell Mum that tea is ready"))


@pytest.mark.parametrize("answer", ["in the study", "she's in the study", "the study, I think"])
def test_a_place_completes_the_order(answer: str) -> None:
    assert complete_order(FACTS, MUM, answer) == "tell Mum in the study that tea is ready"


@pytest.mark.parametrize("answer", ["she's out", "not in the study", "go to the study", "yes"])
def test_another_answer_stays_as_it_was_said(answer: str) -> None:
    assert complete_order(FACTS, MUM, answer) == answer


def test_a_model_reads_the_answer_to_its_own_question() -> None:
    asked = MUM.model_copy(update={"brain": BrainTag(name="a model", version="1")})
    assert complete_order(FACTS, asked, "in the study") == "in the study"


def asked_where(order: str) -> Mission:
    """Return an order about whose place the built-in brain asks."""
    asks = plan_of(order)
    assert isinstance(asks, Clarify)
    return newest(order_asked_about(order, asks))


@pytest.mark.parametrize(
    ("order", "answer", "completed"),
    [
        ("go to the garage", "the kitchen", "go to the kitchen"),
        ("Go to my Garage", "no, the kitchen", "Go to the kitchen"),
        ("take me to the garage and say hi", "kitchen", "take me to the kitchen and say hi"),
        ("is there a cup in the garage?", "in the study", "is there a cup in the study?"),
        ("go to Anna's room", "the study, I think", "go to the study"),
        ("先去车库再去厨房", "书房", "先去书房再去厨房"),
        ("去车库", "the kitchen", "去厨房"),
        ("go to the garage", "the cellar", "the cellar"),
        ("go to the garage", "not the kitchen", "not the kitchen"),
        ("go to the garage", "the kitchen and the study", "the kitchen and the study"),
        ("tell Mum in the garage that the garage burns", "the study", "the study"),
    ],
)
def test_a_place_stands_in_for_the_one_nobody_knows(
    order: str, answer: str, completed: str
) -> None:
    assert complete_order(FACTS, asked_where(order), answer) == completed
