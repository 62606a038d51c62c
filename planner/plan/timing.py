"""Own the rules of when a standing order is due: by the clock, after a while, again and again, upon
an event. Data only: no rule knows what time it is.

``DayTime`` is a time as a person says it ("tomorrow at nine"); it becomes an ``AtRule`` where time
and zone are known (``planner.orders.rule``).
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from planner.plan.base import Frozen

MAX_AHEAD_S = 366 * 86_400.0
"""Nothing is put off by more than a year."""


SPAN = r"^([01]\d|2[0-3]):[0-5]\d-([01]\d|2[0-3]):[0-5]\d$"
"""A span of the day; it may go past midnight."""


class WorldEvent(StrEnum):
    """Name what the planner can notice by itself."""

    PERSON_SEEN = "person_seen"
    MOVEMENT = "movement"
    BATTERY_LOW = "battery_low"
    GOAL_DONE = "goal_done"
    GOAL_FAILED = "goal_failed"
    ARRIVED_HOME = "arrived_home"


class CronRule(Frozen):
    """Be due at times of day and week: five fields as cron has them, in the owner's time zone."""

    kind: Literal["cron"] = "cron"
    cron: Annotated[str, StringConstraints(strip_whitespace=True, min_length=9, max_length=100)]


class AtRule(Frozen):
    """Be due once, at an instant."""

    kind: Literal["at"] = "at"
    unix_s: float = Field(ge=0.0, le=4e9)
    relative: bool = False
    """It was said as "in 20 minutes": where the clock is put right, it moves along."""


class EveryRule(Frozen):
    """Be due again and again, so long apart [s], counted from the instant it was given."""

    kind: Literal["every"] = "every"
    seconds: float = Field(gt=0.0, le=MAX_AHEAD_S)
    anchor_unix_s: float = Field(default=0.0, ge=0.0, le=4e9)


class EventRule(Frozen):
    """Be due when something happens."""

    kind: Literal["event"] = "event"
    event: WorldEvent
    hours: Annotated[str, StringConstraints(pattern=SPAN)] | None = None
    """The hours of the day in which it counts, like ``16:00-00:00``; None: always."""


class InRule(Frozen):
    """Be due once, after so long [s]; becomes an ``AtRule`` as it is taken."""

    kind: Literal["in"] = "in"
    seconds: float = Field(gt=0.0, le=MAX_AHEAD_S)


class DayTime(Frozen):
    """Be due once, at a time of day on a day that is named as people name one.

    At most one of ``days_ahead``, ``weekday`` and ``day`` is set; none: the next such time.
    """

    kind: Literal["day_time"] = "day_time"
    hour: int = Field(ge=0, le=23)
    minute: int = Field(default=0, ge=0, le=59)
    days_ahead: int | None = Field(default=None, ge=0, le=366)
    """0 today, 1 tomorrow."""
    weekday: int | None = Field(default=None, ge=0, le=6)
    """Monday is 0."""
    week: int | None = Field(default=None, ge=0, le=9)
    """Of the weekday: so many calendar weeks after this one; None: the next such day."""
    either_week: bool = False
    """"Next Friday": the coming one or the one after, so a person is asked where they differ."""
    day: int | None = Field(default=None, ge=1, le=31)
    """Of a month."""
    month: int | None = Field(default=None, ge=1, le=12)
    """None: the month in which such a day comes next, or ``months_ahead``."""
    months_ahead: int | None = Field(default=None, ge=0, le=12)
    year: int | None = Field(default=None, ge=2000, le=2099)
    years_ahead: int | None = Field(default=None, ge=0, le=9)
    coming: bool = False
    """A feast: never the one that is over."""
    either_half: bool = False
    """"At eight" alone: whichever of 8:00 and 20:00 comes first."""


Rule = Annotated[CronRule | AtRule | EveryRule | EventRule, Field(discriminator="kind")]
"""What is kept of a standing order."""
SpokenRule = CronRule | InRule | EveryRule | EventRule | DayTime
"""What a sentence says."""
