"""Own the owner's settings about goals: how far one may go by itself before a person is asked.

Data only; ``planner.mission.Rules`` is made of it, with the same names and meanings.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field


class MissionSettings(BaseModel):
    """Bound one goal's own deeds."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    replans: Annotated[int, Field(ge=0, le=10)] = 2
    """New plans for a goal whose step failed; then it fails."""
    decides: Annotated[int, Field(ge=0, le=20)] = 3
    """Times that a goal may think again because its plan says so."""
    answer_s: Annotated[float, Field(ge=5.0, le=86_400.0)] = 600.0
    """How long an answer to a question of any kind is waited for, standing [s]."""
