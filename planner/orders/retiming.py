"""Work out the rule that a corrected order has: "make it nine", "not on Sundays", "an hour later".

Pure. Law: what was not said stays as it was (the days when the hour changes, the half of the day of
a bare "nine"); a change that a rule can't take is refused, and nothing of it is kept.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, tzinfo

from planner.language.schedule import Delay, LeaveOutDays, OrderChange, Retime
from planner.language.schedule.parts import (
    USUAL_HOUR,
    After,
    DayPart,
    EventPart,
    Interval,
    MonthDay,
    OnceDay,
    Part,
    TimeOfDay,
    WeekDays,
    combine,
    hour_in,
    list_days,
    read_days,
)
from planner.orders.errors import OrderRefusal
from planner.orders.rule import judge, settle
from planner.plan.timing import AtRule, CronRule, DayTime, EventRule, EveryRule, InRule, Rule

DAY_MINUTES = 1440


@dataclass(frozen=True, slots=True)
class WeeklyTime:
    """Hold what a plain cron rule says: minute, hour (None: each), days of the week (0 Sunday)."""

    minute: int
    hour: int | None
    days: frozenset[int]

    @property
    def rule(self) -> CronRule:
        """Return it as a rule."""
        hour = "*" if self.hour is None else self.hour
        return CronRule(cron=f"{self.minute} {hour} * * {list_days(self.days)}")


def read_weekly(rule: Rule) -> WeeklyTime | None:
    """Return the parts of a rule that comes again on days of the week; None of any other."""
    if not isinstance(rule, CronRule):
        return None
    minute, hour, day, month, week = rule.cron.split()
    days = read_days(week)
    if not (minute.isdigit() and day == month == "*" and days):
        return None
    if hour != "*" and not hour.isdigit():
        return None
    return WeeklyTime(int(minute), None if hour == "*" else int(hour), days)


def correct_rule(rule: Rule, change: OrderChange, now_unix_s: float, zone: tzinfo) -> Rule:
    """Return the rule after a correction that is said now.

    Raises:
        OrderRefusal: ``order_change_unfit``, ``order_change_none`` (it is so already), and as a new
            rule's.
    """
    match change:
        case Retime(parts=parts):
            new = _retime_rule(rule, parts, now_unix_s, zone)
        case LeaveOutDays():
            new = _on_days(rule, change)
        case Delay(seconds=seconds):
            new = _delay_rule(rule, seconds)
        case _:
            raise _unfit(rule)
    if new == rule:
        raise OrderRefusal("order_change_none", f"{rule.model_dump()} is so already")
    judge(new, now_unix_s, zone)
    return new


def can_take(rule: Rule, change: OrderChange, now_unix_s: float, zone: tzinfo) -> bool:
    """Tell whether a rule can be corrected so, whatever comes of it."""
    try:
        correct_rule(rule, change, now_unix_s, zone)
    except OrderRefusal as refused:
        return refused.code != "order_change_unfit"
    return True


def _unfit(rule: Rule) -> OrderRefusal:
    return OrderRefusal("order_change_unfit", f"{rule.model_dump()} can't be changed so")


def _retime_rule(rule: Rule, parts: tuple[Part, ...], now_unix_s: float, zone: tzinfo) -> Rule:
    clock = next((p for p in parts if isinstance(p, TimeOfDay)), None)
    part = next((p for p in parts if isinstance(p, DayPart)), None)
    others = [p for p in parts if not isinstance(p, (TimeOfDay, DayPart))]
    if len(others) > 1:
        raise OrderRefusal("order_nested", "several times")
    at = _hour_minute(_time_of(rule, zone), clock, part)
    if not others:
        return _at_hour(rule, at, zone)
    weekly = read_weekly(rule)
    match others[0]:
        case WeekDays(days=days) if not (parts[0] == clock and weekly and days < weekly.days):
            # "to seven on Fridays" leaves the other days as they are
            if at is not None:
                return WeeklyTime(at[1], at[0], days).rule
            if weekly is not None:  # every hour
                return WeeklyTime(weekly.minute, None, days).rule
        case Interval() if len(parts) == 1 and (timing := combine(parts)) and timing.when:
            return settle(timing.when, now_unix_s, zone)
        case After(seconds=seconds, days=None) if isinstance(rule, AtRule):
            return settle(InRule(seconds=seconds), now_unix_s, zone)
        case OnceDay(weekday=int(weekday), week=None) if weekly and len(weekly.days) == 1 and at:
            return WeeklyTime(at[1], at[0], frozenset({(weekday + 1) % 7})).rule
        case OnceDay() | MonthDay() | After() as day if isinstance(rule, AtRule) and at is not None:
            timing = combine((day, TimeOfDay(at[0], at[1], sure=True)))
            if timing is None or not isinstance(timing.when, DayTime):
                raise OrderRefusal((timing and timing.problem) or "order_malformed", "no day")
            return settle(timing.when, now_unix_s, zone)
    raise _unfit(rule)


def _at_hour(rule: Rule, at: tuple[int, int] | None, zone: tzinfo) -> Rule:
    weekly = read_weekly(rule)
    if at is not None and weekly is not None and weekly.hour is not None:
        return WeeklyTime(at[1], at[0], weekly.days).rule
    if at is None or not isinstance(rule, AtRule):
        raise _unfit(rule)
    due = datetime.fromtimestamp(rule.unix_s, zone)
    said = DayTime(hour=at[0], minute=at[1], year=due.year, month=due.month, day=due.day)
    midnight = due.replace(hour=0, minute=0).timestamp()
    return settle(said, midnight - DAY_MINUTES * 60.0, zone)  # the past is judged by now, later


def _hour_minute(
    before: tuple[int, int] | None, clock: TimeOfDay | None, part: DayPart | None
) -> tuple[int, int] | None:
    """Return the time that is said; a dial's hour is the one that is nearer to the time before."""
    if clock is None:
        return (USUAL_HOUR[part], 0) if part is not None else before
    if part is not None and not clock.sure:
        return hour_in(clock.hour, part) % 24, clock.minute
    if clock.sure or before is None or not 1 <= clock.hour <= 12:
        return clock.hour % 24, clock.minute
    halves = (clock.hour % 12, clock.hour % 12 + 12)
    same_half = halves[before[0] >= 12]
    hour = min(halves, key=lambda h: (_hours_apart(h, before[0]), h != same_half))
    return hour, clock.minute


def _hours_apart(hour: int, other: int) -> int:
    ahead = (hour - other) % 24
    return min(ahead, 24 - ahead)


def _time_of(rule: Rule, zone: tzinfo) -> tuple[int, int] | None:
    """Return the time of day of a rule that has one."""
    weekly = read_weekly(rule)
    if weekly is not None and weekly.hour is not None:
        return weekly.hour, weekly.minute
    if isinstance(rule, AtRule):
        due = datetime.fromtimestamp(rule.unix_s, zone)
        return due.hour, due.minute
    return None


def _on_days(rule: Rule, change: LeaveOutDays) -> Rule:
    weekly = read_weekly(rule)
    if weekly is None:
        raise _unfit(rule)
    if change.keeps:
        days = weekly.days & change.days or change.days
    elif not (days := weekly.days - change.days):
        raise OrderRefusal("order_never", "no day is left")
    return WeeklyTime(weekly.minute, weekly.hour, days).rule


def _delay_rule(rule: Rule, seconds: float) -> Rule:
    if isinstance(rule, AtRule):
        return rule.model_copy(update={"unix_s": max(0.0, rule.unix_s + seconds)})
    weekly = read_weekly(rule)
    if weekly is None or weekly.hour is None or seconds % 60.0:
        raise _unfit(rule)
    minutes = weekly.hour * 60 + weekly.minute + round(seconds / 60.0)
    shift, rest = divmod(minutes, DAY_MINUTES)
    days = frozenset((day + shift) % 7 for day in weekly.days)
    return WeeklyTime(rest % 60, rest // 60, days).rule


def fits_time(
    rule: Rule,
    parts: tuple[Part, ...],
    due_s: float | None,
    zone: tzinfo,
    now_unix_s: float | None = None,
) -> bool:
    """Tell whether all parts of a time are of this rule; a bare eight is of either half.

    "Tomorrow" is of a rule only where it is known what time it is now.
    """
    return bool(parts) and all(_has(rule, part, due_s, zone, now_unix_s) for part in parts)


def _has(
    rule: Rule, part: Part, due_s: float | None, zone: tzinfo, now_unix_s: float | None
) -> bool:
    due = datetime.fromtimestamp(due_s, zone) if due_s is not None else None
    at, weekly = _time_of(rule, zone), read_weekly(rule)
    match part:
        case TimeOfDay(hour=hour, minute=minute, sure=sure):
            dial = 24 if sure or not 1 <= hour <= 12 else 12
            return at is not None and (at[0] - hour) % dial == 0 and at[1] == minute
        case DayPart():
            return at is not None and at[0] in HOURS_CALLED[part]
        case WeekDays(days=days):
            return weekly is not None and weekly.days == days
        case Interval(seconds=seconds) if isinstance(rule, EveryRule):
            return rule.seconds == seconds
        case Interval(seconds=seconds):
            return seconds == 3600.0 and weekly is not None and weekly.hour is None
        case EventPart(event=event):
            return isinstance(rule, EventRule) and rule.event is event
        case OnceDay(ahead=int(ahead)) if due is not None and now_unix_s is not None:
            return (due.date() - datetime.fromtimestamp(now_unix_s, zone).date()).days == ahead
        case OnceDay(weekday=int(weekday), week=None):
            return due is not None and due.weekday() == weekday
        case _:
            return False


HOURS_CALLED = {
    DayPart.MORNING: range(4, 12),
    DayPart.NOON: range(11, 15),
    DayPart.AFTERNOON: range(12, 19),
    DayPart.EVENING: range(17, 24),
    DayPart.NIGHT: (*range(20, 24), *range(6)),
}
"""Hours of the day that people call so, where they name an order by them."""
