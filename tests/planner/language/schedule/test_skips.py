"""Orders that are left out on one day: what is read, and what never is."""

from __future__ import annotations

import pytest

from planner.language.schedule import ChangeOrders, read_order_command
from planner.language.schedule.parts import OnceDay

TOMORROW, SATURDAY = OnceDay(ahead=1), OnceDay(weekday=5)
DAYS = (("tomorrow", TOMORROW), ("on Saturday", SATURDAY))
DENIALS = ("don't wake me {}", "do not wake me {}", "you needn't wake me {}",
           "there's no need to wake me {}", "skip wake me {}", "no wake me {}",
           "please don't wake me {}",
           )  # fmt: skip


@pytest.mark.parametrize(("words", "day"), DAYS)
@pytest.mark.parametrize("form", DENIALS)
def test_one_day_is_left_out_and_nothing_dropped(form: str, words: str, day: OnceDay) -> None:
    command = read_order_command(form.format(words))
    assert command == ChangeOrders("skip", "wake me", day=day, until_words=words.lower(),
                                   is_sure=False)  # fmt: skip


@pytest.mark.parametrize("text", ["skip the pills tonight", "no pills today", "no pills tonight",

                                  "you don't have to do the pills tonight"])  # fmt: skip
def test_today_is_a_day_as_any(text: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ChangeOrders), text
    assert (command.act, command.day) == ("skip", OnceDay(ahead=0))
    assert command.which.endswith("pills")


@pytest.mark.parametrize(
    ("text", "which"),
    [("don't remind me tomorrow", ""), ("no reminders tomorrow", ""),
     ("don't remind me about the pills tomorrow", "the pills"),
     ("no pill reminder on Sunday", "pill"), ("you needn't remind me of Sam tomorrow", "sam"),
     ("skip the reminder tomorrow", ""), ("skip order o2 on sunday", "o2")],
)  # fmt: skip
def test_the_reminder_is_named(text: str, which: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ChangeOrders)
    assert command.day is not None
    assert command.which == which
    assert command.reminders is (which != "o2")


@pytest.mark.parametrize(
    "text",
    ["don't forget to wake me tomorrow", "don't wake me tomorrow if it rains",
     "don't wake me before nine tomorrow", "don't wake me until Monday", "wake me tomorrow",
     "don't let me forget the bins tomorrow", "don't wake me tomorrow but go to the kitchen",
     "don't wake me tomorrow, go to the kitchen", "skip the reminder tomorrow and go to the sofa",
     "every day at seven wake me, but not on Sundays", "don't wake me every Saturday"],
)  # fmt: skip
def test_a_limit_a_condition_or_a_second_order_is_no_day_left_out(text: str) -> None:
    command = read_order_command(text)
    assert not (isinstance(command, ChangeOrders) and command.day is not None), command
