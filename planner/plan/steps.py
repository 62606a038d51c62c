"""Own the closed vocabulary of steps: what a plan may ask of the robot, and nothing else.

No step carries map coordinates or a speed; a place is an id of the vocabulary. Lengths are metres,
angles radians (counter-clockwise positive), times seconds.
"""

from __future__ import annotations

from math import pi
from typing import Annotated, Literal, get_args

from pydantic import Field, StringConstraints

from planner.plan.base import Frozen
from planner.plan.vocabulary import PlaceId

Words = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=500)]
Label = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=80)]
Span = Literal["hour", "today", "morning", "afternoon", "evening", "night", "yesterday", "week"]
"""A time that people ask about, by the day and the clock of the home."""


class GoTo(Frozen):
    """Drive to a room or place."""

    kind: Literal["go_to"] = "go_to"
    place: PlaceId


class ComeBack(Frozen):
    """Drive back to where this goal was given."""

    kind: Literal["come_back"] = "come_back"


class ReturnHome(Frozen):
    """Drive to the site's home."""

    kind: Literal["return_home"] = "return_home"


class Wait(Frozen):
    """Stand still for a while [s]."""

    kind: Literal["wait"] = "wait"
    seconds: float = Field(gt=0.0, le=600.0)


class Say(Frozen):
    """Say words: people read them on the page."""

    kind: Literal["say"] = "say"
    text: Words


class Ask(Frozen):
    """Ask the person a question and wait for the answer."""

    kind: Literal["ask"] = "ask"
    question: Words


class Decide(Frozen):
    """Think again with what was seen and heard."""

    kind: Literal["decide"] = "decide"
    question: Words


class Turn(Frozen):
    """Turn on the spot by an angle [rad], counter-clockwise positive."""

    kind: Literal["turn"] = "turn"
    angle_rad: float = Field(ge=-4 * pi, le=4 * pi)


class MoveStraight(Frozen):
    """Drive straight by a distance [m], backwards where negative."""

    kind: Literal["move"] = "move"
    distance_m: float = Field(ge=-10.0, le=10.0)


class Patrol(Frozen):
    """Drive to places in turn, not looking."""

    kind: Literal["patrol"] = "patrol"
    places: Annotated[tuple[PlaceId, ...], Field(min_length=1, max_length=20)]


class Explore(Frozen):
    """Drive over floor that is not on the map yet, until the map is whole."""

    kind: Literal["explore"] = "explore"


class GoToObject(Frozen):
    """Drive up to an object that was seen."""

    kind: Literal["go_to_object"] = "go_to_object"
    object: Label
    place: PlaceId | None = None


class GoToPoint(Frozen):
    """Drive to what lies at a point of the picture (x right, y down)."""

    kind: Literal["go_to_point"] = "go_to_point"
    x: int = Field(ge=0, le=1000)
    y: int = Field(ge=0, le=1000)


class Find(Frozen):
    """Look for an object or person, in a place where named."""

    kind: Literal["find"] = "find"
    object: Label
    place: PlaceId | None = None


class Count(Frozen):
    """Count objects or people, in a place where named."""

    kind: Literal["count"] = "count"
    object: Label
    place: PlaceId | None = None


class Look(Frozen):
    """Look and answer a question about what is seen."""

    kind: Literal["look"] = "look"
    question: Words
    place: PlaceId | None = None


class Recall(Frozen):
    """Tell what was seen or told; with deeds, what you did."""

    kind: Literal["recall"] = "recall"
    object: Label | None = None
    place: PlaceId | None = None
    when: Span | None = None
    deeds: bool = False


class Follow(Frozen):
    """Follow a person at a distance."""

    kind: Literal["follow"] = "follow"
    object: Label


Step = Annotated[
    GoTo
    | ComeBack
    | ReturnHome
    | Wait
    | Say
    | Ask
    | Decide
    | Turn
    | MoveStraight
    | Patrol
    | Explore
    | GoToObject
    | GoToPoint
    | Find
    | Count
    | Look
    | Follow
    | Recall,
    Field(discriminator="kind"),
]
_MODELS: tuple[type[Frozen], ...] = get_args(get_args(Step)[0])

RUNNABLE = frozenset(
    {"go_to", "come_back", "return_home", "turn", "move", "patrol"}
    | {"wait", "say", "ask", "decide", "recall"}
)  # what a mission can walk without eyes; `Means` says what else a robot can
NEEDS_GROWING_MAP = frozenset({"explore"})
NEEDS_CAMERA = frozenset({"go_to_object", "go_to_point", "find", "count", "look", "follow"})
STANDS = frozenset({"recall"})
"""What names a place and drives nowhere."""
EVERY_KIND = frozenset(get_args(model.model_fields["kind"].annotation)[0] for model in _MODELS)
"""What a plan may hold at all; a robot's own `runnable` is a part of it."""
DRIVES = frozenset(
    {"go_to", "come_back", "return_home", "turn", "move", "patrol", "explore"}
    | {"go_to_object", "go_to_point", "find", "follow"}
)
