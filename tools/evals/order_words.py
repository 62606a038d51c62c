"""Write what a sentence says of standing orders as a suite writes it, in one line.

"cron 0 8 * * *", "change it to 9:00 not 8:00", "again 300", "list +1", "when pill".
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner.language.schedule import (
    ChangeOrders,
    CorrectOrder,
    Delay,
    LeaveOutDays,
    ListOrders,
    RemindAgain,
    ScheduleCommand,
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
from planner.plan.timing import CronRule, DayTime, EventRule, EveryRule, InRule

if TYPE_CHECKING:
    from planner.language.commands import Intent
    from planner.language.schedule.parts import Part
    from planner.plan.timing import SpokenRule

_WEEKDAYS = ("mon", "tue", "wed", "thu", "fri", "sat", "sun")


def describe(intent: Intent | None) -> str:
    """Return a command as a suite writes it."""
    match intent:
        case ListOrders():
            return _describe_question(intent)
        case ChangeOrders():
            until = f" until {_tell_rule(intent.until)}" if intent.until is not None else ""
            day = f" {_describe_part(intent.day)}" if intent.day is not None else ""
            return f"{intent.act} {intent.which}".strip() + until + day
        case CorrectOrder():
            return _describe_change(intent)
        case ScheduleCommand() if intent.when is not None:
            return _tell_rule(intent.when)
        case ScheduleCommand():
            return f"problem {intent.problem}"
        case _:
            return "none"


def is_named(wanted: str, intent: ChangeOrders) -> bool:
    """Tell whether the right act is read, and the words that tell which are among those read."""
    named, _, until = wanted.partition(" until ")
    act, _, which = named.partition(" ")
    read = _tell_rule(intent.until) if intent.until is not None else ""
    if intent.day is not None:
        which, _, day = which.rpartition(" ")
        if day != _describe_part(intent.day):
            return False
    words = all(word in intent.which for word in which.split())
    return act == intent.act and words and until == read


def _tell_rule(rule: SpokenRule) -> str:
    match rule:
        case CronRule():
            return f"cron {rule.cron}"
        case EveryRule():
            return f"every {rule.seconds:g}"
        case InRule():
            return f"in {rule.seconds:g}"
        case EventRule():
            return f"event {rule.event.value}"
        case DayTime():
            return f"day {rule.hour}:{rule.minute:02}{_describe_day(rule)}"


def _describe_question(asked: ListOrders) -> str:
    """Return a question about orders."""
    if asked.day is not None:
        return f"list {_describe_part(asked.day)}"
    if not asked.next_runs:
        return f"list {asked.which}".strip()
    return f"{'when' if asked.is_sure else 'left'} {asked.which}".strip()


def _describe_change(command: CorrectOrder) -> str:
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


def _describe_day(rule: DayTime) -> str:
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
    return " ".join(map(_describe_part, parts))


def _describe_part(part: Part) -> str:
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
