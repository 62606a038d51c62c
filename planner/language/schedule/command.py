"""List what a person may say about standing orders. Data only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from planner.plan.timing import SpokenRule

Problem = Literal["order_nested", "order_time_missing", "order_malformed", "order_in_past",
                  "order_no_such_date"]  # fmt: skip


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
    """Tell the standing orders."""


@dataclass(frozen=True, slots=True)
class ChangeOrders:
    """Remove, pause or resume the standing orders that these words name."""

    act: Literal["remove", "pause", "resume"]
    which: str
    """As said, folded; empty: all of them."""
    reminders: bool = False
    """Only reminders are meant."""


OrderCommand = ScheduleCommand | ListOrders | ChangeOrders
