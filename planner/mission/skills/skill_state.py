"""Own what a skill that looks remembers of its step: journalled, so that a crash forgets nothing.

Data only. What was looked at stays looked at, across pauses and crashes; times are those of the
step itself, so that no clock of a process that is gone comes back.
"""

from __future__ import annotations

from typing import Any, Self

from planner.plan import Frozen


class Notes(Frozen):
    """Remember how far a step that looks has come."""

    stage: int = 0
    """Of the one thing in hand: what is done next with it."""
    spot: str | None = None
    """Where is looked round from now; its key."""
    views: tuple[int, ...] = ()
    """Directions of that spot that were looked in."""
    turned: int | None = None
    """The direction that was turned to and is to be looked in."""
    spots: tuple[str, ...] = ()
    """Spots that are over: looked round from, or not to be reached."""
    rooms: tuple[str, ...] = ()
    """Rooms that were looked round in."""
    missed: str | None = None
    """The spot to which the way turned out to be shut."""
    shut: tuple[str, ...] = ()
    """Rooms to which there was no way."""
    broke: bool = False
    """The metres that were left did not last for the next way."""
    here: tuple[float, float] | None = None
    """Where the robot stood when it began to look: x [m], y [m] in ``map``."""
    ahead: float | None = None
    """The heading in ``map`` that counts as ahead: how it stood when it looked first [rad]."""
    faced: tuple[float, ...] = ()
    """Directions that were gazed in, in their order: angles to the left of ahead [rad]."""
    order: tuple[str, ...] = ()
    """Rooms to look in, in their order, as of the beginning."""
    aim: str | None = None
    """The thing that is driven up to or looked at again."""
    tried: tuple[str, ...] = ()
    """Things that were looked at again and were not what is wanted."""
    at: tuple[float, float, float] | None = None
    """Where the thing is, as of when it was seen last: x, y, height [m] in ``map``."""
    pointed: tuple[float, float, float] | None = None
    """Where a vision model pointed, likewise: driven to by nobody's word but a person's."""
    sure: float | None = None
    """How sure of the thing one was when the robot stood before it and began to look."""
    label: str | None = None
    color: str | None = None
    stand: int = 0
    """Standing points about the thing that can't be reached."""
    again: int = 0
    """Times that the thing had moved and was gone after."""
    heard: str | None = None
    """An answer that was neither yes nor no, after which was asked once more."""
    seen_s: float = 0.0
    """When it was seen last, in time spent on the step."""

    def but(self, **changes: Any) -> Self:
        """Return these notes with changes."""
        return self.model_copy(update=changes)


NOTHING = Notes()
