"""Times in the middle of an order, orders that begin later, and those that would have an end."""

from __future__ import annotations

import pytest

from planner.language.schedule import ScheduleCommand, read_order_command
from planner.language.schedule.parts import OnceDay

TIMES = ("at six", "at noon", "at ten every night", "tomorrow at nine", "every evening at eight",
         "in ten minutes", "every Sunday at five in the afternoon")  # fmt: skip
ORDERS = (("go to the fridge", "and say hello"),
          ("have a look round the house", "and tell me who's in"),
          ("patrol all the rooms", ", then go to the sofa"),
          ("check the front door", "and then come to the sofa"))  # fmt: skip


def read(text: str) -> ScheduleCommand:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand), (text, command)
    return command


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize(("first", "then"), ORDERS)
def test_a_time_in_the_middle_is_the_one_before(time: str, first: str, then: str) -> None:
    whole = f"{first}{'' if then.startswith(',') else ' '}{then}"
    before = read(f"{time}, {whole}")
    for lead in ("", "please ", "set yourself to "):
        middle = read(f"{lead}{first} {time}{'' if then.startswith(',') else ' '}{then}")
        assert (middle.when, middle.order) == (before.when, whole)


def test_what_explains_the_time_is_no_part_of_the_order() -> None:
    text = "look round the house every night before I go to bed, say at ten, and tell me who's in"
    plain = read("look round the house at ten every night, and tell me who's in")
    assert (read(text).when, read(text).order) == (plain.when, plain.order)


@pytest.mark.parametrize(
    "text",
    ["go to the kitchen and tell Dad dinner is at six and come back",
     "go to the kitchen, wait until six and come back", "say lunch is at six and come back",
     "go to the kitchen for ten minutes and come back", "tell Mia the bus goes at six and wait",
     "go to the kitchen at six or at seven and say hello",
     'go to the kitchen, say "we eat at six" and come back'],
)  # fmt: skip
def test_the_time_of_what_is_said_or_waited_for_is_not_the_orders(text: str) -> None:
    assert not isinstance(read_order_command(text), ScheduleCommand)


@pytest.mark.parametrize("words", ["from Monday on", "starting Monday", "as of Monday",
                                   "from Monday onwards", "beginning on Monday"])  # fmt: skip
def test_an_order_begins_on_the_day_that_is_said(words: str) -> None:
    order = "every night at eleven patrol the rooms"
    for text in (f"{words}, {order}", f"{order}, {words}"):
        command = read(text)
        assert command.begins == OnceDay(weekday=0), text
        assert (command.when, command.order) == (read(order).when, "patrol the rooms"), text


@pytest.mark.parametrize("words", ["from today on", "from now on", "starting tonight"])
def test_from_now_on_is_no_later_day(words: str) -> None:
    command = read(f"{words}, every night at eleven patrol the rooms")
    assert command.begins is None
    assert command.problem is None


@pytest.mark.parametrize("text", ["from the kitchen go to the study", "from Monday go to the study",
                                  "starting from the kitchen, go to the study",
                                  "from Monday remind me at six to eat"])  # fmt: skip
def test_what_comes_once_begins_on_no_day(text: str) -> None:
    assert not isinstance(read_order_command(text), ScheduleCommand)


@pytest.mark.parametrize(
    "text",
    ["every ten minutes for the next hour check the kitchen", "every day this week at noon, say hi",
     "every day for a week remind me to take my pills at eight",
     "every hour look for the cat for the rest of the day"],
)  # fmt: skip
def test_an_order_with_an_end_is_refused_and_no_end_dropped(text: str) -> None:
    command = read(text)
    assert command.when is None
    assert command.problem == "order_no_end"


@pytest.mark.parametrize("time", ["at sunset", "at dinner time", "at bedtime", "when it gets dark"])
def test_a_time_that_no_clock_tells_is_asked_for(time: str) -> None:
    for text in (f"{time} go to the dock", f"go to the dock {time}"):
        command = read(text)
        assert (command.problem, command.order) == ("order_time_missing", "go to the dock"), text


@pytest.mark.parametrize(
    ("text", "same"),
    [("each weekday evening at quarter past six say hello", "on weekdays at 18:15 say hello"),
     ("every weekend morning at nine say hello", "at weekends at 9:00 say hello"),
     ("in two hours' time say hello", "in two hours say hello"),
     ("when it's eight o'clock, say hello", "at eight o'clock say hello"),
     ("at noon say hello", "at 12:00 say hello")],
)  # fmt: skip
def test_the_same_time_in_other_words(text: str, same: str) -> None:
    assert (read(text).when, read(text).order) == (read(same).when, read(same).order)
