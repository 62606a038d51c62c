"""Read a goal's record as this program wrote it, or a former one. Pure.

Programs that wrote schema 1 kept one record for all skills, ``notes``: 24 fields, most of them
empty for any one skill, and a number whose meaning hung on the skill and on other fields. Here it
is read into the state of the skill whose step was the current one.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from pydantic import ValidationError

from planner.mission.state import Mission
from planner.plan import Frozen
from planner.skills.skill_state import (
    STATES,
    AimStage,
    ApproachStage,
    AskStage,
    FollowStage,
    LookStage,
    Point3,
    PointingStage,
)


class _Notes(Frozen):
    """Mirror what schema 1 kept of a step, whatever its skill."""

    stage: int = 0
    spot: str | None = None
    views: tuple[int, ...] = ()
    turned: int | None = None
    spots: tuple[str, ...] = ()
    rooms: tuple[str, ...] = ()
    missed: str | None = None
    shut: tuple[str, ...] = ()
    broke: bool = False
    here: tuple[float, float] | None = None
    ahead: float | None = None
    faced: tuple[float, ...] = ()
    order: tuple[str, ...] = ()
    aim: str | None = None
    tried: tuple[str, ...] = ()
    at: Point3 | None = None
    pointed: Point3 | None = None
    sure: float | None = None
    label: str | None = None
    color: str | None = None
    stand: int = 0
    again: int = 0
    heard: str | None = None
    seen_s: float = 0.0


class _FormerMission(Mission):
    """Mirror a goal's record of schema 1."""

    notes: _Notes
    skill_state: None = None


_AIMS = MappingProxyType({1: AimStage.NEAR, 2: AimStage.FACING})
_APPROACHES = MappingProxyType(
    {11: ApproachStage.FACE, 12: ApproachStage.CHECK, 13: ApproachStage.JUDGE}
)
_POINTINGS = MappingProxyType(
    {
        2: PointingStage.POINT,
        3: PointingStage.ANSWER,
        4: PointingStage.PROPOSED,
        5: PointingStage.AGAIN,
    }
)
_STAGES: Mapping[str, Mapping[int, str]] = MappingProxyType(
    {
        "ask": {1: AskStage.THOUGHT, 2: AskStage.AGAIN},
        "follow": {-1: FollowStage.SHUT, 1: FollowStage.ROUND},
        "look": {1: LookStage.GAZED, 2: LookStage.ASKED},
    }
)
"""The numbers of schema 1; any other stands for a beginning."""


_REMEMBERED_NOTHING = frozenset({"patrol", "stand_at"})
"""Kinds that remember something since schema 2 alone."""


def read_mission(record: str) -> Mission:
    """Return a goal from its record.

    Raises:
        ValidationError: no program of ours wrote it.
    """
    try:
        return Mission.model_validate_json(record)
    except ValidationError as wrong:
        try:
            former = _FormerMission.model_validate_json(record)
        except ValidationError:
            raise wrong from None
    kept = former.model_dump(exclude={"notes", "skill_state"})
    step = former.current_step
    state = _read_notes(step.kind, former.notes) if step is not None else None
    return Mission.model_validate({**kept, "skill_state": state})


def _read_notes(kind: str, notes: _Notes) -> dict[str, Any] | None:
    """Return the fields of a skill's state; None where it remembered nothing yet, or never does."""
    variant = STATES.get(kind)
    if variant is None or notes == _Notes():
        return None
    if kind in _REMEMBERED_NOTHING:
        return {"kind": kind}
    same = variant.model_fields.keys() & type(notes).model_fields.keys() - {"stage"}
    state = {"kind": kind, **{name: getattr(notes, name) for name in same}}
    match kind:
        case "ask" | "look":
            state |= _read_stage(kind, notes)
        case "follow":  # where the robot stood when the way was shut, and how often it was
            state |= _read_stage(kind, notes)
            state |= {"shut_at": notes.here, "shut_ways": notes.stand}
        case "count":
            state["out_of_metres"] = notes.broke
        case "find":
            state |= {"out_of_metres": notes.broke, **_read_aim(notes)}
        case "go_to_object":
            state |= {"out_of_metres": notes.broke, **_read_object_stage(notes)}
        case "go_to_point":
            state |= {"reached": notes.stage == 1, **_read_approach(notes)}
    return state


def _read_stage(kind: str, notes: _Notes) -> dict[str, str]:
    stages = _STAGES[kind]
    return {"stage": stages[notes.stage]} if notes.stage in stages else {}


def _read_object_stage(notes: _Notes) -> dict[str, str]:
    """Read the number as of an approach, a second look, or a point that is agreed on."""
    if notes.at is not None:
        return _read_approach(notes)
    if notes.aim is not None:
        return _read_aim(notes)
    return {"pointing": _POINTINGS[notes.stage]} if notes.stage in _POINTINGS else {}


def _read_aim(notes: _Notes) -> dict[str, str]:
    return {"aim_stage": _AIMS.get(notes.stage, AimStage.CHOSEN)}


def _read_approach(notes: _Notes) -> dict[str, str]:
    return {"approach": _APPROACHES.get(notes.stage, ApproachStage.DRIVE)}
