"""Work out when a rule is due next and which day is named, and refuse rules that never are due.

The only place that knows cronsim and time zones. Pure: told the instant and the zone. Daylight
saving as Debian's cron: a time of day that a spring night leaves out is due when it ends (02:30 at
03:00), one that an autumn night has twice is due once, the first time; "every hour" is due each
hour that passes. Law: a day that is said whole and is over is never taken for another one; where
a part of it is said ("on the 5th", "on Friday"), it is the next such day. The runs of a day left
out (iCalendar's EXDATE) are neither due nor missed, and no others.
"""

from __future__ import annotations

from datetime import UTC, date, datetime, time, timedelta, tzinfo
from itertools import pairwise
from math import ceil, isfinite
from typing import TYPE_CHECKING

from cronsim import CronSim, CronSimError

from planner.orders.errors import OrderRefusal
from planner.plan.timing import (
    MAX_AHEAD_S,
    AtRule,
    CronRule,
    DayTime,
    EventRule,
    EveryRule,
    InRule,
    Rule,
    SpokenRule,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from planner.language.schedule.parts import OnceDay
    from planner.orders.order import StandingOrder
    from planner.plan import QuietHours

MIN_APART_S = 300.0
"""Between two runs of one order: what comes oftener is no errand but a state."""
RUNS_JUDGED = 50
"""So many runs of a new rule are looked at: over two days of an hourly one."""
_CRON_FIELDS = 5
JUST_OVER_DAYS = 31
"""A date without a year that is over for so long at most was meant; an older one is next year's."""
_LONGEST_GAP = 3
"""Months that are looked at for the 31st: no two in a row lack it."""
_JUST_BEFORE_S = 1e-3


def settle(said: SpokenRule | AtRule, now_unix_s: float, zone: tzinfo) -> Rule:
    """Return the rule that a sentence or a request means, said now.

    Raises:
        OrderRefusal: ``order_in_past``, ``order_too_far``, ``order_time_unknown`` (no such time on
            that day), ``order_no_such_date``, ``order_too_often``, ``order_never``,
            ``order_malformed``.
    """
    match said:
        case InRule():
            rule: Rule = AtRule(unix_s=now_unix_s + said.seconds, relative=True)
        case DayTime():
            rule = AtRule(unix_s=_instant(said, now_unix_s, zone))
        case EveryRule() if not said.anchor_unix_s:  # said now; a calendar names its instant
            rule = EveryRule(seconds=said.seconds, anchor_unix_s=now_unix_s)
        case _:
            rule = said
    judge(rule, now_unix_s, zone)
    return rule


def judge(rule: Rule, now_unix_s: float, zone: tzinfo) -> None:
    """Refuse a rule that can't be kept.

    Raises:
        OrderRefusal: see ``settle``.
    """
    if isinstance(rule, EventRule):
        return
    if isinstance(rule, EveryRule) and not rule.seconds >= MIN_APART_S:
        raise OrderRefusal("order_too_often", f"every {rule.seconds:g} s", most=MIN_APART_S / 60.0)
    first = next_due(rule, now_unix_s, zone)
    if isinstance(rule, AtRule) and first is None:
        told = datetime.fromtimestamp(rule.unix_s, zone).isoformat(timespec="minutes")
        raise OrderRefusal("order_in_past", f"{told} is over")
    if first is None:
        raise OrderRefusal("order_never", f"{rule.model_dump()} is never due")
    if not first - now_unix_s <= MAX_AHEAD_S:
        raise OrderRefusal("order_too_far", "the first run is more than a year away")
    if isinstance(rule, CronRule):
        apart_s = min((b - a for a, b in pairwise(upcoming(rule, now_unix_s, zone, RUNS_JUDGED))),
                      default=MIN_APART_S)  # fmt: skip
        if not apart_s >= MIN_APART_S:
            raise OrderRefusal(
                "order_too_often", f"{rule.cron!r}: {apart_s:g} s apart", most=MIN_APART_S / 60.0
            )


def next_due(rule: Rule, after_unix_s: float, zone: tzinfo) -> float | None:
    """Return the first instant after this one at which a rule is due; None where there is none."""
    match rule:
        case AtRule():
            return rule.unix_s if rule.unix_s > after_unix_s else None
        case EveryRule():
            passed = (after_unix_s - rule.anchor_unix_s) / rule.seconds
            count = max(1, ceil(passed))
            due_s = rule.anchor_unix_s + count * rule.seconds
            return due_s if due_s > after_unix_s else due_s + rule.seconds
        case CronRule():
            return _next_cron(rule.cron, after_unix_s, zone)
        case EventRule():
            return None


def upcoming(rule: Rule, after_unix_s: float, zone: tzinfo, count: int) -> Iterator[float]:
    """Yield the next runs of a rule, ``count`` at most."""
    return _follow(lambda s: next_due(rule, s, zone), after_unix_s, count)


def _follow(
    find_next: Callable[[float], float | None], after_unix_s: float, count: int
) -> Iterator[float]:
    due_s = after_unix_s
    for _ in range(count):
        next_s = find_next(due_s)
        if next_s is None:
            return
        yield (due_s := next_s)


def _next_cron(cron: str, after_unix_s: float, zone: tzinfo) -> float | None:
    if len(cron.split()) != _CRON_FIELDS:
        raise OrderRefusal("order_malformed", f"{cron!r}: expected five fields, as cron has them")
    after = datetime.fromtimestamp(after_unix_s, zone)
    try:
        for due in CronSim(cron, after):
            # In the second of two equal hours cronsim counts from the first one.
            if (due_s := due.timestamp()) > after_unix_s:
                return due_s
    except CronSimError as error:
        raise OrderRefusal("order_malformed", f"{cron!r}: {error}") from None
    except (RuntimeError, OverflowError, ValueError):  # out of years
        return None
    return None


def _instant(said: DayTime, now_unix_s: float, zone: tzinfo) -> float:
    """Return the instant of a time of day; of two such times in one night the first."""
    now = datetime.fromtimestamp(now_unix_s, zone)
    hours = (said.hour, (said.hour + 12) % 24) if said.either_half else (said.hour,)
    found = []
    for hour in hours:
        day = day_of(said, now, hour)
        wanted = datetime(day.year, day.month, day.day, hour, said.minute, tzinfo=zone)
        if _exists(wanted):
            found.append(wanted.timestamp())
    if not found:
        clock = f"{said.hour:02}:{said.minute:02}"
        raise OrderRefusal("order_time_unknown", f"the clock skips {clock} on that day", time=clock)
    return min((s for s in found if s > now_unix_s), default=found[0])


def _exists(wanted: datetime) -> bool:
    there_and_back = wanted.astimezone(UTC).astimezone(wanted.tzinfo)
    return there_and_back.replace(tzinfo=None) == wanted.replace(tzinfo=None)


def is_quiet(quiet: QuietHours, unix_s: float, zone: tzinfo) -> bool:
    """Return whether an instant lies within hours of the day there; one that is none does."""
    if not isfinite(unix_s):
        return True
    now = datetime.fromtimestamp(unix_s, zone)
    return quiet.holds(now.hour * 60 + now.minute)


def day_of(said: DayTime, now: datetime, hour: int) -> date:
    """Return the day of a time of day that is said now.

    Args:
        said: the time.
        now: in the owner's time zone.
        hour: of the two that a dial's hour may be, the one that is judged.

    Raises:
        OrderRefusal: ``order_no_such_date``.
    """
    today = now.date()
    over = (hour, said.minute) <= (now.hour, now.minute)
    if said.day is not None:
        return (
            _find_date(said, today)
            if said.month is not None
            else _find_day_number(said, today, over=over)
        )
    if said.days_ahead is not None:
        return today + timedelta(days=said.days_ahead)
    if said.weekday is None:
        return today + timedelta(days=int(over))
    if said.week is not None:
        monday = today - timedelta(days=today.weekday())
        return monday + timedelta(days=7 * said.week + said.weekday)
    ahead = (said.weekday - today.weekday()) % 7
    return today + timedelta(days=7 if ahead == 0 and over else ahead)


def days_of_next(said: DayTime, now: datetime) -> tuple[date, date] | None:
    """Return both days that "next Friday" may be, said now; None where there is one alone."""
    if not said.either_week or said.weekday is None:
        return None
    ahead = (said.weekday - now.weekday()) % 7
    coming = now.date() + timedelta(days=ahead or 7)
    after = day_of(said, now, said.hour)
    return (coming, after) if coming != after else None


def _find_date(said: DayTime, today: date) -> date:
    """Return the day of a month that is named."""
    month, day = said.month or 1, said.day or 1
    if said.year is not None or said.years_ahead is not None:
        return _make(said.year or today.year + (said.years_ahead or 0), month, day)
    since = today - timedelta(days=0 if said.coming else JUST_OVER_DAYS)
    is_of_that_year = (month, day) >= (since.month, since.day)
    return _make(since.year + int(not is_of_that_year), month, day)


def _find_day_number(said: DayTime, today: date, *, over: bool) -> date:
    """Return the day of which only the number is said: of this month, of the next one, or next."""
    day = said.day or 1
    if said.months_ahead is not None:
        return _make(*_month_on(today, said.months_ahead), day)
    first = int(day < today.day or (day == today.day and over))
    for ahead in range(first, first + _LONGEST_GAP):
        year, month = _month_on(today, ahead)
        try:
            return date(year, month, day)
        except ValueError:  # it has fewer days
            continue
    raise OrderRefusal("order_no_such_date", f"no month near {today} has a day {day}")


def _month_on(today: date, ahead: int) -> tuple[int, int]:
    months = today.year * 12 + today.month - 1 + ahead
    return months // 12, months % 12 + 1


def _make(year: int, month: int, day: int) -> date:
    try:
        return date(year, month, day)
    except ValueError:
        raise OrderRefusal(
            "order_no_such_date", f"there is no {year}-{month:02}-{day:02}"
        ) from None


def next_run(order: StandingOrder, after_unix_s: float, zone: tzinfo) -> float | None:
    """Return the first run after this instant that lies on no day left out; None: there is none."""
    due_s = next_due(order.rule, after_unix_s, zone)
    while due_s is not None and (day := day_at(due_s, zone)) in order.skipped:
        due_s = next_due(order.rule, _begin_s(day + timedelta(days=1), zone), zone)
    return due_s


def coming_runs(
    order: StandingOrder, after_unix_s: float, zone: tzinfo, count: int
) -> Iterator[float]:
    """Yield the next runs of an order, ``count`` at most."""
    return _follow(lambda s: next_run(order, s, zone), after_unix_s, count)


def runs_on(order: StandingOrder, day: date, now_unix_s: float, zone: tzinfo) -> bool:
    """Tell whether an order may still run on a day; one upon an event may on any from today on."""
    if isinstance(order.rule, EventRule):
        return day >= day_at(now_unix_s, zone) and day not in order.skipped
    since_s = max(now_unix_s, order.handled_unix_s, _begin_s(day, zone))
    due_s = next_run(order, since_s, zone)
    return due_s is not None and day_at(due_s, zone) == day


def days_left_out(order: StandingOrder, day: date, now_unix_s: float, zone: tzinfo) -> list[date]:
    """Return an order's days that are left out, with one more and without those that are over."""
    today = day_at(now_unix_s, zone)
    return sorted({day, *(each for each in order.skipped if each >= today)})


def find_day(said: OnceDay, now_unix_s: float, zone: tzinfo) -> date:
    """Return the day that is named now, today as well."""
    wanted = DayTime(hour=23, minute=59, days_ahead=said.ahead, weekday=said.weekday,
                     week=said.week)  # fmt: skip
    return day_of(wanted, datetime.fromtimestamp(now_unix_s, zone), 23)


def day_at(unix_s: float, zone: tzinfo) -> date:
    """Return the day of an instant."""
    return datetime.fromtimestamp(unix_s, zone).date()


def _begin_s(day: date, zone: tzinfo) -> float:
    """Return the instant before a day, so that a run at midnight is after it."""
    return datetime.combine(day, time(), zone).timestamp() - _JUST_BEFORE_S
