"""Find the day that a person names: "tomorrow", "next Friday", "on 28 March", "on the 5th". Pure.

Law: a day that is said whole and is over is never taken for another one; where only a part of it
is said ("on the 5th", "on Friday"), it is the next such day.
"""

from __future__ import annotations

from datetime import date, timedelta
from typing import TYPE_CHECKING

from planner.orders.errors import OrderRefusal

if TYPE_CHECKING:
    from datetime import datetime

    from planner.plan.timing import DayTime

JUST_OVER_DAYS = 31
"""A date without a year that is over for so long at most was meant; an older one is next year's."""
_LONGEST_GAP = 3
"""Months that are looked at for the 31st: no two in a row lack it."""


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
