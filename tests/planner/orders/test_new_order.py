"""What is not to be done is no standing order, and is refused as that."""

from __future__ import annotations

import pytest

from planner.language.schedule import ScheduleCommand
from planner.language.sentence import parse
from planner.orders.errors import OrderRefusal
from planner.orders.new_order import judge_words, order_of_text


@pytest.mark.parametrize(
    "text",
    ["晚上十点以后就别到处跑了", "今晚小姨睡书房，别进去吵她", "every evening at ten don't talk"],
)
def test_a_denial_is_refused_as_one(text: str) -> None:
    assert isinstance(parse(text).intent, ScheduleCommand)
    with pytest.raises(OrderRefusal) as refused:
        judge_words(order_of_text(text, None, "api"))
    assert refused.value.code == "order_denies"


@pytest.mark.parametrize(
    "text", ["每天晚上八点告诉爸爸别忘了吃药", "every evening at eight say don't forget the pills"]
)
def test_words_of_denial_may_be_said_each_day(text: str) -> None:
    judge_words(order_of_text(text, None, "api"))
