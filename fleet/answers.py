"""Check that a robot's answer has the shape that the fleet reads; a robot may lie, or be none.

The one place that judges it: whoever is given an answer reads its fields without another check.
What does not fit is no answer: one robot's nonsense must reach neither the rows nor another
robot's turn. Fields that are not read here may be anything, so that another version passes.
"""

from __future__ import annotations

import re
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fleet.errors import FleetError

Word = Annotated[str, Field(max_length=64)]
Words = dict[Word, Annotated[str, Field(max_length=4_000)]]
Metres = Annotated[float, Field(ge=-1e4, le=1e4)]
Name = Annotated[str, Field(max_length=200)]
MOST_GOALS = 200


class AnswerShape(BaseModel):
    """Leave what is not read as it is."""

    model_config = ConfigDict(allow_inf_nan=False, strict=True)


class StepShape(AnswerShape):
    """Be one step of a plan."""

    kind: Word = ""
    state: Word | None = None
    text: Annotated[str, Field(max_length=4_000)] | None = None


class PlanShape(AnswerShape):
    """Be a plan, or a question."""

    steps: list[StepShape] = []
    options: list[Any] = []
    text: str | Words | None = None


class OutcomeShape(AnswerShape):
    """Say how a goal ended."""

    message: Words | None = None


class GoalShape(AnswerShape):
    """Be one goal of the journal."""

    id: Annotated[str, Field(min_length=1, max_length=64)]
    state: Annotated[str, Field(pattern=r"^[a-z_]{1,32}$")]
    reason: Word | None = None
    plan: PlanShape | None = None
    outcome: OutcomeShape | None = None


class ChangesShape(AnswerShape):
    """Be one page of the journal's changes."""

    goals: Annotated[list[GoalShape], Field(max_length=MOST_GOALS)]
    next: Annotated[int, Field(ge=0, le=2**53)]


class PoseShape(AnswerShape):
    """Be where a robot stands, in ``map``."""

    x_m: Metres
    y_m: Metres
    yaw_rad: Annotated[float, Field(ge=-1e3, le=1e3)]


class DriveShape(AnswerShape):
    """Be what carries the robot."""

    battery: Annotated[float, Field(ge=0.0, le=1.0)] | None = None


class StatusShape(AnswerShape):
    """Be what the bridge says."""

    mode: Word | None = None
    base_in_map: PoseShape | None = None
    drive: DriveShape | None = None


class RobotShape(AnswerShape):
    """Be the state of a robot."""

    status: StatusShape | None = None
    room: Word | None = None
    map_id: Word | None = None


class RehearsedStepShape(AnswerShape):
    """Be one step of an order that is not given yet, with the points of its way [m]."""

    does: Word
    place: Word | None = None
    points: list[Annotated[list[Metres], Field(min_length=2, max_length=2)]] | None = None


class RehearsalShape(AnswerShape):
    """Be the way of an order that is not given yet; without a length it is not known."""

    steps: list[RehearsedStepShape]
    length_m: Annotated[float, Field(ge=0.0, le=1e6)] | None = None


class SkillShape(AnswerShape):
    """Be a skill of the owner's, with the sentences that call it."""

    name: Word
    en: list[str] = []
    zh: list[str] = []


class SkillsShape(AnswerShape):
    """Be all skills of a robot."""

    skills: Annotated[list[SkillShape], Field(max_length=500)] = []


class AmountsShape(AnswerShape):
    """Be what a robot's model spent; nobody gives anything back to the house's budget."""

    money: Annotated[float, Field(ge=0.0)] = 0.0
    calls: Annotated[int, Field(ge=0)] = 0


class UsageShape(AnswerShape):
    """Be a robot's meter."""

    model: str | None = None
    day: Word = ""
    currency: Word | None = None
    today: AmountsShape | None = None


class CardPoseShape(BaseModel):
    """Be where a place is; robots of before had poses without a direction."""

    model_config = ConfigDict(allow_inf_nan=False)

    x_m: float
    y_m: float


class CardPlaceShape(BaseModel):
    """Be a room or a place that a robot knows."""

    model_config = ConfigDict(allow_inf_nan=False)

    id: Name
    name: Annotated[dict[str, Name], Field(max_length=20)] = {}
    aliases: Annotated[dict[str, list[Name]], Field(max_length=20)] = {}
    pose: CardPoseShape | None = None
    polygon: Annotated[list[tuple[float, float]], Field(max_length=1_000)] | None = None


class CardShape(BaseModel):
    """Be what a robot tells of itself."""

    model_config = ConfigDict(allow_inf_nan=False)

    robot_id: Annotated[str, Field(min_length=1, max_length=64)]
    release: Name | None = None
    site: Name | None = None
    map_id: Name | None = None
    camera: Name | None = None
    radius_m: Annotated[float, Field(gt=0.0, le=10.0)] | None = None
    places: Annotated[list[CardPlaceShape], Field(max_length=2_000)] = []
    steps: Annotated[list[Name], Field(max_length=200)] | None = None
    languages: Annotated[list[Name], Field(max_length=20)] | None = None


_SHAPES: tuple[tuple[str, re.Pattern[str], type[AnswerShape]], ...] = (
    ("GET", re.compile(r"/v1/goals"), ChangesShape),
    ("POST", re.compile(r"/v1/goals"), GoalShape),
    ("GET", re.compile(r"/v1/goals/[^/]+"), GoalShape),
    ("POST", re.compile(r"/v1/goals/[^/]+/[a-z]+"), GoalShape),
    ("GET", re.compile(r"/v1/robot"), RobotShape),
    ("POST", re.compile(r"/v1/rehearsals"), RehearsalShape),
    ("GET", re.compile(r"/v1/skills"), SkillsShape),
    ("GET", re.compile(r"/v1/usage"), UsageShape),
)


def check_answer(method: str, path: str, content: Any) -> Any:
    """Return an answer that can be read; of a robot's state the fields that are read, each there.

    Raises:
        ValueError: what does not fit, and where.
    """
    for of_method, pattern, shape in _SHAPES:
        if of_method == method and pattern.fullmatch(path):
            try:
                read = shape.model_validate(content)
            except ValidationError as wrong:
                raise ValueError(_first_of(wrong)) from None
            return read.model_dump() if shape is RobotShape else content
    return content


def read_card(told: Any, name: str) -> dict[str, Any]:
    """Return a card as it came, unknown fields too: another version may have more of them.

    Args:
        told: what the robot answered.
        name: of the robot, for the refusal.

    Raises:
        FleetError: ``card_unread``.
    """
    try:
        CardShape.model_validate(told)
    except ValidationError as wrong:
        raise FleetError("card_unread", _first_of(wrong), name=name) from None
    card: dict[str, Any] = told
    return card


def _first_of(wrong: ValidationError) -> str:
    first = wrong.errors(include_url=False, include_input=False)[0]
    return f"{'.'.join(str(part) for part in first['loc'])}: {first['msg']}"[:200]
