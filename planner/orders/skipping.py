"""Leave whole days out of an order, as iCalendar's EXDATE does: "don't wake me tomorrow". Pure.

Law: the runs of those days are left out, untold and uncounted, and no others.
"""

from __future__ import annotations

from datetime import datetime, time, timedelta
from typing import TYPE_CHECKING

from planner.orders.calendar_day import day_of
from planner.orders.rule import next_due
from planner.plan.timing import DayTime, EventRule

if TYPE_CHECKING:
    from collections.abc import Iterator
    from datetime import date, tzinfo

    from planner.language.schedule.parts import OnceDay
    from planner.orders.order import StandingOrder

MOST_SKIPPED = 100
"""Days of one order that may be left out at a time."""
_JUST_BEFORE_S = 1e-3


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
    due_s: float | None = after_unix_s
    for _ in range(count):
        due_s = next_run(order, due_s if due_s is not None else after_unix_s, zone)
        if due_s is None:
            return
        yield due_s


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
