"""The answer to the grammar's question completes the order that it was about."""

from __future__ import annotations

import pytest

from planner.mission.answered_order import complete_order
from planner.plan import BrainTag
from tests.planner.mission.leaning import FACTS, newest, order_asked_about

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
