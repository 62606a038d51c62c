"""Own the closed vocabulary of steps: what a plan may ask of the robot, and nothing else.

No step carries a speed, and none that a brain may write carries map coordinates: a place is an id
of the vocabulary, and a point of the map stands in ``go_to_pose`` alone, which a person gives.
Lengths are metres, angles radians (counter-clockwise positive), times seconds. Steps that hold
steps (``if``, ``try``, ``repeat``) are bounded by ``planner.plan.check``: how deep, how many, how
long.
"""

from __future__ import annotations

from math import pi
from typing import Annotated, Literal, Self, get_args

from pydantic import Field, StringConstraints, model_validator

from planner.plan.base import Frozen
from planner.plan.skill import MOST_PARAMETERS, SkillName
from planner.plan.tool import UseTool
from planner.plan.vocabulary import PlaceId
from wire.bounded_types import Fingerprint
from wire.geometry import Metres, Yaw

Words = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=500)]
Label = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=80)]
Span = Literal["hour", "today", "morning", "afternoon", "evening", "night", "yesterday", "week"]
"""A time that people ask about, by the day and the clock of the home."""


Side = Literal["before", "beside", "behind", "facing"]
"""Where to stand to something, as seen from where one usually stands before it."""
MAX_FOLLOW_S = 300.0


class GoTo(Frozen):
    """Drive to a room or place."""

    kind: Literal["go_to"] = "go_to"
    place: PlaceId


class GoToPose(Frozen):
    """Drive to a point of the map that a person gave, and to a heading where one is given."""

    kind: Literal["go_to_pose"] = "go_to_pose"
    map_id: Fingerprint
    """The map that the point is on: on any other it is nowhere."""
    x_m: Metres
    y_m: Metres
    yaw_rad: Yaw | None = None
    look: bool = False
    """Stand near by, where the point is seen from, and face it."""

    @model_validator(mode="after")
    def _faces_one_way(self) -> Self:
        if self.look and self.yaw_rad is not None:
            raise ValueError("go_to_pose takes yaw_rad or look: a look faces the point")
        return self


class StandAt(Frozen):
    """Stand there; facing: turn."""

    kind: Literal["stand_at"] = "stand_at"
    place: PlaceId | None = None
    object: Label | None = None
    side: Side
    distance_m: float | None = Field(default=None, ge=0.0, le=5.0)

    @model_validator(mode="after")
    def _names_one(self) -> Self:
        if (self.place is None) is (self.object is None):
            raise ValueError("stand_at needs place or object")
        return self


class ComeBack(Frozen):
    """Drive back to where the order was given."""

    kind: Literal["come_back"] = "come_back"


class ReturnHome(Frozen):
    """Drive home."""

    kind: Literal["return_home"] = "return_home"


class Wait(Frozen):
    """Stand still [s]."""

    kind: Literal["wait"] = "wait"
    seconds: float = Field(gt=0.0, le=600.0)


class Say(Frozen):
    """Say words aloud."""

    kind: Literal["say"] = "say"
    text: Words


class Ask(Frozen):
    """Ask the person."""

    kind: Literal["ask"] = "ask"
    question: Words


class Decide(Frozen):
    """Think again."""

    kind: Literal["decide"] = "decide"
    question: Words


class Turn(Frozen):
    """Turn on the spot, left positive."""

    kind: Literal["turn"] = "turn"
    angle_rad: float = Field(ge=-4 * pi, le=4 * pi)


class MoveStraight(Frozen):
    """Drive straight [m], backwards where negative."""

    kind: Literal["move"] = "move"
    distance_m: float = Field(ge=-10.0, le=10.0)


class Patrol(Frozen):
    """Drive to places in turn; look: look at each."""

    kind: Literal["patrol"] = "patrol"
    places: Annotated[tuple[PlaceId, ...], Field(min_length=1, max_length=20)]
    look: bool = False


class Explore(Frozen):
    """Drive over floor that is not on the map yet, until the map is whole."""

    kind: Literal["explore"] = "explore"


class GoToObject(Frozen):
    """Drive up to an object."""

    kind: Literal["go_to_object"] = "go_to_object"
    object: Label
    place: PlaceId | None = None


class GoToPoint(Frozen):
    """Drive to what lies at a point of the picture (x right, y down)."""

    kind: Literal["go_to_point"] = "go_to_point"
    x: int = Field(ge=0, le=1000)
    y: int = Field(ge=0, le=1000)


class Find(Frozen):
    """Search room by room; not all may be reached."""

    kind: Literal["find"] = "find"
    object: Label
    place: PlaceId | None = None


class Count(Frozen):
    """Count things or people."""

    kind: Literal["count"] = "count"
    object: Label
    place: PlaceId | None = None


class Look(Frozen):
    """Look and answer."""

    kind: Literal["look"] = "look"
    question: Words
    place: PlaceId | None = None


class Recall(Frozen):
    """Tell what is remembered; deeds: what you did."""

    kind: Literal["recall"] = "recall"
    object: Label | None = None
    place: PlaceId | None = None
    span: Span | None = None
    deeds: bool = False


class Follow(Frozen):
    """Follow a person."""

    kind: Literal["follow"] = "follow"
    object: Label
    seconds: float | None = Field(default=None, gt=0.0, le=MAX_FOLLOW_S)


ClockHour = Annotated[str, StringConstraints(pattern=r"^(?:[01]\d|2[0-3]):[0-5]\d$")]
MAX_ROUNDS = 20
MAX_LOOP_S = 3600.0
MAX_PATIENCE_S = 600.0


class ClockTime(Frozen):
    """Ask people's clock: is it that late already, and not yet that late (HH:MM)?"""

    kind: Literal["clock"] = "clock"
    after: ClockHour | None = None
    before: ClockHour | None = None

    @model_validator(mode="after")
    def _has_a_time(self) -> Self:
        if self.after is None and self.before is None:
            raise ValueError("clock needs after or before, as HH:MM")
        return self


Condition = Annotated[Look | Find | Ask | Recall | ClockTime, Field(discriminator="kind")]
"""What may be asked before steps are chosen; ``skills/conditions.py`` judges each kind. A
recall asks whether it is remembered as seen or done: what was merely told counts for nothing."""


class If(Frozen):
    """Do then where the condition holds, else otherwise."""

    kind: Literal["if"] = "if"
    when: Condition
    then: tuple[Step, ...] = ()
    otherwise: tuple[Step, ...] = ()

    @model_validator(mode="after")
    def _does_something(self) -> Self:
        if not self.then and not self.otherwise:
            raise ValueError("if needs steps in then or in otherwise")
        return self


class Attempt(Frozen):
    """Do steps; where one fails, do on_failure instead."""

    kind: Literal["try"] = "try"
    steps: Annotated[tuple[Step, ...], Field(min_length=1)]
    on_failure: Annotated[tuple[Step, ...], Field(min_length=1)]


class Repeat(Frozen):
    """Do steps so many times, or until the condition holds."""

    kind: Literal["repeat"] = "repeat"
    steps: Annotated[tuple[Step, ...], Field(min_length=1)]
    times: int = Field(default=MAX_ROUNDS, ge=1, le=MAX_ROUNDS)
    until: Condition | None = None
    seconds: float = Field(default=MAX_LOOP_S, gt=0.0, le=MAX_LOOP_S)


class WaitFor(Frozen):
    """Stand until one of them comes: seen, said or late enough."""

    kind: Literal["wait_for"] = "wait_for"
    object: Label | None = None
    word: Label | None = None
    time: ClockHour | None = None
    seconds: float = Field(default=MAX_PATIENCE_S, gt=0.0, le=MAX_PATIENCE_S)

    @model_validator(mode="after")
    def _waits_for_one(self) -> Self:
        if sum(each is not None for each in (self.object, self.word, self.time)) != 1:
            raise ValueError("wait_for needs one of object, word and time")
        return self


class UseSkill(Frozen):
    """Do a skill of the owner's."""

    kind: Literal["use_skill"] = "use_skill"
    name: SkillName
    arguments: Annotated[
        tuple[Annotated[str, StringConstraints(max_length=200)], ...],
        Field(max_length=MOST_PARAMETERS),
    ] = ()
    """In the row of the skill's parameters; an empty one is left out."""


Step = Annotated[
    GoTo
    | GoToPose
    | StandAt
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
    | Recall
    | WaitFor
    | If
    | Attempt
    | Repeat
    | UseSkill
    | UseTool,
    Field(discriminator="kind"),
]
for _model in (If, Attempt, Repeat):
    _model.model_rebuild()
_MODELS: tuple[type[Frozen], ...] = get_args(get_args(Step)[0])

RUNNABLE = frozenset(
    {"go_to", "stand_at", "come_back", "return_home", "turn", "move", "patrol"}
    | {"wait", "say", "ask", "decide", "recall", "wait_for", "if", "try", "repeat"}
)  # what a mission can walk without eyes; `Means` says what else a robot can
NEEDS_GROWING_MAP = frozenset({"explore"})
NEEDS_CAMERA = frozenset({"go_to_object", "go_to_point", "find", "count", "look", "follow"})
STANDS = frozenset({"recall"})
"""What names a place and drives nowhere."""
GIVEN = frozenset({"go_to_pose"})
"""What a person alone gives, by pointing: no brain is offered it, and none may write it."""
MODELS = {get_args(model.model_fields["kind"].annotation)[0]: model for model in _MODELS}
"""Every step, by its kind."""
CALLS = frozenset({"use_skill"})
"""What stands for other steps, which take its place before a plan is judged: no mission walks it,
and it is offered where there are skills alone."""
TOOL_CALLS = frozenset({"use_tool"})
"""It is offered where there are tools alone. It stands, and no branch can hang on it."""
EVERY_KIND = frozenset(MODELS) - GIVEN - CALLS - TOOL_CALLS
"""What a brain's plan may hold at all; a robot's own `runnable` is a part of it."""
CONTROL = frozenset({"if", "try", "repeat"})
"""They hold steps and do nothing by themselves."""
CONDITIONS = frozenset({"look", "find", "ask", "recall", "clock"})
DRIVES = frozenset(
    {"go_to", "stand_at", "come_back", "return_home", "turn", "move", "patrol", "explore"}
    | {"go_to_object", "go_to_point", "find", "follow"}
    | GIVEN
)
