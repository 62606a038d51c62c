"""The hours of the day to which an order upon an event is kept, and what names none."""

from __future__ import annotations

import pytest

from planner.language.schedule import CorrectOrder, KeepHalf, KeepToHours, read_order_command
from planner.language.schedule.parts import DayPart


@pytest.mark.parametrize(
    ("text", "hours"),
    [
        ("only after four o'clock though", "16:00-00:00"),
        ("only after four o'clock though, when the kids are back", "16:00-00:00"),
        ("not after ten at night", "06:00-22:00"),
        ("not before eight in the morning", "08:00-00:00"),
        ("only between nine and five in the afternoon", "21:00-17:00"),
        ("only at night", "22:00-06:00"), ("only in the evenings", "17:00-23:00"),
        ("晚上十点以后就别说了", "06:00-22:00"), ("下午四点以后才说", "16:00-00:00"),
        ("晚上十点以后就别说了，会吵到宝宝", "06:00-22:00"), ("只在晚上", "17:00-23:00"),
    ],
)  # fmt: skip
def test_hours_are_read(text: str, hours: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, CorrectOrder)
    assert command.change == KeepToHours(hours)


@pytest.mark.parametrize(
    ("text", "part"),
    [("afternoon, of course", DayPart.AFTERNOON), ("in the morning", DayPart.MORNING),
     ("the evening, I mean", DayPart.EVENING), ("当然是下午", DayPart.AFTERNOON)],
)  # fmt: skip
def test_the_half_of_the_day_is_read(text: str, part: DayPart) -> None:
    command = read_order_command(text)
    assert isinstance(command, CorrectOrder)
    assert command.change == KeepHalf(part)
    assert not command.is_sure, "it may be about something else"


@pytest.mark.parametrize(
    "text",
    ["only after dinner", "not before the kids", "after four cups", "only the kitchen", "afternoon",
     "good afternoon", "晚上十点以后别在卧室转悠了", "十分钟以后别说了", "只去厨房", "下午好"],
)  # fmt: skip
def test_what_is_no_time_of_day_keeps_to_no_hours(text: str) -> None:
    command = read_order_command(text)
    change = command.change if isinstance(command, CorrectOrder) else None
    assert not isinstance(change, KeepToHours | KeepHalf)
