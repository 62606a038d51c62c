"""Write what a sentence says of kept standing orders as a suite writes it, in one line.

"change it to 9:00 not 8:00", "change it without 0", "again 300", "list +1", "when pill".
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.schedule import (
    Delay,
    LeaveOutDays,
    RemindAgain,
)
from planner.language.schedule.parts import (
    After,
    DayPart,
    EventPart,
    Interval,
    MonthDay,
    OnceDay,
    TimeOfDay,
    WeekDays,
    list_days,
)

if TYPE_CHECKING:
    from planner.language.schedule import CorrectOrder, ListOrders
    from planner.language.schedule.parts import Part
    from planner.plan.timing import DayTime

_WEEKDAYS = ("mon", "tue", "wed", "thu", "fri", "sat", "sun")


def describe_question(asked: ListOrders) -> str:
    """Return a question about orders."""
    if asked.day is not None:
        return f"list {describe_part(asked.day)}"
    if not asked.next_runs:
        return f"list {asked.which}".strip()
    return f"{'when' if asked.is_sure else 'left'} {asked.which}".strip()


def describe_change(command: CorrectOrder) -> str:
    """Return a correction."""
    which = command.which or "it"
    match command.change:
        case RemindAgain(seconds=seconds):
            return "again" if seconds is None else f"again {seconds:g}"
        case Delay(seconds=seconds):
            return f"change {which} by {seconds:g}"
        case LeaveOutDays(days=days, keeps=keeps):
            how = "only" if keeps else "without"
            return f"change {which} {how} {list_days(days)}"
        case change:
            old = f" not {_describe(change.instead_of)}" if change.instead_of else ""
            return f"change {which} to {_describe(change.parts)}{old}"


def describe_day(rule: DayTime) -> str:
    """Return the day of a time: " +1", " fri", " fri +1w", " 28.3"."""
    if rule.day is not None:
        month = f".{rule.month}" if rule.month is not None else ""
        ahead = f" +{rule.months_ahead}m" if rule.months_ahead is not None else ""
        year = f".{rule.year}" if rule.year is not None else ""
        return f" {rule.day}{month}{year}{ahead}"
    if rule.weekday is not None:
        return f" {_describe_weekday(rule.weekday, rule.week, asks=rule.either_week)}"
    return f" +{rule.days_ahead}" if rule.days_ahead is not None else ""


def _describe_weekday(weekday: int, week: int | None, *, asks: bool) -> str:
    told = f" +{week}w" if week is not None else ""
    return f"{_WEEKDAYS[weekday]}{told}{'?' if asks else ''}"


def _describe(parts: tuple[Part, ...]) -> str:
    return " ".join(map(describe_part, parts))


def describe_part(part: Part) -> str:
    """Return one part of a time."""
    match part:
        case TimeOfDay(hour=hour, minute=minute):
            return f"{hour}:{minute:02}"
        case DayPart():
            return part.value
        case WeekDays(days=days):
            return f"days {list_days(days)}"
        case Interval(seconds=seconds):
            return f"every {seconds:g}"
        case After(seconds=seconds):
            return f"in {seconds:g}"
        case OnceDay(ahead=int(ahead)):
            return f"+{ahead}"
        case OnceDay(weekday=int(weekday), week=week, either_week=asks):
            return _describe_weekday(weekday, week, asks=asks)
        case MonthDay(day=day, month=month):
            return f"{day}.{month}" if month is not None else f"{day}."
        case EventPart(event=event):
            return event.value
        case _:
            return "?"
