"""What the robot has done is asked or told about without any order in it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

NO_ORDER = (
    "did you find the cup", "have you found it?", "have you found the cup in the kitchen",
    "how many cups did you find", "how many people have you seen in the kitchen",
    "tell me how many cups you found", "tell me if you found the cup", "what did you find?",
    "did you see anyone in the kitchen", "did you go to the kitchen", "were you in the kitchen",
    "are you going to the kitchen", "are you looking for the cup in the kitchen",
    "tell me what you saw in the kitchen", "have you been to the kitchen",
    "你找到杯子了吗", "找到了吗", "找到杯子了", "找到了", "你找到人了", "数完了吗",
    "你数了几把椅子",
    "厨房里找到杯子了吗", "在厨房找到了杯子", "你在厨房看到了几个人", "你在厨房发现了什么",
)  # fmt: skip
RECALLED = frozenset(
    ("did you find the cup", "what did you find?", "did you see anyone in the kitchen",
     "how many cups did you find", "how many people have you seen in the kitchen",
     "did you go to the kitchen", "were you in the kitchen", "have you been to the kitchen",
     "tell me what you saw in the kitchen", "你在厨房看到了几个人", "你在厨房发现了什么")
)  # fmt: skip
"""What memory answers, and nothing moves for it either."""
STILL_ORDERS = {
    "go to the kitchen and tell me what you saw": "kitchen look=tell me what you saw@kitchen",
    "go to the kitchen and tell me how many cups you found": "kitchen count=cups@kitchen",
    "find the cup and tell me what you found": "find=cup",
    "what have you got in the kitchen": "kitchen look=what have you got in the kitchen@kitchen",
    "see if you can find the cup": "find=cup",
    "能找到杯子吗": "find=杯子",
    "看看厨房里发现了什么": "kitchen look=看看厨房里发现了什么@kitchen",
    "看到人了吗": "look=看到人了吗",
}


@pytest.mark.parametrize("text", NO_ORDER)
def test_what_was_done_is_asked_or_told_about_and_nothing_moves(
    text: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == ("recall" if text in RECALLED else "clarify not_understood")


@pytest.mark.parametrize(("text", "steps"), STILL_ORDERS.items())
def test_an_order_or_a_look_in_such_words_is_read(
    text: str, steps: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == steps


def test_where_the_robot_is_it_tells(understood: Callable[[str], str]) -> None:
    assert understood("are you in the kitchen?") == "answer: I am in the study."
