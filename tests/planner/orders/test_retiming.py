"""Corrected rules: what was not said stays, and what can't be is refused."""

from __future__ import annotations

from datetime import datetime

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.language.schedule import CorrectOrder, OrderChange, read_order_command
from planner.orders.errors import OrderRefusal
from planner.orders.retiming import WeeklyTime, correct_rule, read_weekly
from planner.plan.timing import AtRule, CronRule, EventRule, EveryRule, Rule, WorldEvent
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S

DAILY, WEEKDAYS = CronRule(cron="0 20 * * *"), CronRule(cron="0 20 * * 1-5")
TONIGHT = AtRule(unix_s=NOON_UNIX_S + 8 * 3600.0)
HALF_HOURS = EveryRule(seconds=1800.0, anchor_unix_s=NOON_UNIX_S)
COMES = EventRule(event=WorldEvent.PERSON_SEEN)


def change_of(text: str) -> OrderChange:
    command = read_order_command(text)
    assert isinstance(command, CorrectOrder), text
    return command.change


def after(rule: Rule, text: str) -> Rule:
    return correct_rule(rule, change_of(text), NOON_UNIX_S, BERLIN)


@pytest.mark.parametrize(
    ("rule", "text", "cron"),
    [
        (DAILY, "make it nine", "0 21 * * *"), (WEEKDAYS, "make it nine", "0 21 * * 1-5"),
        (CronRule(cron="0 8 * * *"), "make it nine", "0 9 * * *"),
        (CronRule(cron="0 8 * * *"), "make it twelve", "0 12 * * *"),
        (DAILY, "make it nine in the morning", "0 9 * * *"),
        (DAILY, "make it 7:30 am", "30 7 * * *"),
        (DAILY, "not on Sundays", "0 20 * * 1,2,3,4,5,6"),
        (DAILY, "only on weekdays", "0 20 * * 1-5"),
        (DAILY, "make it Mondays", "0 20 * * 1"), (DAILY, "every hour instead", "0 * * * *"),
        (CronRule(cron="0 * * * *"), "only on weekdays", "0 * * * 1-5"),
        (DAILY, "make it half an hour later", "30 20 * * *"),
        (CronRule(cron="30 23 * * 5"), "make it an hour later", "30 0 * * 6"),
        (CronRule(cron="30 0 * * 0"), "make it an hour earlier", "30 23 * * 6"),
        (CronRule(cron="0 20 * * 1"), "make it Friday", "0 20 * * 5"),
        (COMES, "make it every day at nine in the evening", "0 21 * * *"),
        (DAILY, "改成九点", "0 21 * * *"), (DAILY, "周日不用", "0 20 * * 1,2,3,4,5,6"),
        (DAILY, "只在工作日", "0 20 * * 1-5"), (DAILY, "推迟半小时", "30 20 * * *"),
    ],
)  # fmt: skip
def test_what_comes_again_is_corrected(rule: Rule, text: str, cron: str) -> None:
    assert after(rule, text) == CronRule(cron=cron)


@pytest.mark.parametrize(
    ("text", "due"),
    [
        ("make it nine", "01-15 21:00"), ("make it tomorrow", "01-16 20:00"),
        ("make it tomorrow at nine", "01-16 21:00"), ("make it ten minutes later", "01-15 20:10"),
        ("in ten minutes instead", "01-15 12:10"), ("on 28 March instead", "03-28 20:00"),
        ("改成明天", "01-16 20:00"), ("提前一小时", "01-15 19:00"),
    ],
)  # fmt: skip
def test_what_comes_once_is_corrected(text: str, due: str) -> None:
    rule = after(TONIGHT, text)
    assert isinstance(rule, AtRule)
    assert datetime.fromtimestamp(rule.unix_s, BERLIN).strftime("%m-%d %H:%M") == due


@pytest.mark.parametrize(
    ("rule", "text", "code"),
    [
        (TONIGHT, "not on Sundays", "order_change_unfit"),
        (HALF_HOURS, "not on Sundays", "order_change_unfit"),
        (HALF_HOURS, "make it nine", "order_change_unfit"),
        (COMES, "make it nine", "order_change_unfit"),
        (COMES, "make it ten minutes later", "order_change_unfit"),
        (DAILY, "make it tomorrow", "order_change_unfit"),
        (CronRule(cron="*/30 8-20 * * *"), "only on weekdays", "order_change_unfit"),
        (DAILY, "make it eight", "order_change_none"),
        (WEEKDAYS, "only on weekdays", "order_change_none"),
        (WEEKDAYS, "not at weekends", "order_change_none"),
        (CronRule(cron="0 20 * * 0"), "not on Sundays", "order_never"),
        (DAILY, "every minute instead", "order_too_often"),
        (TONIGHT, "make it ten in the morning", "order_in_past"),
        (TONIGHT, "make it 9 hours earlier", "order_in_past"),
        (TONIGHT, "on 29 February instead", "order_no_such_date"),
        (TONIGHT, "on 31 June instead", "order_no_such_date"),
    ],
)  # fmt: skip
def test_what_can_not_be_is_refused(rule: Rule, text: str, code: str) -> None:
    with pytest.raises(OrderRefusal) as refused:
        after(rule, text)
    assert refused.value.code == code
    assert refused.value.message.en != refused.value.message.zh


DAYS = st.frozensets(st.integers(0, 6), min_size=1)


@given(st.integers(0, 59), st.one_of(st.none(), st.integers(0, 23)), DAYS)
@settings(max_examples=50)
def test_a_weekly_time_is_read_as_it_is_written(
    minute: int, hour: int | None, days: frozenset[int]
) -> None:
    time = WeeklyTime(minute, hour, days)
    assert read_weekly(time.rule) == time


@given(st.integers(0, 23), DAYS, st.integers(1, 12))
@settings(max_examples=50)
def test_another_hour_keeps_the_days_and_is_that_hour_on_a_dial(
    hour: int, days: frozenset[int], said: int
) -> None:
    before = WeeklyTime(0, hour, days)
    if (said - hour) % 12 == 0:
        return
    rule = read_weekly(after(before.rule, f"make it {said}"))
    assert rule is not None
    assert rule.hour is not None
    assert (rule.days, (rule.hour - said) % 12) == (days, 0)
    assert min((rule.hour - hour) % 24, (hour - rule.hour) % 24) <= 6


@given(st.integers(0, 23), DAYS, st.integers(1, 180))
@settings(max_examples=50)
def test_later_and_earlier_take_each_other_back(
    hour: int, days: frozenset[int], minutes: int
) -> None:
    rule = WeeklyTime(0, hour, days).rule
    later = after(rule, f"make it {minutes} minutes later")
    assert after(later, f"make it {minutes} minutes earlier") == rule
