"""Think: the brain's interface, the brains that ship, and the stop lane that asks none of them.

The door opens each name on first use, so that `from planner.language.stop import is_stop` stays
free of pydantic: a stop must not wait for an import.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planner.brain.brain_status import Mind, mind_of
    from planner.brain.errors import BadPlan, BrainConfigError, BrainDown, OutOfBudget
    from planner.brain.fallback import FallbackBrain
    from planner.brain.interface import Brain, Observation, ThinkRequest, ThinkResult
    from planner.brain.offline_brain import OfflineBrain
    from planner.brain.scripted import ScriptedBrain
    from planner.brain.streamed_draft import Draft, Hear

_DOORS = {
    "Brain": "interface",
    "BrainDown": "errors",
    "Draft": "streamed_draft",
    "FallbackBrain": "fallback",
    "Hear": "streamed_draft",
    "Mind": "brain_status",
    "BrainConfigError": "errors",
    "Observation": "interface",
    "OfflineBrain": "offline_brain",
    "OutOfBudget": "errors",
    "BadPlan": "errors",
    "ScriptedBrain": "scripted",
    "ThinkRequest": "interface",
    "ThinkResult": "interface",
    "mind_of": "brain_status",
}

__all__ = [
    "BadPlan",
    "Brain",
    "BrainConfigError",
    "BrainDown",
    "Draft",
    "FallbackBrain",
    "Hear",
    "Mind",
    "Observation",
    "OfflineBrain",
    "OutOfBudget",
    "ScriptedBrain",
    "ThinkRequest",
    "ThinkResult",
    "mind_of",
]


def __getattr__(name: str) -> object:
    if name not in _DOORS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_DOORS[name]}"), name)
