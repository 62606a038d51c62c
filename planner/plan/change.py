"""Hold what a sentence says about the newest order, and what is known of that order. Data only."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum

from planner.plan.base import Frozen
from planner.plan.steps import Step
from planner.plan.vocabulary import Vocabulary


class Edit(StrEnum):
    """Name what a sentence does with the newest order."""

    AGAIN = "again"
    """The same once more: all of it, its looks or its words."""
    ALSO = "also"
    """The same for one more place, thing or person; or an order of its own after it."""
    INSTEAD = "instead"
    """The same with another place, person or words; or an order of its own in its place."""
    OTHER = "other"
    """The same at the other of two places that were spoken of."""
    WHERE = "where"
    """A place is said where something is, or is to be looked for."""
    LEAVE_OUT = "leave_out"
    """All but one place of it."""
    FIRST = "first"
    """One place of it before all others."""
    MORE = "more"
    """A motion goes on, or back, by so much."""
    OTHER_SIDE = "other_side"
    """A turn to the other side."""
    SEEN = "seen"
    """Whether the thing, or anything, was seen."""
    LIKE = "like"
    """What the thing looks like."""
    THE_ONE = "the_one"
    """To the thing of that kind at a place."""


@dataclass(frozen=True, slots=True)
class Change:
    """Hold what a sentence says about the newest order, each slot as far as it names one."""

    act: Edit
    place: str | None = None
    inner: str | None = None
    """What stands in the place: "the living room, on the sofa"."""
    denied: str | None = None
    """The place that is said not to be meant."""
    thing: str | None = None
    person: str | None = None
    words: str | None = None
    """To be said, or asked of a picture; of ``SEEN`` what was seen."""
    rest: str = ""
    """An order of its own, in the person's words."""
    kind: str = ""
    """Of the step that is meant, where the sentence names one: count, find, look, say."""
    who: str = ""
    """The pronoun for the person or thing."""
    times: int = 1
    way: float = 1.0
    """1: on as before, -1: back."""
    amount: float | None = None
    """Metres or radians; None: a bit."""
    turns: bool | None = None
    """The amount or the side is of a turn; None: not said."""
    side: float | None = None
    """1: left, or ahead; -1: right, or back; None: not said."""
    asks: bool = False
    """It asks, and orders nothing new: "and in the study?"."""
    tells: bool = False
    """It tells where something is, and by itself sends nobody there."""
    tries: bool = False
    """It says to look there."""
    missed: bool = False
    """It says that the search before found nothing."""


class ChangedOrder(Frozen):
    """Say what the built-in brain plans for a sentence that leans on the newest order."""

    steps: tuple[Step, ...] = ()
    """The newest order's steps with the one change that the sentence asks for."""
    words: str = ""
    """The part of the sentence that is an order by itself, where there are no such steps."""


@dataclass(frozen=True, slots=True)
class LastOrder:
    """Hold what is known of the newest order."""

    steps: tuple[Step, ...]
    ahead: tuple[Step, ...] = ()
    """Those that are still to do; empty once it has ended, or where they cannot be parted."""
    ended: bool = False
    found: bool = False
    """It is over, and found what it was for."""
    person: str | None = None
    """The one person that it speaks to."""
    thing: str | None = None
    """The one thing that it speaks of."""
    spoken: frozenset[str] = frozenset()
    """Places that were spoken of about it."""
    looked: frozenset[str] = frozenset()
    """Rooms in which its search has looked."""
    turned_rad: float = 0.0
    """How far its turn has come."""
    names: Vocabulary = field(default_factory=Vocabulary)
    seen_as: Callable[[str], str | None] = lambda _: None
    """The question whether a thing is there, in its language; None of one who is called."""
