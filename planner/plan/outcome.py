"""Own the record of how a goal ended: a stable code, a sentence in both languages, and figures.

"Arrived" is what odometry and the bridge say; the figures here are theirs, never a model's.
"""

from __future__ import annotations

from pydantic import Field

from planner.plan.base import Bilingual, Frozen
from planner.plan.outcome_codes import Code


class Spot(Frozen):
    """Name where: a place or room of the site and, where known, the point in `map` [m, rad]."""

    place: str | None = None
    room: str | None = None
    x_m: float | None = None
    y_m: float | None = None
    yaw_rad: float | None = None


class Outcome(Frozen):
    """Tell how a goal ended, with the request, the result and the limits."""

    code: Code
    message: Bilingual
    asked: Spot | None = None
    reached: Spot | None = None
    metres: float | None = Field(default=None, ge=0.0)  # driven, by odometry
    seconds: float | None = Field(default=None, ge=0.0)  # from accepted to ended
    limited_by: tuple[str, ...] = ()  # the bridge's names for what held the speed down
