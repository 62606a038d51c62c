"""A time that is over and what tells of before are never kept; about a time is that time."""

from __future__ import annotations

import pytest

from planner.language.schedule import ScheduleCommand, read_order_command
from planner.plan.timing import CronRule

OVER = (
    "yesterday at eight go to the kitchen", "remind me yesterday to take my pills",
    "go to the kitchen yesterday", "last night look in the kitchen", "昨天八点去厨房",
    "昨天提醒我吃药",
)  # fmt: skip
TOLD = (
    "yesterday the cat jumped from the sofa", "what did you see yesterday", "昨天去厨房看了看",
    "昨天八点谁去过厨房", "go to the place you found yesterday", "今晚有没有人来过走廊",
    "你今天去过哪些地方", "你今天都做了些什么",
)  # fmt: skip


@pytest.mark.parametrize("text", [*OVER, "at 8 yesterday go to the kitchen"])
def test_what_is_over_is_never_kept(text: str) -> None:
    command = read_order_command(text)
    assert not isinstance(command, ScheduleCommand) or command.problem == "order_in_past"


@pytest.mark.parametrize("text", TOLD)
def test_what_tells_or_asks_of_before_is_no_order(text: str) -> None:
    assert read_order_command(text) is None


def test_about_so_long_is_so_long() -> None:
    plain = read_order_command("in ten minutes go to the kitchen")
    about = read_order_command("in about ten minutes go to the kitchen")
    assert isinstance(plain, ScheduleCommand)
    assert isinstance(about, ScheduleCommand)
    assert (about.when, about.order) == (plain.when, plain.order)


@pytest.mark.parametrize(
    ("plain", "about"),
    [
        (
            "every evening at nine",
            ("about nine", "around nine", "at roughly nine", "at nine or so"),
        ),
        ("every day at 8:15", ("at about 8:15", "around 8:15", "at 8:15 or so")),
        ("每天晚上九点", ("每天晚上大概九点", "每天晚上差不多九点", "每天晚上九点左右")),
    ],
)
def test_about_a_time_is_that_time_and_no_word_of_the_order(
    plain: str, about: tuple[str, ...]
) -> None:
    order = "check the front door" if plain.isascii() else "看看大门"
    exact = read_order_command(f"{plain}, {order}")
    assert isinstance(exact, ScheduleCommand)
    day = plain.rsplit(" at ", 1)[0] if " at " in plain else ""
    for words in about:
        said = read_order_command(f"{day} {words}, {order}".strip())
        assert isinstance(said, ScheduleCommand)
        assert (said.when, said.order) == (exact.when, order)


@pytest.mark.parametrize(
    ("text", "cron"),
    [
        ("every day at three, count the cups", "0 15 * * *"),
        ("every morning at three, count the cups", "0 3 * * *"),
        ("every day at five thirty, wake me up", "30 5 * * *"),
        ("每天三点数杯子", "0 15 * * *"),
        ("每天凌晨三点数杯子", "0 3 * * *"),
    ],
)
def test_an_hour_of_the_night_is_meant_only_where_the_night_is_named(text: str, cron: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand)
    assert isinstance(command.when, CronRule)
    assert command.when.cron == cron


def test_the_time_of_a_statement_is_not_that_of_the_order_behind_it() -> None:
    assert read_order_command("明早六点我出车，五点半到床边叫我") is None


def test_about_nine_bottles_is_no_time() -> None:
    command = read_order_command("every evening count about nine bottles")
    assert isinstance(command, ScheduleCommand)
    assert command.order == "count about nine bottles"


@pytest.mark.parametrize("end", ["until somebody comes", "till nine in the evening"])
def test_what_ends_by_itself_is_not_kept_for_ever(end: str) -> None:
    assert isinstance(read_order_command("every five minutes check the kitchen"), ScheduleCommand)
    for text in (f"every five minutes check the kitchen {end}", "每五分钟去厨房看看，直到有人来"):
        command = read_order_command(text)
        assert isinstance(command, ScheduleCommand)
        assert (command.when, command.problem) == (None, "order_no_end")


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("look round the house at ten every night, and tell me who's in", "order_time_within"),
        ("go to the kitchen every day at eight and then come back", "order_time_within"),
        ("say welcome to everyone who comes in", "order_no_event"),
        ("welcome each guest who arrives", "order_no_event"),
    ],
)
def test_what_waits_for_something_and_is_not_read_is_done_by_nobody_now(
    text: str, problem: str
) -> None:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand)
    assert (command.when, command.problem) == (None, problem)
