"""Own the owner's settings about driving: a speed below the robot's own.

Data only. It can only lower: the bridge's limits of robot.toml hold whatever stands here.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class LimitSettings(BaseModel):
    """Bound what the planner asks the bridge for."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    max_speed_mps: Annotated[float, Field(ge=0.05, le=2.0)] | None = None
    """Of routes and of a hand at the stick; None: robot.toml's alone."""

    def lower_speed(self, robot_mps: float) -> float:
        """Return the speed that the planner keeps to, where the robot's own is this."""
        return robot_mps if self.max_speed_mps is None else min(self.max_speed_mps, robot_mps)
