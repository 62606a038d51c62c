"""What a person wants to be told or asked at a time, and what they call a reminder."""

from __future__ import annotations

import pytest

from planner.language.schedule import ScheduleCommand, read_order_command
from planner.language.schedule.tellings import turn_question
from planner.plan.timing import CronRule, DayTime, InRule

TIMES = ("at six", "every evening at eight", "in twenty minutes", "tomorrow at noon",
         "every hour", "on Thursday nights")  # fmt: skip


def read(text: str) -> ScheduleCommand:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand), (text, command)
    return command


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("polite", ["", "please ", "could you ", "I'd like you to "])
def test_tell_me_to_is_a_reminder_wherever_the_time_stands(time: str, polite: str) -> None:
    same = read(f"remind me {time} to feed the cat")
    for text in (f"{time}, {polite}tell me to feed the cat",
                 f"{polite}tell me {time} to feed the cat",
                 f"{polite}tell me to feed the cat {time}",
                 f"{polite}give me a nudge {time} to feed the cat",
                 f"{polite}set a reminder {time} to feed the cat"):  # fmt: skip
        assert (read(text).when, read(text).reminder) == (same.when, "feed the cat"), text


@pytest.mark.parametrize("time", TIMES)
def test_a_question_is_turned_to_the_person(time: str) -> None:
    for text in (f"{time} ask me whether I've taken my pills",
                 f"ask me {time} if I have taken my pills"):  # fmt: skip
        assert read(text).reminder == "Have you taken your pills?", text


@pytest.mark.parametrize(
    ("said", "asked"),
    [("I've been for my walk", "Have you been for your walk?"), ("I'm hungry", "Are you hungry?"),
     ("I need my coat", "Do you need your coat?"), ("I was out", "Were you out?"),
     ("the back door is locked", "Is the back door locked?"),
     ("my daughter has called", "Has your daughter called?"), ("it's raining", "Is it raining?"),
     ("I still need you", None), ("I ate", None), ("to go", None)],
)  # fmt: skip
def test_what_can_not_be_turned_is_none(said: str, asked: str | None) -> None:
    assert turn_question(said) == asked


@pytest.mark.parametrize(
    "text",
    ["at six tell me to go to bed and then go to the kitchen", "tell me to go to the kitchen",
     "ask me in an hour whether I've eaten, and if I say no, remind me again",
     "at six tell me to eat unless Mum is here", "at six tell me what you see",
     "remind me in ten minutes, and then go to the kitchen",
     "wake me up at seven and tell me the weather",
     "wake me up at nine, like actually come into the bedroom and say it five times"],
)  # fmt: skip
def test_what_goes_on_with_another_order_or_a_condition_is_no_reminder(text: str) -> None:
    command = read_order_command(text)
    assert not (isinstance(command, ScheduleCommand) and command.reminder is not None), command


@pytest.mark.parametrize("what", ["feed the fish at eight and at six every day",
                                  "feed the fish at eight and six every day"])  # fmt: skip
def test_of_two_times_none_is_dropped(what: str) -> None:
    assert read(f"remind me to {what}").problem == "order_nested"


@pytest.mark.parametrize(
    ("text", "when", "words"),
    [
        ("set a timer for ten minutes", InRule(seconds=600.0), ""),
        ("set a ten-minute timer for the eggs", InRule(seconds=600.0), "the eggs"),
        ("set an alarm for half an hour", InRule(seconds=1800.0), ""),
        ("set an alarm for seven tomorrow", DayTime(hour=7, days_ahead=1), ""),
        ("wake me at quarter to seven tomorrow, please, I've got a train",
         DayTime(hour=6, minute=45, days_ahead=1), "time to get up"),
        ("every day at four wake me up", CronRule(cron="0 4 * * *"), "time to get up"),
        ("wake us at seven", DayTime(hour=7), "time to get up"),
        ("remind me of the dentist on Tuesday at two", DayTime(hour=14, weekday=1), "the dentist"),
        ("remind me tomorrow at three to call Sam", DayTime(hour=15, days_ahead=1), "call Sam"),
    ],
)  # fmt: skip
def test_when_people_mean_it_and_of_what(text: str, when: object, words: str) -> None:
    assert (read(text).when, read(text).reminder) == (when, words)
