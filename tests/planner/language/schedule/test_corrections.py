"""Corrections of standing orders as people say them, and the laws of their reading."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.language.commands import Replace
from planner.language.schedule import (
    ChangeOrders,
    CorrectOrder,
    Delay,
    LeaveOutDays,
    OrderChange,
    RemindAgain,
    Retime,
    ScheduleCommand,
    can_lean,
    read_order_command,
)
from planner.language.schedule.parts import Interval, OnceDay, TimeOfDay
from planner.language.sentence import parse
from planner.plan.timing import CronRule, DayTime, InRule

NINE, EIGHT = TimeOfDay(9), TimeOfDay(8)
SUNDAY, WORKDAYS = frozenset({0}), frozenset({1, 2, 3, 4, 5})
SAID: tuple[tuple[str, OrderChange], ...] = (
    ("make it nine instead", Retime((NINE,))), ("at nine, not eight", Retime((NINE,), (EIGHT,))),
    ("not at eight, at nine", Retime((NINE,), (EIGHT,))), ("no, at nine", Retime((NINE,))),
    ("every hour instead", Retime((Interval(3600.0),))), ("I meant nine", Retime((NINE,))),
    ("make it tomorrow at nine", Retime((OnceDay(ahead=1), NINE))),
    ("not on Sundays", LeaveOutDays(SUNDAY)), ("only on weekdays", LeaveOutDays(WORKDAYS, True)),
    ("another five minutes", RemindAgain(300.0)), ("give me five more minutes", RemindAgain(300.0)),
    ("snooze", RemindAgain()), ("snooze for half an hour", RemindAgain(1800.0)),
    ("remind me again in five minutes", RemindAgain(300.0)),
    ("make it ten minutes later", Delay(600.0)), ("half an hour earlier", Delay(-1800.0)),
    ("改成九点", Retime((NINE,))), ("不是八点，是九点", Retime((NINE,), (EIGHT,))),
    ("应该是九点", Retime((NINE,))), ("改成每小时", Retime((Interval(3600.0),))),
    ("周日不用", LeaveOutDays(SUNDAY)), ("只在工作日", LeaveOutDays(WORKDAYS, True)),
    ("再过五分钟叫我", RemindAgain(300.0)),
    ("五分钟后再提醒我", RemindAgain(300.0)), ("贪睡", RemindAgain()),
    ("再睡五分钟", RemindAgain(300.0)),
    ("推迟半小时", Delay(1800.0)), ("提前十分钟", Delay(-600.0)),
)  # fmt: skip
NAMED: tuple[tuple[str, str, OrderChange], ...] = (
    ("move the evening check to nine", "evening check", Retime((NINE,))),
    ("change my pill reminder to nine", "pill reminder", Retime((NINE,))),
    ("postpone the cake reminder by ten minutes", "cake reminder", Delay(600.0)),
    ("change order o3: make it nine", "o3", Retime((NINE,))),
    ("把早上的提醒改成九点", "早上的提醒", Retime((NINE,))),
    ("把提醒推迟十分钟", "提醒", Delay(600.0)),
    ("更改任务o3：改成九点", "o3", Retime((NINE,))),
)  # fmt: skip
NONE = (
    "make it quick", "not on the table", "move it to the left", "move the robot to the kitchen",
    "give me five minutes", "just a minute", "only the kitchen", "not the bedroom, the kitchen",
    "go to the kitchen instead", "no, the study", "make it the desk", "skip the kitchen",
    "another cup", "five more metres", "move two metres back", "not now", "not in the kitchen",
    "改成厨房", "不是卧室，是书房", "我说的是厨房", "再等一会儿", "推桌子", "晚上好", "只去厨房",
    "不用了", "再走五米", "早点回来",
)  # fmt: skip
COURTESIES = (("please ", ""), ("", " please"), ("hey robot, ", ""), ("could you ", ", thanks"),
              ("ok, ", "!"))  # fmt: skip
COURTESIES_ZH = (("请", ""), ("麻烦你", ""), ("机器人，", "吧"), ("", "，谢谢"), ("", "好吗"))


def change_of(text: str) -> OrderChange | None:
    command = read_order_command(text)
    return command.change if isinstance(command, CorrectOrder) else None


@pytest.mark.parametrize(("text", "change"), SAID)
def test_a_correction_is_read(text: str, change: OrderChange) -> None:
    assert change_of(text) == change
    command = parse(text).intent
    assert isinstance(command, CorrectOrder)
    assert can_lean(command)
    assert not parse(text).stays_put, "a brain may read it, so it needs what an order needs"


@pytest.mark.parametrize(("text", "which", "change"), NAMED)
def test_a_correction_of_a_named_order_is_read(text: str, which: str, change: OrderChange) -> None:
    command = read_order_command(text)
    assert isinstance(command, CorrectOrder)
    assert (command.which, command.change) == (which, change)
    again = read_order_command(f"change order o7: {command.words}")
    assert isinstance(again, CorrectOrder), "what is offered where several fit is read again"
    assert (again.which, again.change, again.is_sure) == ("o7", change, True)


@pytest.mark.parametrize("text", NONE)
def test_what_names_no_time_is_no_correction(text: str) -> None:
    assert change_of(text) is None
    assert not isinstance(parse(text).intent, CorrectOrder)


@given(st.sampled_from(SAID), st.data())
@settings(max_examples=50)
def test_courtesies_change_no_correction(
    said: tuple[str, OrderChange], data: st.DataObject
) -> None:
    text, change = said
    frames = COURTESIES if text.isascii() else COURTESIES_ZH
    before, after = data.draw(st.sampled_from(frames))
    assert change_of(f"{before}{text}{after}") == change, (before, text, after)


FORMS = ("make it {}", "no, at {}", "I meant {}", "move it to {}", "set it to {} instead",
         "改成{}点", "应该是{}点")  # fmt: skip


@given(st.integers(1, 12), st.sampled_from(FORMS))
@settings(max_examples=40)
def test_the_hour_that_is_said_is_the_hour_that_is_read(hour: int, form: str) -> None:
    assert change_of(form.format(hour)) == Retime((TimeOfDay(hour),))


@given(st.integers(1, 12), st.integers(1, 12))
@settings(max_examples=40)
def test_word_order_and_language_change_nothing(hour: int, other: int) -> None:
    wanted = Retime((TimeOfDay(hour),), (TimeOfDay(other),))
    forms = ("at {0}, not {1}", "not at {1}, at {0}", "make it {0}, not {1}", "{0} instead of {1}",
             "是{0}点，不是{1}点", "不是{1}点，是{0}点")  # fmt: skip
    assert {change_of(form.format(hour, other)) for form in forms} == {wanted}


def test_what_corrects_a_drive_stays_the_drives() -> None:
    assert parse("no, the study").intent is None
    assert isinstance(parse("go to the kitchen instead").intent, Replace)


def test_a_reminder_of_its_own_is_kept_where_nothing_is_to_be_said_again() -> None:
    command = read_order_command("再过五分钟叫我")
    assert isinstance(command, CorrectOrder)
    assert isinstance(command.otherwise, ScheduleCommand)
    assert command.otherwise.when == InRule(seconds=300.0)


MONDAY, TOMORROW = DayTime(hour=0, weekday=0), DayTime(hour=0, days_ahead=1)


@pytest.mark.parametrize(
    ("text", "command"),
    [
        ("cancel the reminder", ChangeOrders("remove", "", reminders=True, is_single=True)),
        ("cancel my reminder", ChangeOrders("remove", "", reminders=True, is_single=True)),
        ("cancel all my reminders", ChangeOrders("remove", "", reminders=True, is_every=True)),
        ("cancel the one at eight", ChangeOrders("remove", "at eight")),
        ("delete the good morning one", ChangeOrders("remove", "good morning", is_sure=False)),
        ("no more patrols in the evening",
         ChangeOrders("remove", "patrols in the evening", is_sure=False)),
        ("stop saying hello when somebody comes in",
         ChangeOrders("remove", "saying hello when somebody comes in")),
        ("pause the evening check until Monday",
         ChangeOrders("pause", "evening check", until=MONDAY, until_words="until monday")),
        ("pause my reminders for an hour",
         ChangeOrders("pause", "", reminders=True, until=InRule(seconds=3600.0),
                      until_words="for an hour")),
        ("skip the evening check tonight",
         ChangeOrders("skip", "evening check", day=OnceDay(ahead=0), until_words="tonight",
                      is_sure=False)),
        ("don't check the door tonight",
         ChangeOrders("skip", "check the door", day=OnceDay(ahead=0), until_words="tonight",
                      is_sure=False)),
        ("今晚别去厨房了",
         ChangeOrders("skip", "去厨房", day=OnceDay(ahead=0), until_words="今晚", is_sure=False)),
        ("跳过今晚的检查",
         ChangeOrders("skip", "检查", day=OnceDay(ahead=0), until_words="今晚", is_sure=False)),
        ("取消提醒", ChangeOrders("remove", "", reminders=True, is_single=True)),
        ("取消所有提醒", ChangeOrders("remove", "", reminders=True, is_every=True)),
        ("把早上那个取消", ChangeOrders("remove", "早上", is_sure=False)),
        ("晚上别再检查门了", ChangeOrders("remove", "晚上检查门", is_sure=False)),
        ("每天晚上别再检查门了", ChangeOrders("remove", "每天晚上检查门")),
        ("把每晚的检查暂停到周一",
         ChangeOrders("pause", "每晚的检查", until=MONDAY, until_words="到周一")),
    ],
)  # fmt: skip
def test_words_that_remove_or_pause_are_read(text: str, command: ChangeOrders) -> None:
    assert read_order_command(text) == command


@pytest.mark.parametrize("text", ["cancel the drive", "cancel it", "周末就不用了", "别再去厨房了",
                                  "don't go to the kitchen", "pause until Monday",
                                  "晚上就别说了", "周末就别叫我了", "晚上别去厨房",
                                  "任务失败的时候，别难过，就喊吃饭了",
                                  "有人来的时候别害怕",
                                  "don't be sad, say dinner any more"])  # fmt: skip
def test_what_names_no_order_removes_none(text: str) -> None:
    assert not isinstance(read_order_command(text), ChangeOrders)


@pytest.mark.parametrize(
    ("text", "seconds"),
    [("提前十分钟", -600.0), ("往后推一小时", 3600.0)],
)
def test_an_order_is_moved_in_chinese(text: str, seconds: float) -> None:
    command = read_order_command(text)
    assert isinstance(command, CorrectOrder)
    assert command.change == Delay(seconds)


@pytest.mark.parametrize("text", ["桌子太长了，换个地方", "还是去客厅吧", "还是算了吧"])
def test_what_is_no_time_corrects_nothing_in_chinese(text: str) -> None:
    assert not isinstance(read_order_command(text), CorrectOrder)


def test_a_span_of_days_is_each_of_them() -> None:
    command = read_order_command("只要周一到周五就行")
    assert isinstance(command, CorrectOrder)
    assert command.change == LeaveOutDays(frozenset({1, 2, 3, 4, 5}), keeps=True)
    order = read_order_command("每周五到周日早上九点说早安")
    assert isinstance(order, ScheduleCommand)
    assert order.when == CronRule(cron="0 9 * * 0,5,6")


@pytest.mark.parametrize(("text", "day"), [
    ("not on Sunday", OnceDay(weekday=6)), ("not tomorrow", OnceDay(ahead=1)),
    ("but not on Friday please", OnceDay(weekday=4)), ("这周日不用", OnceDay(weekday=6, week=0)),
    ("明天不用了", OnceDay(ahead=1)),
])  # fmt: skip
def test_one_day_is_left_out_of_the_order_that_was_spoken_of(text: str, day: OnceDay) -> None:
    command = read_order_command(text)
    assert isinstance(command, ChangeOrders)
    assert (command.act, command.which, command.day) == ("skip", "", day)
    assert command.is_spoken
    assert can_lean(command)
