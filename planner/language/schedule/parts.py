"""Own the parts of a time that a sentence may name, and how they make one rule together. Pure.

A language finds the parts (``english``, ``chinese``); what they mean together is the same in each.
"""

from __future__ import annotations

import re
from calendar import monthrange
from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import TYPE_CHECKING, Literal

from planner.language.numbers import seconds
from planner.plan.timing import (
    MAX_AHEAD_S,
    CronRule,
    DayTime,
    EventRule,
    EveryRule,
    InRule,
    SpokenRule,
    WorldEvent,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

Problem = Literal["order_nested", "order_time_missing", "order_malformed", "order_in_past",
                  "order_no_such_date", "order_no_end", "order_no_event", "order_time_within"]  # fmt: skip
"""Why a when that was said can't be kept."""


class DayPart(StrEnum):
    """Name a part of the day."""

    MORNING = "morning"
    NOON = "noon"
    AFTERNOON = "afternoon"
    EVENING = "evening"
    NIGHT = "night"


USUAL_HOUR = dict(zip(DayPart, (8, 12, 15, 20, 22), strict=True))
"""What "every evening" means where no hour is said; the answer tells it."""
HOURS_OF = {
    DayPart.MORNING: "05:00-12:00",
    DayPart.NOON: "11:00-14:00",
    DayPart.AFTERNOON: "12:00-18:00",
    DayPart.EVENING: "17:00-23:00",
    DayPart.NIGHT: "22:00-06:00",
}
"""When an event counts that is waited for "at night"; the answer tells it."""
MOST_DAYS = 366
LEAP_YEAR = 2028
EVERY_DAY = frozenset(range(7))
WORKDAYS, WEEKEND = frozenset({1, 2, 3, 4, 5}), frozenset({0, 6})


@dataclass(frozen=True, slots=True)
class WeekDays:
    """Come again on these days of the week; 0 is Sunday, as cron has it."""

    days: frozenset[int]


@dataclass(frozen=True, slots=True)
class Interval:
    """Come again after so long [s]."""

    seconds: float


@dataclass(frozen=True, slots=True)
class OnceDay:
    """Name one day: so far off, or by its weekday (Monday is 0)."""

    ahead: int | None = None
    weekday: int | None = None
    week: int | None = None
    """So many calendar weeks after this one; None: the next such day."""
    either_week: bool = False
    """"Next Friday": people mean either."""


@dataclass(frozen=True, slots=True)
class MonthDay:
    """Name one day by its number, and perhaps by month and year."""

    day: int
    month: int | None = None
    year: int | None = None
    months_ahead: int | None = None
    years_ahead: int | None = None
    coming: bool = False
    """A feast: the next one."""


@dataclass(frozen=True, slots=True)
class After:
    """Come once after so long [s]; ``days``: whole days, which may have a time of day as well."""

    seconds: float
    days: int | None = None


@dataclass(frozen=True, slots=True)
class TimeOfDay:
    """Name a time of day. ``sure``: it is said on which half of the day."""

    hour: int
    minute: int = 0
    sure: bool = False


@dataclass(frozen=True, slots=True)
class EventPart:
    """Name an event."""

    event: WorldEvent


Part = WeekDays | Interval | OnceDay | MonthDay | After | TimeOfDay | EventPart | DayPart
PartForm = tuple[re.Pattern[str], Part | Callable[[re.Match[str]], Part | tuple[Part, ...] | None]]
"""What begins a part, and the parts that it makes."""


def after_of(found: re.Match[str], number: Callable[[str], int | None]) -> After | None:
    """Return the time after a length that was matched; None where it is none."""
    group = {name.removeprefix("x"): text for name, text in found.groupdict().items()
             if text is not None}  # fmt: skip
    if "and" in group:
        hours = number(group["and"])
        return None if hours is None else After(hours * 3600.0 + 1800.0)
    if "halfhour" in group or "quarter" in group:
        return After(1800.0 if "halfhour" in group else 900.0)
    lasts_s = seconds(group["number"], group["unit"])
    return None if lasts_s is None else After(lasts_s)


def interval_of(lasts_s: float | None) -> Interval | None:
    """Return what comes again after so long [s]."""
    return None if lasts_s is None else Interval(lasts_s)


@dataclass(frozen=True, slots=True)
class Timing:
    """Hold what the parts mean together: a rule, or why they are none."""

    when: SpokenRule | None = None
    problem: Problem | None = None


_REPEATS = (WeekDays, Interval, OnceDay, MonthDay, After, EventPart)
"""Of these one is enough."""


def combine(parts: Sequence[Part]) -> Timing | None:
    """Return what these parts mean together; None where they name no time for an order."""
    found: dict[type[object], Part] = {}
    for part in parts:
        if type(part) in found:
            nested = isinstance(part, _REPEATS)
            return Timing(problem="order_nested") if nested else None
        found[type(part)] = part
    repeats = [p for p in parts if isinstance(p, _REPEATS)]
    if len(repeats) > 1:
        return Timing(problem="order_nested")
    clock = next((p for p in parts if isinstance(p, TimeOfDay)), None)
    daypart = next((p for p in parts if isinstance(p, DayPart)), None)
    if not repeats:
        return _by_clock(OnceDay(), clock, daypart) if clock is not None else None
    match repeats[0]:
        case WeekDays() as again:
            return _weekly(again, clock, daypart)
        case OnceDay() | MonthDay() as day:
            return _by_clock(day, clock, daypart)
        case After(days=int(ahead)) if clock is not None or daypart is not None:
            return _by_clock(OnceDay(ahead=min(ahead, MOST_DAYS)), clock, daypart)
        case Interval(seconds) | After(seconds) if clock is not None or daypart is not None:
            return Timing(problem="order_nested")
        case Interval(seconds):
            return _lasting(seconds, EveryRule)
        case After(seconds):
            return _lasting(seconds, InRule)
        case EventPart(event):
            hours = HOURS_OF[daypart] if daypart is not None else None
            return Timing(EventRule(event=event, hours=hours)) if clock is None else None
        case _:
            return None


def end_of_pause(parts: Sequence[Part]) -> DayTime | InRule | None:
    """Return when a pause until then ends: a day alone is its beginning."""
    days_alone = parts and all(isinstance(part, (OnceDay, MonthDay)) for part in parts)
    timing = combine((*parts, TimeOfDay(0, 0, sure=True)) if days_alone else parts)
    when = timing.when if timing is not None else None
    return when if isinstance(when, (DayTime, InRule)) else None


def is_once(parts: Sequence[Part]) -> bool:
    """Tell whether a time comes once: what comes again is no time of words."""
    return not any(isinstance(part, WeekDays | Interval | EventPart) for part in parts)


def lacks_time(parts: Sequence[Part]) -> bool:
    """Tell whether these name a day, and not when on it: "every day", "tomorrow"."""
    timing = combine(parts)
    return timing is not None and timing.problem == "order_time_missing"


def _lasting(seconds: float, make: type[EveryRule] | type[InRule]) -> Timing:
    if not 0.0 < seconds <= MAX_AHEAD_S:
        return Timing(problem="order_malformed")
    if make is EveryRule and seconds == 3600.0:  # "every hour": at the full hour
        return Timing(CronRule(cron="0 * * * *"))
    return Timing(make(seconds=seconds))


def _weekly(again: WeekDays, clock: TimeOfDay | None, daypart: DayPart | None) -> Timing:
    at = _hour_minute(clock, daypart)
    if at is None:
        return Timing(problem="order_time_missing")
    hour, minute = at
    hour = _by_day(hour, clock, daypart)
    days = again.days
    if _is_past_midnight(hour, daypart):
        days = frozenset((each + 1) % 7 for each in days)
    return Timing(CronRule(cron=f"{minute} {hour} * * {list_days(days)}"))


_SMALL = range(1, 4)
"""Hours of a dial that are of the night, also where people say evening."""
SUNDAY = 6
_BY_DAY = range(1, 5)
"""Hours of a dial that mean the afternoon where nothing else is said."""


def _by_day(hour: int, clock: TimeOfDay | None, daypart: DayPart | None) -> int:
    """Return a bare hour on a day that is named: nobody who says "Tuesday at three" means the night."""
    bare = clock is not None and not clock.sure and daypart is None
    return hour + 12 if bare and hour in _BY_DAY else hour


def list_days(days: frozenset[int]) -> str:
    """Return days of the week as cron writes them."""
    named = {EVERY_DAY: "*", WORKDAYS: "1-5"}
    return named.get(days) or ",".join(map(str, sorted(days)))


def read_days(week: str) -> frozenset[int]:
    """Return the days of the week of cron's field; none where it can't be read."""
    if week == "*":
        return EVERY_DAY
    found: set[int] = set()
    for each in week.split(","):
        first, _, last = each.partition("-")
        if not (first.isdigit() and (last or first).isdigit()):
            return frozenset()
        found.update(day % 7 for day in range(int(first), int(last or first) + 1))
    return frozenset(found)


def _by_clock(day: OnceDay | MonthDay, clock: TimeOfDay | None, daypart: DayPart | None) -> Timing:
    at = _hour_minute(clock, daypart)
    if at is None:
        return Timing(problem="order_time_missing")
    named = isinstance(day, OnceDay) and day not in (OnceDay(), OnceDay(ahead=0))
    named = named and at[1] == 0  # "tomorrow at 2:30" is written as a clock shows it
    at = (_by_day(at[0], clock, daypart) if named else at[0], at[1])
    if isinstance(day, MonthDay):
        return _by_date(day, *at)
    if _is_past_midnight(at[0], daypart):
        day = _next_day(day)
    bare = clock is not None and not clock.sure and daypart is None
    either = bare and day == OnceDay() and 1 <= at[0] <= 12  # on a dial
    return Timing(
        DayTime(
            hour=at[0], minute=at[1], days_ahead=day.ahead, weekday=day.weekday, week=day.week,
            either_week=day.either_week, either_half=either,
        )
    )  # fmt: skip


def _by_date(day: MonthDay, hour: int, minute: int) -> Timing:
    """Return a time on a date, or that no year has that date (31 June)."""
    month = 1 if day.month is None else day.month
    if not (1 <= month <= 12 and 1 <= day.day <= monthrange(LEAP_YEAR, month)[1]):
        return Timing(problem="order_no_such_date")
    if day.year is not None and not 2000 <= day.year <= 2099:
        return Timing(problem="order_malformed")
    return Timing(
        DayTime(
            hour=hour, minute=minute, day=day.day, month=day.month, year=day.year,
            months_ahead=day.months_ahead, years_ahead=day.years_ahead, coming=day.coming,
        )
    )  # fmt: skip


def _hour_minute(clock: TimeOfDay | None, daypart: DayPart | None) -> tuple[int, int] | None:
    if clock is None:
        return None if daypart is None else (USUAL_HOUR[daypart], 0)
    hour = clock.hour if clock.sure or daypart is None else hour_in(clock.hour, daypart)
    return hour % 24, clock.minute


def _is_past_midnight(hour: int, daypart: DayPart | None) -> bool:
    """Tell whether an hour of an evening lies on the day behind it: 今晚十二点, "tonight at one"."""
    return daypart is DayPart.EVENING and (hour == 0 or hour in _SMALL)


def _next_day(day: OnceDay) -> OnceDay:
    if day.weekday is None:
        return day if day.ahead is None else replace(day, ahead=day.ahead + 1)
    week = day.week if day.week is None or day.weekday < SUNDAY else day.week + 1
    return replace(day, weekday=(day.weekday + 1) % 7, week=week)


def hour_in(hour: int, daypart: DayPart) -> int:
    """Return the hour of 24 that a dial's hour is in a part of the day."""
    if not 1 <= hour <= 12:  # already of 24
        return hour
    match daypart:
        case DayPart.MORNING:
            return hour % 12
        case DayPart.NOON:
            return hour + 12 if hour <= 3 else hour  # 中午一点 is 13:00
        case DayPart.NIGHT:
            return hour % 12 if hour <= 5 or hour == 12 else hour + 12
        case DayPart.EVENING if hour == 12 or hour in _SMALL:
            return hour % 12  # 晚上十二点 is midnight, and no noon
        case _:
            return hour % 12 + 12


def leave_days_out(rule: CronRule, named: frozenset[int], *, keeps: bool) -> CronRule | None:
    """Return a rule without these days of the week, or on them alone; None where none is left."""
    *at, week = rule.cron.split()
    days = read_days(week)
    days = days & named if keeps else days - named
    return CronRule(cron=" ".join((*at, list_days(days)))) if days else None
