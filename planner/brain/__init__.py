"""Think: what a brain is, the brains that ship, and the stop lane that asks none of them.

The door opens each name on first use, so that `from planner.language.stop import is_stop` stays
free of pydantic: a stop must not wait for an import.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.brain.draft import Draft, Hear
    from planner.brain.errors import BrainDown, Misconfigured, OutOfBudget, PlanRejected
    from planner.brain.fallback import FallbackBrain
    from planner.brain.mind import Mind, mind_of
    from planner.brain.offline import OfflineBrain
    from planner.brain.protocol import Brain, Observation, ThinkRequest, Thought
    from planner.brain.scripted import ScriptedBrain

_DOORS = {
    "Brain": "protocol",
    "BrainDown": "errors",
    "Draft": "draft",
    "FallbackBrain": "fallback",
    "Hear": "draft",
    "Mind": "mind",
    "Misconfigured": "errors",
    "Observation": "protocol",
    "OfflineBrain": "offline",
    "OutOfBudget": "errors",
    "PlanRejected": "errors",
    "ScriptedBrain": "scripted",
    "ThinkRequest": "protocol",
    "Thought": "protocol",
    "mind_of": "mind",
}

__all__ = [
    "Brain",
    "BrainDown",
    "Draft",
    "FallbackBrain",
    "Hear",
    "Mind",
    "Misconfigured",
    "Observation",
    "OfflineBrain",
    "OutOfBudget",
    "PlanRejected",
    "ScriptedBrain",
    "ThinkRequest",
    "Thought",
    "mind_of",
]


def __getattr__(name: str) -> object:
    if name not in _DOORS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_DOORS[name]}"), name)
