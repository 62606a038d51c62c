"""Ask the planner how far a robot has come that is starting. Decides nothing."""

from __future__ import annotations

from enum import Enum, auto
from typing import TYPE_CHECKING

from pons.http import PlannerDown, PlannerProblem, call

if TYPE_CHECKING:
    from pons.settings import LaunchSettings

_LACKS_PLACE_ALONE = "waiting for: localization"
TIMEOUT_S = 1.0


class Readiness(Enum):
    """Name how far a robot has come."""

    WAITING = auto()
    """Something does not answer yet."""
    SEARCHING = auto()
    """All processes answer; the robot does not know where it is, and stands still."""
    READY = auto()


def ask_readiness(settings: LaunchSettings, *, set_up: bool = False) -> Readiness:
    """Return how far the robot is; in set-up, which drives nowhere, any answer will do."""
    try:
        call(settings, "GET", "/healthz" if set_up else "/readyz", timeout_s=TIMEOUT_S)
    except PlannerProblem as problem:
        if problem.detail == _LACKS_PLACE_ALONE and _searches(settings):
            return Readiness.SEARCHING
        return Readiness.WAITING
    except PlannerDown:
        return Readiness.WAITING
    return Readiness.READY


def _searches(settings: LaunchSettings) -> bool:
    """Return whether localization itself says so; one that is silent or hangs is not waited for."""
    try:
        answer = call(settings, "GET", "/v1/localization", timeout_s=TIMEOUT_S)
    except (PlannerProblem, PlannerDown):
        return False
    said = answer.get("localizer")
    return isinstance(said, dict) and said.get("state") in {"searching", "lost"}
