"""Check that a robot's answer has the shape that the fleet reads; a robot may lie, or be none.

What does not fit is no answer: one robot's nonsense must reach neither the rows nor another
robot's turn. Fields that are not read here may be anything, so that another version passes.
"""

from __future__ import annotations

import re
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

Word = Annotated[str, Field(max_length=64)]
Words = dict[Word, Annotated[str, Field(max_length=4_000)]]
Metres = Annotated[float, Field(ge=-1e6, le=1e6)]
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


class DriveShape(AnswerShape):
    """Be what carries the robot."""

    battery: float | None = None


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


class RehearsalShape(AnswerShape):
    """Be the way of an order that is not given yet."""

    steps: list[dict[str, Any]]
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


def check_answer(method: str, path: str, content: Any) -> None:
    """Pass an answer that can be read.

    Raises:
        ValueError: what does not fit, and where.
    """
    for of_method, pattern, shape in _SHAPES:
        if of_method == method and pattern.fullmatch(path):
            try:
                shape.model_validate(content)
            except ValidationError as wrong:
                first = wrong.errors(include_url=False, include_input=False)[0]
                at = ".".join(str(part) for part in first["loc"])
                raise ValueError(f"{at}: {first['msg']}"[:200]) from None
