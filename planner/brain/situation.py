"""Tell a brain where things stand: what the robot does now, and what came of the last goals.

Facts and people's orders, no advice. Nothing that was read in a picture is among them, nor what was
said after it (``planner.brain.tainted_text``): a sign must reach no later goal.
"""

from __future__ import annotations

from planner.plan import Frozen

MAX_RECENT = 5
"""Goals of before that a brain is told of."""
MAX_QUEUED = 3


class RecentGoal(Frozen):
    """Report one goal that ended, or that waits."""

    order: str
    outcome: str
    """Its stable code, or its state."""
    told: str = ""
    minutes: int = 0
    """Since it was given."""


class OpenQuestion(Frozen):
    """Report a question that waits for a person's answer."""

    order: str
    asked: str


class RememberedItem(Frozen):
    """Report one thing that was seen, or that a person said: data, and never an order."""

    what: str
    """A kind with its colour, or a person's words: short, cleaned."""
    place: str | None = None
    """The id of a room or place."""
    minutes: int = 0
    """Since it was seen last, or said."""
    said: bool = False
    """A person said it; else it was seen."""
    fits: bool = False
    """The order names it."""


class Situation(Frozen):
    """Hold what a brain may know besides the sentence and the places."""

    time: str | None = None
    """People's own clock, with the day of the week."""
    battery: float | None = None
    """Share of the charge, 0 to 1."""
    room: str | None = None
    place: str | None = None
    """The id of a place that the robot stands at."""
    heading_deg: float | None = None
    """In ``map``, counter-clockwise from its x."""
    running: str | None = None
    """The order that has the robot."""
    step: str | None = None
    """The kind of the step that it is at, and its place."""
    queue: tuple[str, ...] = ()
    more: int = 0
    """Orders that wait beyond these."""
    thinking: tuple[str, ...] = ()
    """Other orders that are being thought about, oldest first."""
    paused: tuple[str, ...] = ()
    """Orders that keep their place and go on when a person says so, newest first."""
    question: OpenQuestion | None = None
    recent: tuple[RecentGoal, ...] = ()
    """Newest first."""
    remembered: tuple[RememberedItem, ...] = ()
    """What the order names first, then the newest."""
