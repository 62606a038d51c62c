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


@pytest.mark.parametrize(
    "text",
    ["good morning robot, go to the kitchen please", "good evening. go to the kitchen",
     "hello, go to the kitchen", "早上好，去厨房", "你好，请去厨房"],
)  # fmt: skip
def test_a_greeting_before_an_order_is_no_part_of_it(
    text: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == "kitchen"


@pytest.mark.parametrize("text", THANKS)
def test_thanks_and_praise_are_taken(text: str, understood: Callable[[str], str]) -> None:
    assert understood(text) == "answer: You are welcome."


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("what can you do then? I'm just staying the weekend", "I drive to rooms"),
        ("So what can this thing actually do? What can you do?", "I drive to rooms"),
        ("can you recognise people's faces or just that there's a person?", "know no faces"),
        ("do you know who I am", "know no faces"), ("what languages do you speak", "Mandarin"),
        ("have you got arms", "no arms"), ("你都会干点儿啥", "rooms"), ("你认得我吗", "no faces"),
        ("你听得懂广东话吗", "Mandarin"),
    ],
)  # fmt: skip
def test_a_question_about_itself_is_answered(
    text: str, part: str, understood: Callable[[str], str]
) -> None:
    assert understood(text).startswith("answer: ")
    assert part in understood(text)


@pytest.mark.parametrize(
    "text", ["can you recognise the kitchen", "can you tell the cat to go", "do you speak to Anna"]
)
def test_what_asks_of_something_else_is_not(text: str, understood: Callable[[str], str]) -> None:
    assert not understood(text).startswith("answer: I ")


@pytest.mark.parametrize("text", BYE)
def test_who_leaves_is_not_greeted(text: str, understood: Callable[[str], str]) -> None:
    assert understood(text) == "answer: See you later."


def test_two_in_one_sentence_are_one_answer(understood: Callable[[str], str]) -> None:
    told = understood("机器人你好，今天怎么样")
    assert told == "answer: I have no moods, and I am ready to drive."


@pytest.mark.parametrize("text", NONE)
def test_what_names_a_place_beside_is_asked_about(
    text: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == "clarify not_understood"
