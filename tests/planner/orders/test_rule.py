"""When rules are due: over the nights when clocks change, and which rules can't be kept."""

from __future__ import annotations

from datetime import datetime, timedelta
from itertools import pairwise
from zoneinfo import ZoneInfo

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.orders.errors import OrderRefusal
from planner.orders.rule import is_quiet, judge, next_due, settle, upcoming
from planner.plan import QuietHours
from planner.plan.timing import (
    AtRule,
    CronRule,
    DayTime,
    EventRule,
    EveryRule,
    InRule,
    Rule,
    WorldEvent,
)
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S

ZONES = [BERLIN, ZoneInfo("America/New_York"), ZoneInfo("Australia/Lord_Howe"), ZoneInfo("UTC"),
         ZoneInfo("Asia/Shanghai")]  # fmt: skip


def at(text: str, fold: int = 0) -> float:
    return datetime.fromisoformat(text).replace(tzinfo=BERLIN, fold=fold).timestamp()


def shown(rule: Rule, after_s: float, count: int) -> list[str]:
    due = upcoming(rule, after_s, BERLIN, count)
    return [datetime.fromtimestamp(s, BERLIN).isoformat(timespec="minutes") for s in due]


def test_a_time_that_a_spring_night_leaves_out_is_due_as_it_ends() -> None:
    rule = CronRule(cron="30 2 * * *")
    assert shown(rule, at("2027-03-27T12:00"), 2) == [
        "2027-03-28T03:00+02:00",
        "2027-03-29T02:30+02:00",
    ]


def test_a_time_that_an_autumn_night_has_twice_is_due_once() -> None:
    rule = CronRule(cron="30 2 * * *")
    after = at("2027-10-30T12:00")
    assert shown(rule, after, 2) == ["2027-10-31T02:30+02:00", "2027-11-01T02:30+01:00"]
    second = at("2027-10-31T02:15", fold=1)
    assert shown(rule, second, 1) == ["2027-11-01T02:30+01:00"]


def test_every_hour_is_due_each_hour_that_passes() -> None:
    due = upcoming(CronRule(cron="0 * * * *"), at("2027-10-31T00:30"), BERLIN, 5)
    assert all(b - a == 3600.0 for a, b in pairwise(due))


@given(
    st.sampled_from(ZONES),
    st.floats(1.7e9, 2.0e9),
    st.one_of(
        st.builds(
            lambda m, h, d: CronRule(cron=f"{m} {h} * * {d}"),
            st.integers(0, 59),
            st.integers(0, 23),
            st.sampled_from(["*", "1-5", "0,6", "3"]),
        ),
        st.just(CronRule(cron="0 * * * *")),
        st.builds(
            lambda s, a: EveryRule(seconds=s, anchor_unix_s=a),
            st.floats(300.0, 1e6),
            st.floats(1.6e9, 2.0e9),
        ),
    ),
)
def test_the_next_run_comes_after_and_none_lies_between(
    zone: ZoneInfo, after_s: float, rule: Rule
) -> None:
    due_s = next_due(rule, after_s, zone)
    assert due_s is not None
    assert due_s > after_s
    between_s = after_s + (due_s - after_s) * 0.5
    assert next_due(rule, between_s, zone) == due_s
    later_s = next_due(rule, due_s, zone)
    assert later_s is not None
    assert later_s > due_s


def test_what_is_said_of_a_day_is_settled_by_the_clock() -> None:
    now_s = NOON_UNIX_S  # Friday, 12:00

    def when(**said: object) -> str:
        rule = settle(DayTime.model_validate(said), now_s, BERLIN)
        assert isinstance(rule, AtRule)
        return datetime.fromtimestamp(rule.unix_s, BERLIN).strftime("%a %H:%M")

    assert when(hour=8, either_half=True) == "Fri 20:00"
    assert when(hour=1, either_half=True) == "Fri 13:00"
    assert when(hour=8) == "Sat 08:00"
    assert when(hour=9, days_ahead=1) == "Sat 09:00"
    assert when(hour=9, weekday=4) == "Fri 09:00"
    assert when(hour=17, weekday=4) == "Fri 17:00"
    in_rule = settle(InRule(seconds=60.0), now_s, BERLIN)
    assert in_rule == AtRule(unix_s=now_s + 60.0, relative=True)


@pytest.mark.parametrize(
    ("said", "code"),
    [
        (DayTime(hour=9, days_ahead=0), "order_in_past"),
        (AtRule(unix_s=NOON_UNIX_S - 1.0), "order_in_past"),
        (AtRule(unix_s=NOON_UNIX_S + 400 * 86_400.0), "order_too_far"),
        (EveryRule(seconds=1.0), "order_too_often"),
        (CronRule(cron="* * * * *"), "order_too_often"),
        (CronRule(cron="*/2 3 * * *"), "order_too_often"),
        (CronRule(cron="0,1 3 * * *"), "order_too_often"),
        (CronRule(cron="0 0 30 2 *"), "order_malformed"),
        (CronRule(cron="0 0 29 2 *"), "order_too_far"),
        (CronRule(cron="* * * * * *"), "order_malformed"),
        (CronRule(cron="61 25 * * *"), "order_malformed"),
        (CronRule(cron="every day at"), "order_malformed"),
        (CronRule(cron="${HOME} * * *"), "order_malformed"),
    ],
)
def test_what_can_not_be_kept_is_refused(said: AtRule | CronRule, code: str) -> None:
    with pytest.raises(OrderRefusal) as refused:
        settle(said, NOON_UNIX_S, BERLIN)
    assert refused.value.code == code
    assert refused.value.message.zh != refused.value.message.en


def test_a_time_that_the_clock_skips_on_that_day_is_refused_for_once() -> None:
    day_before = at("2027-03-27T12:00")
    with pytest.raises(OrderRefusal) as refused:
        settle(DayTime(hour=2, minute=30, days_ahead=1), day_before, BERLIN)
    assert refused.value.code == "order_time_unknown"
    assert "02:30" in refused.value.message.en
    twice = settle(DayTime(hour=2, minute=30, days_ahead=1), at("2027-10-30T12:00"), BERLIN)
    assert twice == AtRule(unix_s=at("2027-10-31T02:30", fold=0))


def test_events_have_no_time() -> None:
    rule = EventRule(event=WorldEvent.PERSON_SEEN)
    judge(rule, NOON_UNIX_S, BERLIN)
    assert next_due(rule, NOON_UNIX_S, BERLIN) is None


def test_quiet_hours_go_over_midnight() -> None:
    quiet = QuietHours(22 * 60, 7 * 60)
    midnight = NOON_UNIX_S + 12 * 3600.0
    assert is_quiet(quiet, midnight, BERLIN)
    assert is_quiet(quiet, NOON_UNIX_S + 10 * 3600.0, BERLIN)
    assert not is_quiet(quiet, NOON_UNIX_S + 19 * 3600.0, BERLIN)
    assert not is_quiet(quiet, NOON_UNIX_S, BERLIN)
    assert is_quiet(quiet, float("nan"), BERLIN)
    assert quiet.text == "22:00–07:00"
    assert is_quiet(QuietHours(60, 120), midnight + timedelta(minutes=90).total_seconds(), BERLIN)
