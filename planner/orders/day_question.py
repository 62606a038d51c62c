"""Ask which day "next Friday" is, where people mean either: the coming one, or the one after.

Pure. Each offer is the whole order again with its date, so that a yes to it is beyond doubt.
"""

from __future__ import annotations

from datetime import datetime
from functools import partial
from typing import TYPE_CHECKING

from planner.language.catalogue import build, raw, say
from planner.orders.calendar_day import days_of_next
from planner.plan import Clarify, Code, Option
from planner.plan.timing import DayTime

if TYPE_CHECKING:
    from datetime import date, tzinfo

    from planner.orders.new_order import NewOrder


def ask_which_day(new: NewOrder, now_unix_s: float, zone: tzinfo) -> Clarify | None:
    """Return the question about an order's day; None where it is beyond doubt."""
    if not isinstance(new.when, DayTime):
        return None
    both = days_of_next(new.when, datetime.fromtimestamp(now_unix_s, zone))
    if both is None:
        return None
    when = new.when
    options = tuple(
        Option(
            label=build(partial(_date, day, when)),
            text=_sentence(new, day, when),
        )
        for day in both
    )
    question = say("standing.which_day", first=options[0].label, second=options[1].label)
    return Clarify(code=Code.AMBIGUOUS, question=question, options=options)


def _date(day: date, when: DayTime, language: str) -> str:
    weekday = raw(f"standing.day_{day.isoweekday() % 7}", language)
    return f"{weekday} {day.isoformat()} {when.hour:02}:{when.minute:02}"


def _sentence(new: NewOrder, day: date, when: DayTime) -> str:
    code = "standing.dated_order" if new.reminder is None else "standing.dated_reminder"
    words = new.order if new.reminder is None else new.reminder
    time = f"{when.hour:02}:{when.minute:02}"
    said = raw(code, new.language.value).format(date=day.isoformat(), time=time, order=words)
    return said.strip()[:2000]
