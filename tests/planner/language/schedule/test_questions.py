"""A question about a day is no standing order, and nobody is asked for its hour."""

from __future__ import annotations

from itertools import product

import pytest

from planner.language.schedule import ChangeOrders, OrderCommand, ScheduleCommand
from planner.language.schedule.reader import read_order_command

ENGLISH = (
    "what is in my calendar", "which meetings do I have", "when is the dentist", "who comes",
    "where is the meeting", "why is it so cold", "how warm will it be",
    "is there anything in my mail",
    "are we out", "do I need an umbrella", "does the bin go out", "did the post come",
    "will it rain", "should I take a coat", "can I park there", "am I busy", "any news",
    "anything in my mail", "have I got school", "has Ana a lesson",
)  # fmt: skip
TOLD = (
    "tell me what is in my calendar", "please tell me when the dentist is",
    "let me know whether it rains", "show me which bins go out", "show me my calendar for",
)  # fmt: skip
CHINESE = (
    "我的日历里有什么", "几点开会", "有没有会", "有会议吗", "会不会下雨", "要不要带伞",
    "是不是放假",
    "谁来", "我们几点出门", "有多少个会", "多少度", "什么时候看牙医", "哪些垃圾要倒", "用不用带伞",
    "忙不忙",
)  # fmt: skip
DAYS = ("today", "tomorrow", "on Friday", "this evening", "the day after tomorrow", "tonight")
DAYS_ZH = ("今天", "明天", "后天", "今晚", "周五")
QUESTIONS = (
    *(f"{asked} {day}{end}" for asked, day, end in product(ENGLISH, DAYS, ("", "?"))),
    *(f"{asked} {day}" for asked, day in product(TOLD, DAYS)),
    *(f"{day}, {asked}" for asked, day in product(ENGLISH, DAYS)),
    *(f"{day}{asked}{end}" for asked, day, end in product(CHINESE, DAYS_ZH, ("", "？"))),
)


def orders(texts: tuple[str, ...]) -> dict[str, OrderCommand]:
    """Return those that are read as a new or a changed standing order."""
    read = {text: read_order_command(text) for text in texts}
    kinds = (ScheduleCommand, ChangeOrders)
    return {text: command for text, command in read.items() if isinstance(command, kinds)}


def test_no_question_about_a_day_is_a_standing_order() -> None:
    assert len(QUESTIONS) > 500
    assert orders(QUESTIONS) == {}


@pytest.mark.parametrize(
    "text",
    [
        "go to the kitchen tomorrow", "could you patrol the kitchen tomorrow",
        "will you go to the kitchen tomorrow?", "tomorrow, tell me who is here",
        "look into the kitchen tomorrow", "明天去厨房", "明天看看厨房有没有人",
        "明天去看看谁在厨房",
    ],
)  # fmt: skip
def test_a_deed_of_a_day_still_needs_its_hour(text: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand)
    assert command.problem == "order_time_missing"


@pytest.mark.parametrize(
    "text",
    ["every day at seven tell me what is on",
     "tomorrow at eight tell me who is in the kitchen", "明天八点告诉我谁在厨房"],
)  # fmt: skip
def test_a_question_with_an_hour_is_asked_then(text: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand)
    assert command.problem is None
