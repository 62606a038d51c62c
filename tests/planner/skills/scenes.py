"""Make scenes for skills."""

from __future__ import annotations

from typing import Any

from planner.plan import Bilingual, StepRecord
from planner.skills import Scene, begin_state
from tests.planner.mission.fakes import FACTS
from wire import IDENTITY


def scene(kind: str, *, step: dict[str, Any] | None = None, **more: Any) -> Scene[Any]:
    """Return a scene at the beginning of a step, with changes."""
    fields: dict[str, Any] = {
        "facts": FACTS, "pose": IDENTITY, "began": IDENTITY, "done": 0.0, "part": 0,
        "accepted": IDENTITY, "state": begin_state(kind),
    }  # fmt: skip
    record = StepRecord(kind=kind, **(step or {}))
    return Scene(step=record, **{**fields, **more})


def said_of(act: Any) -> Bilingual:
    """Return what an act says, which it must."""
    said: Bilingual | None = act.said
    assert said is not None
    return said
