"""Work out what it takes to leave out an order's runs of one day: "don't wake me tomorrow". Pure.

Law: nothing but that day's runs is left out. An order has no list of days that are left out, so it
is paused from now until that day is over, where no other run lies between.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime, timedelta
from enum import StrEnum
from typing import TYPE_CHECKING

from planner.orders.calendar_day import day_of
from planner.orders.rule import next_due
from planner.plan.timing import AtRule, DayTime, EventRule

if TYPE_CHECKING:
    from datetime import tzinfo

    from planner.language.schedule.parts import OnceDay
    from planner.orders.order import StandingOrder


class SkipAct(StrEnum):
    """Name what leaves a day's runs out."""

    PAUSE = "pause"
    REMOVE = "remove"
    """It comes once, on that day."""
    BETWEEN = "between"
    """A run of another day would be left out as well."""
    NOTHING = "nothing"
    """It has no run on that day."""


@dataclass(frozen=True, slots=True)
class DaySkip:
    """Hold what leaves a day's runs out, when that day ends, and the run that lies before it."""

    act: SkipAct
    ends_s: float
    weekday: int
    """Monday is 0."""
    due_s: float = 0.0


def skip_day(order: StandingOrder, day: OnceDay, now_unix_s: float, zone: tzinfo) -> DaySkip:
    """Return what leaves out the runs that an order has on a day that is named now."""
    now = datetime.fromtimestamp(now_unix_s, zone)
    said = DayTime(hour=23, minute=59, days_ahead=day.ahead, weekday=day.weekday, week=day.week)
    meant = day_of(said, now, 23)
    begin = datetime(meant.year, meant.month, meant.day, tzinfo=zone)
    following = meant + timedelta(days=1)
    end = datetime(following.year, following.month, following.day, tzinfo=zone)
    begin_s, end_s = begin.timestamp(), end.timestamp()
    is_today = meant == now.date()
    due_s = next_due(order.rule, max(now_unix_s, order.handled_unix_s), zone)
    if isinstance(order.rule, EventRule):  # at any time: paused now it is deaf until then
        act = SkipAct.PAUSE if is_today else SkipAct.NOTHING
        return DaySkip(act, end_s, meant.weekday())
    if due_s is None or due_s >= end_s:
        return DaySkip(SkipAct.NOTHING, end_s, meant.weekday())
    if isinstance(order.rule, AtRule):
        act = SkipAct.REMOVE if due_s >= begin_s else SkipAct.NOTHING
        return DaySkip(act, end_s, meant.weekday(), due_s)
    if due_s >= begin_s:
        return DaySkip(SkipAct.PAUSE, end_s, meant.weekday(), due_s)
    on_day_s = next_due(order.rule, begin_s - 1.0, zone)
    has_run = on_day_s is not None and on_day_s < end_s
    return DaySkip(SkipAct.BETWEEN if has_run else SkipAct.NOTHING, end_s, meant.weekday(), due_s)
