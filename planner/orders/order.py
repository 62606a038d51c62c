"""Own the records of standing orders: the order, and each of its firings. Data only.

A firing is written down before its goal is given (``planner.orders.scheduler``), so that no crash
can make the robot do one twice.
"""

from __future__ import annotations

from datetime import date
from enum import StrEnum
from secrets import token_hex
from typing import TYPE_CHECKING, Annotated

from pydantic import Field

from planner.mission.state import RESERVED_KEYS
from planner.plan import Bilingual, Frozen, Language, Step, StepRecord
from planner.plan.timing import AtRule, EventRule, Rule

if TYPE_CHECKING:
    from collections.abc import Iterable

MAX_ORDERS = 64
"""Of one robot. Each is looked at ten times a second, and told to every page."""
MAX_ORDER_CHARACTERS = 500
MAX_REMINDER_CHARACTERS = 300
COOLDOWN_S = 60.0
"""Between two firings of one order upon an event."""


class StandingOrder(Frozen):
    """Keep one standing order whole."""

    id: str
    number: int
    """Rises with every order given, and is never used again: see ``OrderStore``."""
    nonce: str = ""
    """Random part of its firings' keys; empty in records of older programs until they are read."""
    text: str
    """As the person said it."""
    order: Annotated[str, Field(min_length=1, max_length=MAX_ORDER_CHARACTERS)]
    """What is given as a goal each time."""
    language: Language
    rule: Rule
    reminder: str | None = None
    """The words that it reminds of, where that is all it does."""
    source: str = "api"
    allowed: tuple[StepRecord, ...] = ()
    """What it may do: the plan that was told to the person as the order was given."""
    steps: tuple[Step, ...] = ()
    """What it does, where a person said yes to these; none: the order is read each time."""
    paused: bool = False
    resume_unix_s: float | None = None
    """A pause ends by itself then."""
    skipped: tuple[date, ...] = ()
    """Days that are left out, by the robot's own calendar (``planner.orders.rule``)."""
    ended: bool = False
    """It was due once, and that is over."""
    created_unix_s: float
    handled_unix_s: float
    """All that was due until then was done, missed or left out. No run before it is ever begun."""
    fired: int = 0
    missed: int = 0
    serial: int = 0
    """Of its newest firing."""

    @property
    def is_once(self) -> bool:
        """Tell whether it is due one time only."""
        return isinstance(self.rule, AtRule)

    @property
    def is_event(self) -> bool:
        """Tell whether it waits for an event."""
        return isinstance(self.rule, EventRule)


def end_pauses(orders: Iterable[StandingOrder], unix_s: float) -> tuple[StandingOrder, ...]:
    """Return the orders whose pause is over, going on: what was due in it is over as well."""
    return tuple(
        order.model_copy(
            update={
                "paused": False,
                "resume_unix_s": None,
                "handled_unix_s": max(order.handled_unix_s, order.resume_unix_s),
            }
        )
        for order in orders
        if order.paused and order.resume_unix_s is not None and order.resume_unix_s <= unix_s
    )


def new_nonce() -> str:
    """Return a random part for the keys of one order's firings."""
    return token_hex(8)


class FiringState(StrEnum):
    """Name what became of one run."""

    BEGUN = "begun"
    """Written down; whether its goal was given is not known yet."""
    GIVEN = "given"
    """Its goal was given; how it ended is the goal's story."""
    ENDED = "ended"
    MISSED = "missed"
    QUIET = "quiet"
    """It was left out: quiet hours."""


class Firing(Frozen):
    """Keep one run of an order, or several that were missed together."""

    order: str
    serial: int
    due_unix_s: float
    at_unix_s: float
    state: FiringState
    goal: str | None = None
    reason: str | None = None
    """Why it was missed: a stable code."""
    count: int = 1
    """So many runs in a row came to the same."""
    until_unix_s: float | None = None
    """When the last of these was due."""
    code: str | None = None
    """How its goal ended."""
    told: Bilingual | None = None


def key_of(order: StandingOrder, serial: int) -> str:
    """Return the Idempotency-Key with which a firing's goal is given; nobody else can know it."""
    nonce = f"{order.nonce}:" if order.nonce else ""
    return f"{RESERVED_KEYS}{order.id}:{nonce}{serial}"
