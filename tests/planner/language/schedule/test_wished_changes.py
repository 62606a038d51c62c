"""Corrections that wish or compare, and what is none."""

from __future__ import annotations

import pytest

from planner.language.schedule import CorrectOrder, Delay, Retime, read_order_command
from planner.language.schedule.parts import TimeOfDay, WeekDays

HOURS = (("nine", 9), ("half past seven", 7), ("ten", 10))


@pytest.mark.parametrize(("words", "hour"), HOURS)
@pytest.mark.parametrize(
    ("form", "which"),
    [("{} would be better", ""), ("{} is better", ""), ("on second thoughts, {}", ""),
     ("I've changed my mind, {} is better", ""), ("come to think of it, make it {}", ""),
     ("the pill reminder should be at {}", "pill reminder"),
     ("could we move the pills to {}?", "pills"),
     ("I'd rather have the pill reminder at {}", "pill reminder"),
     ("the pills need to be at {}", "pills")],
)  # fmt: skip
def test_a_wish_is_a_change(form: str, which: str, words: str, hour: int) -> None:
    command = read_order_command(form.format(words))
    assert isinstance(command, CorrectOrder), command
    assert isinstance(command.change, Retime)
    assert isinstance(command.change.parts[0], TimeOfDay)
    assert (command.change.parts[0].hour, command.which) == (hour, which)


@pytest.mark.parametrize(
    ("text", "seconds", "which"),
    [("half an hour earlier would be better", -1800.0, ""),
     ("an hour later might be better", 3600.0, ""),
     ("can you do the pill reminder an hour earlier?", -3600.0, "pill reminder"),
     ("make the pills ten minutes later", 600.0, "pills")],
)  # fmt: skip
def test_a_length_is_a_delay(text: str, seconds: float, which: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, CorrectOrder)
    assert (command.change, command.which) == (Delay(seconds), which)


@pytest.mark.parametrize("text", ["on Fridays make it five", "make it five on Fridays",
                                  "on Fridays, make it five instead"])  # fmt: skip
def test_an_hour_of_some_days_names_the_hour_first(text: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, CorrectOrder)
    assert command.change == Retime((TimeOfDay(5), WeekDays(frozenset({5}))))


@pytest.mark.parametrize("text", ["the kitchen would be better", "the sofa is better",
                                  "on second thoughts, go to the kitchen", "that would be better",
                                  "can we go to the kitchen?", "the dinner should be nice",
                                  "the room should be clean"])  # fmt: skip
def test_what_is_no_time_corrects_nothing(text: str) -> None:
    assert not isinstance(read_order_command(text), CorrectOrder)
