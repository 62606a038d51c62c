"""List what a person may say about standing orders. Data only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from planner.language.schedule.parts import EVERY_DAY, DayPart, OnceDay, Part, Problem, WeekDays
from planner.plan.timing import DayTime, InRule, SpokenRule

Act = Literal["remove", "pause", "resume", "skip"]


@dataclass(frozen=True, slots=True)
class ScheduleCommand:
    """Do something at a time, again and again, or when something happens."""

    when: SpokenRule | None
    """None: it can't be kept; ``problem`` says why."""
    order: str
    """What is to be done, in the person's words; empty where nothing is."""
    words: str
    """What was said of the time, for a sentence that is made of it and another order."""
    reminder: str | None = None
    """The words that it reminds of; empty: of the time alone."""
    problem: Problem | None = None


@dataclass(frozen=True, slots=True)
class ListOrders:
    """Tell the standing orders: all, or those that these words name, or those of one day."""

    which: str = ""
    """As said, folded; empty: all of them."""
    day: OnceDay | None = None
    reminders: bool = False
    next_runs: bool = False
    """When they are due next and how long that is, not what they are."""
    is_sure: bool = True
    """False: "how long is left?" may be about something else, where none is kept."""


@dataclass(frozen=True, slots=True)
class ChangeOrders:
    """Remove, pause, resume or skip the standing orders that these words name."""

    act: Act
    which: str
    """As said, folded; empty: all of them."""
    reminders: bool = False
    """Only reminders are meant."""
    is_single: bool = False
    """One is meant ("the reminder"): of several a person says which."""
    is_every: bool = False
    """All that fit are meant: "all the things I told you to do every day"."""
    until: DayTime | InRule | None = None
    """A pause ends then."""
    until_words: str = ""
    """The same as said: "until Monday"; of a day that is left out, its words."""
    day: OnceDay | None = None
    """Skip: the runs of this one day are left out, and no others."""
    is_spoken: bool = False
    """The order that was spoken of last is meant."""
    is_sure: bool = True
    """False: "the red one" may be something else, where no order is called so."""


@dataclass(frozen=True, slots=True)
class Retime:
    """Give an order another time: these parts of it."""

    parts: tuple[Part, ...]
    instead_of: tuple[Part, ...] = ()
    """The time that was wrong, where it was said."""


@dataclass(frozen=True, slots=True)
class LeaveOutDays:
    """Leave days of the week out (0 is Sunday), or keep to them."""

    days: frozenset[int]
    keeps: bool = False
    """Keep to these days, and leave the others out."""


@dataclass(frozen=True, slots=True)
class Delay:
    """Do an order so much later [s]; before zero: earlier."""

    seconds: float


@dataclass(frozen=True, slots=True)
class RemindAgain:
    """Remind again after so long [s]; None: a while."""

    seconds: float | None = None


OrderChange = Retime | LeaveOutDays | Delay | RemindAgain
FoundChange = tuple[OrderChange, str, str]
"""A change, the words that name its order, and the change in words where others stand with it."""


@dataclass(frozen=True, slots=True)
class CorrectOrder:
    """Correct a standing order: the one of a moment ago, or the one that these words name."""

    change: OrderChange
    words: str
    """The change by itself, for a sentence that is made of it and an order's id."""
    which: str = ""
    """As said, folded; empty: the order that was spoken of last."""
    is_sure: bool = False
    """Nothing but a standing order can be meant."""
    otherwise: ScheduleCommand | None = None
    """The meaning of the sentence where there is nothing to correct."""


OrderCommand = ScheduleCommand | ListOrders | ChangeOrders | CorrectOrder


def can_lean(command: OrderCommand) -> bool:
    """Tell whether a sentence means something else where no order is kept that it fits."""
    return not (isinstance(command, ScheduleCommand) or command.is_sure)


def ask_days(parts: tuple[Part, ...], words: str) -> ListOrders | None:
    """Return the question for the orders of a time: one day's, those of every evening, or all."""
    day = next((part for part in parts if isinstance(part, OnceDay)), None)
    if day is not None:
        return ListOrders(day=day)
    if parts == (WeekDays(EVERY_DAY),):
        return ListOrders()
    timed = parts and all(isinstance(part, (WeekDays, DayPart)) for part in parts)
    return ListOrders(words) if timed else None
