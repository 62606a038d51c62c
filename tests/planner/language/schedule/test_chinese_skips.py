"""What is left out for now or on some days is dropped for good by no words."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis.strategies import sampled_from

from planner.language.schedule import (
    ChangeOrders,
    CorrectOrder,
    LeaveOutDays,
    ScheduleCommand,
    read_order_command,
)
from planner.language.schedule.parts import OnceDay
from planner.plan.timing import DayTime, InRule

TOMORROW = DayTime(hour=0, days_ahead=1)
DAYS = sampled_from(
    (
        ("周末", {0, 6}),
        ("周六周日", {0, 6}),
        ("星期天", {0}),
        ("每周三", {3}),
        ("周一到周三", {1, 2, 3}),
    )
)
NOT = sampled_from(("不用", "就不用", "别", "不要", "都不必", "不需要"))
DOES = sampled_from(("", "叫", "叫我", "提醒我", "说", "去", "喊我"))
END = sampled_from(("", "了", "了哈", "了吧"))


@given(DAYS, NOT, DOES, END)
def test_days_of_the_week_are_left_out(
    day: tuple[str, set[int]], denial: str, does: str, end: str
) -> None:
    words, days = day
    command = read_order_command(f"{words}{denial}{does}{end}")
    assert isinstance(command, CorrectOrder)
    assert command.change == LeaveOutDays(frozenset(days))


@given(
    sampled_from(("今天不用了", "今天就算了", "今晚先别说了", "今天跳过")),
    sampled_from(("", "客人都来过了,", "我想多睡会儿,")),
    sampled_from(("明天再开始", "明天照旧", "明天继续吧", "以后照常")),
)
def test_today_alone_is_left_out(today: str, why: str, then: str) -> None:
    command = read_order_command(f"{today},{why}{then}")
    assert isinstance(command, ChangeOrders)
    assert (command.act, command.which, command.day) == ("skip", "", OnceDay(ahead=0))
    assert command.is_single
    assert not command.is_sure


@pytest.mark.parametrize("stop", ["先停了", "先停一下", "先关了", "先给我停掉"])
@pytest.mark.parametrize("named", ["把晚安那个", "晚安那个", "叫起床的那个"])
def test_to_stop_for_now_is_no_removal(named: str, stop: str) -> None:
    command = read_order_command(f"{named}{stop}")
    assert isinstance(command, ChangeOrders)
    assert (command.act, command.until) == ("pause", None)


def test_a_pause_ends_after_so_long() -> None:
    command = read_order_command("把晚安那个停三天")
    assert isinstance(command, ChangeOrders)
    assert (command.act, command.until) == ("pause", InRule(seconds=3 * 86_400.0))


@pytest.mark.parametrize("text", ["明天不用叫了", "明天跳过一次", "下周六不用叫我了"])
def test_another_day_is_no_order_and_drops_nothing(text: str) -> None:
    command = read_order_command(text)
    assert not isinstance(command, ScheduleCommand)
    assert not (isinstance(command, ChangeOrders) and command.act == "remove")


@pytest.mark.parametrize("text", ["你先停一下", "车先停了", "灯先关了", "把它先停了", "停三天"])
def test_the_robot_and_the_house_are_no_orders(text: str) -> None:
    assert read_order_command(text) is None


def test_reminders_and_alarms_are_stopped_for_now_and_resumed() -> None:
    assert read_order_command("把闹钟先关了") == ChangeOrders("pause", "")
    assert read_order_command("把闹钟恢复了") == ChangeOrders("resume", "")
    week = read_order_command("提醒先停一周")
    assert isinstance(week, ChangeOrders)
    assert (week.act, week.reminders) == ("pause", True)
