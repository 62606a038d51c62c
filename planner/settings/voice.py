"""Own the owner's settings about hearing and speaking: the recogniser, the voice, quiet hours.

Data only. Nothing set: English orders are heard by the built-in grammar, and the robot is mute.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, SecretStr, StringConstraints, field_validator

from planner.plan import QuietHours

Url = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=2000)]
Name = Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=200)]


class _SpokenTable(BaseModel):
    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )


class VoiceSettings(_SpokenTable):
    """Say which recogniser hears recordings beside the built-in grammar."""

    url: Url | None = None
    """The base of an OpenAI-compatible API with ``/audio/transcriptions``."""
    model: Name = "whisper-1"
    key: SecretStr | None = None
    """Sent to the host of ``url`` and nowhere else."""
    timeout_s: float = Field(default=8.0, ge=0.5, le=30.0)
    """For one recording; then the built-in grammar's word counts."""
    allow_offhost: bool = False
    """Let the sound of people's voices leave this machine."""
    folder: Path | None = None
    """Of a streaming sherpa-onnx model, relative to the home folder; in place of ``url``."""
    threads: int = Field(default=1, ge=1, le=8)
    """Of the processor, for the model in ``folder``."""


class SpeechSettings(_SpokenTable):
    """Say whether and how the robot itself speaks; the page's voices are the browser's."""

    engine: Literal["none", "espeak", "server"] = "none"
    url: Url | None = None
    """For ``server``: the base of an OpenAI-compatible API with ``/audio/speech``."""
    model: Name = "tts-1"
    voice: Name | None = None
    """For ``server``: the voice's name; None: ``alloy``."""
    voice_en: Name = "en-us"
    """For ``espeak``: what ``espeak-ng --voices`` calls it."""
    voice_zh: Name = "cmn"
    key: SecretStr | None = None
    timeout_s: float = Field(default=8.0, ge=0.5, le=30.0)
    """For the sound of one sentence; then it is left out."""
    allow_offhost: bool = False
    """Let what the robot says leave this machine."""
    player: Annotated[tuple[str, ...], Field(min_length=1, max_length=20)] = ("aplay", "-q", "-")
    """A program that plays a WAV from its input, with its arguments."""
    quiet: QuietHours | None = None
    """``22:00-07:00``: nothing is said aloud then, by the robot's own clock."""

    @field_validator("quiet", mode="before")
    @classmethod
    def _read_quiet(cls, given: object) -> object:
        return QuietHours.read(given) if isinstance(given, str) else given
