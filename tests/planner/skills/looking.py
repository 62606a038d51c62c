"""Ask a skill that looks what it does next, in a scene of a few things."""

from __future__ import annotations

from typing import Any

from planner.perception.snapshot import LookSnapshot, Sight, Thing
from planner.skills import Eyesight, act_of
from planner.skills.skill_state import SkillStateBase
from tests.planner.skills.scenes import scene
from wire import CameraConfig, Pose2

EYES = Eyesight(CameraConfig(), ("cup", "person", "chair"))
NOW_S = 100.0
HERE = Pose2(0.0, 0.0, 0.0)


def thing(**more: Any) -> Thing:
    fields: dict[str, Any] = {
        "id": "cup_1", "label": "cup", "color": "red", "x_m": 1.6, "y_m": 0.0, "z_m": 0.8,
        "sigma_m": 0.05, "confidence": 0.9, "seen_s": NOW_S - 0.5, "first_s": 0.0, "sightings": 5,
        "room": "hall",
    }  # fmt: skip
    return Thing(**{**fields, **more})


def sight(*things: Thing, blind: str | None = None) -> Sight:
    return Sight(LookSnapshot(1, NOW_S, HERE, 320, 240, ()), things, blind)


def looking(kind: str, *things: Thing, state: SkillStateBase | None = None, **more: Any) -> Any:
    step = {"object": "red cup"} | more.pop("step", {})
    fields: dict[str, Any] = {"eyes": EYES, "sight": sight(*things), "now_s": NOW_S}
    fields |= {"state": state} if state is not None else {}
    return act_of(scene(kind, step=step, pose=HERE, **(fields | more)))


def at(label: str, x_m: float, z_m: float, **more: Any) -> Thing:
    """Return a thing of no colour that stands ahead in the hall, well known."""
    named = {"id": f"{label}_{x_m}", "label": label, "color": None, "sigma_m": 0.03}
    return thing(x_m=x_m, z_m=z_m, **{**named, **more})
