"""A step about standing orders is a sentence that the clock reads whole, or none."""

from __future__ import annotations

import pytest

from planner.language.order_sentence import is_order_sentence, offer_kept, offer_order, write_order
from planner.language.schedule import ChangeOrders, CorrectOrder, ListOrders
from planner.language.sentence import parse
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


@pytest.mark.parametrize(
    ("form", "which", "due", "chinese"),
    [
        ("orders", "", "", False), ("orders", "", "tomorrow", False), ("orders", "", "周五", True),
        ("orders", "the pill reminder", "", False), ("orders", "早上巡逻那个", "", True),
        ("order_remove", "the plant one", "", False), ("order_remove", "", "", True),
        ("order_pause", "第三条", "", True), ("order_resume", "查门锁的", "", True),
        ("order_skip", "the wake-up call", "on Friday", False),
        ("order_skip", "", "Next Monday", False), ("order_skip", "九点那个", "下周一", True),
        ("order_move", "the bins one", "this evening at six", False),
        ("order_move", "", "in fifteen minutes", False), ("order_move", "", "明晚七点", True),
    ],
)  # fmt: skip
def test_words_about_what_is_kept_are_offered_as_a_sentence_that_is_read_so(
    form: str, which: str, due: str, chinese: bool
) -> None:
    asked = offer_kept(form, which, due, chinese=chinese)
    assert asked is not None
    command = parse(asked.options[0].text).intent
    assert isinstance(command, ListOrders | ChangeOrders | CorrectOrder)
    name = which.removeprefix("the ").removesuffix(" one").removesuffix("那个").removesuffix("的")
    assert name in command.which or command.which in name


@pytest.mark.parametrize(
    ("form", "which", "due"),
    [("order_move", "pills", "soon"), ("order_skip", "pills", "whenever"), ("order_pause", "", ""),
     ("order_move", "", "")],
)  # fmt: skip
def test_what_is_not_read_back_is_not_offered(form: str, which: str, due: str) -> None:
    assert offer_kept(form, which, due, chinese=False) is None
