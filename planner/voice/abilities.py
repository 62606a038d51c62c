"""Describe what a robot hears and how it speaks, for pages and programs. Data only."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict

from planner.plan import Language


class VoiceAbilities(BaseModel):
    """Show which languages are heard and by what, and whether the robot itself speaks."""

    model_config = ConfigDict(frozen=True)

    languages: tuple[Language, ...] = (Language.EN,)
    """That spoken orders may be in."""
    recogniser: Literal["grammar", "server", "sherpa"] = "grammar"
    host: str | None = None
    """Where recordings are sent; None: they stay on this machine."""
    speaks: Literal["none", "espeak", "server"] = "none"
    """What the robot's own voice is."""
    quiet: bool = False
    """Nothing is said aloud at this hour."""
    trouble: str | None = None
    """Stable code of why the newest sentence was not heard."""
