"""Own what the owner may set about the model: where it is, how to ask it, and with which key.

Data only. A key never shows: not in a repr, not in a dump, not in an error.
"""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, SecretStr, StringConstraints


class Mode(StrEnum):
    """The ways to ask an endpoint for JSON, strictest first: the rungs of the ladder."""

    JSON_SCHEMA = "json_schema"
    PROMPT = "prompt"


class ModelSettings(BaseModel):
    """Say which model plans, and within which bounds it is asked."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    url: Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=2000)]
    """The base of an OpenAI-compatible API, for example ``http://127.0.0.1:11434/v1``."""
    name: Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=200)]
    key: SecretStr | None = None
    """Sent to the host of ``url`` and nowhere else."""
    timeout_s: float = Field(default=20.0, ge=0.5, le=120.0)
    """For one goal in all: waiting for a turn, every try, the repair turn."""
    connect_timeout_s: float = Field(default=3.0, ge=0.1, le=30.0)
    temperature: float | None = Field(default=0.0, ge=0.0, le=2.0)
    """None: the server's own."""
    max_tokens: int = Field(default=1000, ge=100, le=100_000)
    mode: Mode | None = None
    """None: found out at the first call and remembered."""
    parallel: int = Field(default=2, ge=1, le=16)
    """Goals that may be thought about at the same time."""
    rest_s: float = Field(default=20.0, ge=0.5, le=300.0)
    """How long a model that failed three times in a row is not asked; doubles up to 300 s."""
    allow_offhost: bool = False
    """Let people's sentences leave this machine: needed for every host but loopback."""
