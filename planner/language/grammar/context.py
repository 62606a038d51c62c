"""Hold what a sentence is read against besides the names of places."""

from __future__ import annotations

from datetime import datetime

from planner.plan import RUNNABLE, Code, Frozen, Language, LastOrder


class Context(Frozen):
    """Hold a brain's facts besides the sentence: place, time, the robot's capabilities."""

    room: str | None = None
    language: Language | None = None
    now: datetime | None = None  # for "what time is it"
    runnable: frozenset[str] = RUNNABLE  # kinds of steps the robot can do
    blind: Code = Code.NO_CAMERA  # what is said of looking where it can't
    things: frozenset[str] = frozenset()  # what can be driven up to though it is no place
    remembers: bool = False  # something that the sentence names is remembered
    departed: bool = False  # an order before led the robot away: "come back" is back from there
    newest: LastOrder | None = None  # what "again" and "skip the kitchen" change
    moved: bool = False  # it is a part of an order: the robot has driven somewhere before it


NOWHERE = Context()
