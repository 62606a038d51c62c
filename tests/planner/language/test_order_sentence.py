"""A step about standing orders is a sentence that the clock reads whole, or none."""

from __future__ import annotations

import pytest

from planner.language.order_sentence import is_order_sentence, offer_order, write_order
from planner.plan.base import Frozen
from planner.plan.order_steps import OrderAdd, OrderChange, OrderRemove


@pytest.mark.parametrize(
    "step",
    [
        OrderAdd(due="every day at 20:00", order="go to the kitchen"),
        OrderAdd(due="每天晚上八点", order="去厨房"),
        OrderChange(which="pills", due="nine"),
        OrderChange(which="o3", due="九点"),
        OrderRemove(which="吃药"),
        OrderRemove(which="o3"),
    ],
)
def test_a_step_is_written_as_the_clock_reads_it_and_offered_so(step: Frozen) -> None:
    text = write_order(step)
    assert is_order_sentence(text, step)
    assert [button.text for button in offer_order(text).options] == [text]


@pytest.mark.parametrize("due", ["soon", "when it rains", "every day"])
def test_a_time_that_the_clock_does_not_read_makes_no_order(due: str) -> None:
    step = OrderAdd(due=due, order="go to the kitchen")
    assert not is_order_sentence(write_order(step), step)
