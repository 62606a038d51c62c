"""Small talk is answered, in both languages, and moves nothing."""

from __future__ import annotations

from collections.abc import Callable

import pytest

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
GREETED_ORDERS = (
    *("good morning robot, go to the kitchen please", "good evening. go to the kitchen"),
    *("hello, go to the kitchen", "早上好，去厨房", "你好，请去厨房"),
)
TALK = {
    **dict.fromkeys(HELLO, "answer: Hello. Tell me where to go."),
    **dict.fromkeys(GREETED_ORDERS, "kitchen"),
    **dict.fromkeys(THANKS, "answer: You are welcome."),
    **dict.fromkeys(BYE, "answer: See you later."),
    **dict.fromkeys(NONE, "clarify not_understood"),
    "机器人你好，今天怎么样": "answer: I have no moods, and I am ready to drive.",
}


@pytest.mark.parametrize(("text", "told"), TALK.items())
def test_talk_is_answered_and_is_no_part_of_an_order(
    text: str, told: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == told


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
