"""Small talk is answered, in both languages, and moves nothing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable

HELLO = ("hello", "morning!", "good afternoon, robot", "嗨，你好呀", "机器人，早上好", "早")
THANKS = (
    *("cheers", "thanks mate", "many thanks", "great job", "you're the best", "you did well"),
    *(
        "that's all for now",
        "谢谢啊",
        "谢谢你哦",
        "辛苦你了",
        "你真聪明",
        "好样的",
        "没事了",
        "多谢了",
    ),
)
BYE = ("good night", "bye bye", "goodbye, robot", "晚安", "再见", "拜拜啦")
NONE = (
    *("you're in the kitchen", "you are lovely in the kitchen", "good kitchen", "early morning"),
    *("没事去厨房", "告诉我", "好厨房"),
)


@pytest.mark.parametrize("text", HELLO)
def test_a_greeting_is_greeted(text: str, understood: Callable[[str], str]) -> None:
    assert understood(text) == "answer: Hello. Tell me where to go."


@pytest.mark.parametrize("text", THANKS)
def test_thanks_and_praise_are_taken(text: str, understood: Callable[[str], str]) -> None:
    assert understood(text) == "answer: You are welcome."


@pytest.mark.parametrize("text", BYE)
def test_who_leaves_is_not_greeted(text: str, understood: Callable[[str], str]) -> None:
    assert understood(text) == "answer: Until later."


def test_two_in_one_sentence_are_one_answer(understood: Callable[[str], str]) -> None:
    told = understood("机器人你好，今天怎么样")
    assert told == "answer: I have no moods, and I am ready to drive."


@pytest.mark.parametrize("text", NONE)
def test_what_names_a_place_beside_is_asked_about(
    text: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == "clarify not_understood"
