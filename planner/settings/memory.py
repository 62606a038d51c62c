"""Own the owner's settings about memory: how long and how much is kept. Data only.

``planner.memory.MemoryLimits`` is made of it, with the same names and meanings.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

Days = Annotated[float, Field(ge=0.0, le=3650.0)]


class MemorySettings(BaseModel):
    """Bound what the robot remembers. Nothing is kept of a kind with 0 days."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    things_days: Days = 30.0
    """Things seen."""
    people_days: Days = 7.0
    """That somebody was somewhere, without name or face."""
    facts_days: Days = 365.0
    """What people told it."""
    most_sightings: Annotated[int, Field(ge=0, le=100_000)] = 10_000
    """The oldest go first."""
    most_facts: Annotated[int, Field(ge=0, le=10_000)] = 500
    """One more is refused."""
    most_pictures: Annotated[int, Field(ge=0, le=1000)] = 60
    """Of patrols; the oldest go first, and with 0 none is kept."""
    pictures_mb: Annotated[float, Field(ge=0.0, le=1000.0)] = 12.0
    """What they may have together."""
