"""When rules are due: over nights when clocks change and on named days; which can't be kept."""

from __future__ import annotations

from datetime import datetime, timedelta
from itertools import pairwise
from pathlib import Path
from zoneinfo import ZoneInfo

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.orders.errors import OrderRefusal
from planner.orders.new_order import OrderQuestion, order_of_text
from planner.orders.rule import JUST_OVER_DAYS, is_quiet, next_due, settle, upcoming
from planner.plan import QuietHours
from planner.plan.timing import (
    AtRule,
    CronRule,
    DayTime,
    EveryRule,
    InRule,
    Rule,
)
from tests.planner.orders.fakes import BERLIN, NOON_UNIX_S, MovedClocks, kept_in

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


FRIDAY = "2027-01-15T12:00"


def when(text: str, now: str = FRIDAY) -> str:
    new = order_of_text(text, None, "api")
    assert isinstance(new.when, DayTime), text
    rule = settle(new.when, at(now), BERLIN)
    assert isinstance(rule, AtRule)
    return datetime.fromtimestamp(rule.unix_s, BERLIN).strftime("%Y-%m-%d %H:%M")


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("on 28 March at 3:30 check the door", "2027-03-28 03:30"),
        ("check the door on March 28th at 3:30", "2027-03-28 03:30"),
        ("on the 28th of March at half past three go home", "2027-03-28 03:30"),
        ("on the 5th at noon go home", "2027-02-05 12:00"),
        ("on the 20th at noon go home", "2027-01-20 12:00"),
        ("on the 31st at noon go home", "2027-01-31 12:00"),
        ("on the first of next month at nine remind me to pay", "2027-02-01 09:00"),
        ("remind me on the 1st of next month at nine to pay", "2027-02-01 09:00"),
        ("the day after tomorrow at seven go home", "2027-01-17 07:00"),
        ("in a week at six remind me to call Tom", "2027-01-22 06:00"),
        ("in three days at noon go home", "2027-01-18 12:00"),
        ("on Tuesday next week at six go home", "2027-01-19 06:00"),
        ("on Christmas Eve at six in the evening say hello", "2027-12-24 18:00"),
        ("on 2027-03-28 at 20:00 go home", "2027-03-28 20:00"),
        ("3月28号三点半检查门", "2027-03-28 03:30"),
        ("在三月二十八日下午两点半去厨房", "2027-03-28 14:30"),
        ("五号中午去厨房", "2027-02-05 12:00"),
        ("下周五六点去厨房", "2027-01-22 06:00"),
        ("下下周一早上七点去厨房", "2027-01-25 07:00"),
        ("后天早上七点去厨房", "2027-01-17 07:00"),
        ("大后天早上七点去厨房", "2027-01-18 07:00"),
        ("下个月一号早上八点提醒我交房租", "2027-02-01 08:00"),
        ("三天后中午去厨房", "2027-01-18 12:00"),
        ("一周后晚上八点提醒我交房租", "2027-01-22 20:00"),
        ("圣诞节早上八点说圣诞快乐", "2027-12-25 08:00"),
        ("在2027-03-28的20:00去厨房", "2027-03-28 20:00"),
    ],
)  # fmt: skip
def test_a_day_that_is_said_is_settled_by_the_clock(text: str, meant: str) -> None:
    assert when(text) == meant


@pytest.mark.parametrize(
    ("text", "now", "code"),
    [
        ("on 31 June at noon go home", FRIDAY, "order_no_such_date"),
        ("6月31号中午回家", FRIDAY, "order_no_such_date"),
        ("on 29 February at noon go home", FRIDAY, "order_no_such_date"),
        ("2月29号中午回家", FRIDAY, "order_no_such_date"),
        ("on the 31st of next month at noon go home", FRIDAY, "order_no_such_date"),
        ("on 45 March at noon go home", FRIDAY, "order_no_such_date"),
        ("on 28 March at 2:30 check the door", FRIDAY, "order_time_unknown"),
        ("3月28号两点半检查门", FRIDAY, "order_time_unknown"),
        ("on 5 January at noon go home", FRIDAY, "order_in_past"),
        ("on 5 March 2026 at noon go home", FRIDAY, "order_in_past"),
        ("1月15号早上八点回家", FRIDAY, "order_in_past"),
        ("本周一早上八点回家", FRIDAY, "order_in_past"),
        ("on 5 March 2029 at noon go home", FRIDAY, "order_too_far"),
        ("next Friday go home", FRIDAY, "order_time_missing"),
    ],
)  # fmt: skip
def test_a_day_that_is_none_or_over_is_told_with_its_code(text: str, now: str, code: str) -> None:
    with pytest.raises(OrderRefusal) as refused:
        when(text, now)
    assert refused.value.code == code
    assert refused.value.message.en != refused.value.message.zh


def test_a_leap_day_comes_in_a_leap_year() -> None:
    assert when("on 29 February at noon go home", "2027-12-01T12:00") == "2028-02-29 12:00"


@given(st.integers(0, 364), st.integers(1, 363 - JUST_OVER_DAYS), st.integers(5, 23))
def test_a_date_without_a_year_is_the_one_around_now(start: int, ahead: int, hour: int) -> None:
    now = datetime(2026, 1, 1, 12, tzinfo=BERLIN) + timedelta(days=start)
    day = (now + timedelta(days=ahead)).date()
    for wanted in (day, (now + timedelta(days=1)).date()):
        said = DayTime(hour=hour, day=wanted.day, month=wanted.month)
        rule = settle(said, now.timestamp(), BERLIN)
        assert isinstance(rule, AtRule)
        due = datetime.fromtimestamp(rule.unix_s, BERLIN)
        assert (due.date(), due.hour) == (wanted, hour)


@pytest.mark.parametrize(
    "text", ["go to the kitchen on the second floor", "look on the 3rd shelf",
             "march 2 metres forward", "去3号房间", "三号桌有没有人"],
)  # fmt: skip
def test_a_number_of_a_thing_is_no_day(text: str) -> None:
    with pytest.raises(OrderRefusal) as refused:
        order_of_text(text, None, "api")
    assert refused.value.code == "order_malformed"


@pytest.mark.parametrize(
    ("text", "offers"),
    [
        ("next Friday at six go to the kitchen",
         ["on 2027-01-15 at 06:00 go to the kitchen", "on 2027-01-22 at 06:00 go to the kitchen"]),
        ("remind me next Friday at six to call Tom",
         ["on 2027-01-15 at 06:00 remind me to call Tom",
          "on 2027-01-22 at 06:00 remind me to call Tom"]),
    ],
)  # fmt: skip
async def test_next_friday_is_asked_about_where_people_mean_either(
    tmp_path: Path, text: str, offers: list[str]
) -> None:
    kept = await kept_in(tmp_path, MovedClocks(unix_s=NOON_UNIX_S - 2 * 86_400.0))
    with pytest.raises(OrderQuestion) as question:
        await kept.orders.intake.give(order_of_text(text, None, "api"), "g-1")
    assert [option.text for option in question.value.asked.options] == offers
    assert kept.orders.keeper.book.orders == {}
    await kept.orders.intake.give(order_of_text(offers[1], None, "api"), "g-2")
    [order] = kept.orders.keeper.book.orders.values()
    assert order.order in ("go to the kitchen", "say “call Tom”")


@pytest.mark.parametrize("day", [4, 5, 6])
async def test_next_friday_is_one_day_from_a_friday_on(tmp_path: Path, day: int) -> None:
    kept = await kept_in(tmp_path, MovedClocks(unix_s=NOON_UNIX_S + (day - 4) * 86_400.0))
    new = order_of_text("next Friday at six go to the kitchen", None, "api")
    order = await kept.orders.intake.give(new, "g-1")
    assert isinstance(order.rule, AtRule)
    assert order.rule.unix_s == at("2027-01-22T06:00")
