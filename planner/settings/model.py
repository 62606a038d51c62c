"""Own the owner's settings about the model: where it is, how to ask it, and with which key.

Data only. A key never shows: not in a repr, not in a dump, not in an error.
"""

from __future__ import annotations

import json
from typing import Annotated, Any

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    SecretStr,
    StringConstraints,
    field_validator,
    model_validator,
)

from planner.settings.presets import PRESETS, JsonMode, Preset, PresetName, known_as

MAX_EXTRA_BYTES = 8_000
MAX_EXTRA_DEPTH = 8
OWN_FIELDS = frozenset(
    {
        *("model", "messages", "stream", "stream_options", "response_format", "n"),
        *("tools", "tool_choice", "functions", "function_call", "parallel_tool_calls"),
        *("temperature", "max_tokens", "max_completion_tokens"),
    }
)
"""Fields of a body that Pons writes itself; `extra_body` may not."""


class ModelSettings(BaseModel):
    """Say which model plans, and within which bounds it is asked."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    preset: PresetName | None = None
    """A server known by name; fills in ``url`` and ``max_tokens`` where they are not set."""
    url: Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=2000)]
    """The base of an OpenAI-compatible API, for example ``http://127.0.0.1:11434/v1``."""
    name: Annotated[str, StringConstraints(strip_whitespace=True, min_length=1, max_length=200)]
    key: SecretStr | None = None
    """Sent to the host of ``url`` and nowhere else."""
    timeout_s: float = Field(default=20.0, ge=0.5, le=120.0)
    """For one goal in all: waiting for a turn, every try, the repair turn."""
    load_timeout_s: float = Field(default=180.0, ge=0.0, le=600.0)
    """How long a server on this machine or in its network that has not said a word for a minute may
    take to load its model, before ``timeout_s`` begins; 0: loading counts as silence."""
    warm_up: bool | None = None
    """Have the model loaded when the planner starts, by one call of one token; None: where a preset
    names a server that loads it on demand, on this machine."""
    connect_timeout_s: float = Field(default=3.0, ge=0.1, le=30.0)
    temperature: float | None = Field(default=0.0, ge=0.0, le=2.0)
    """None: the server's own."""
    max_tokens: int = Field(default=1000, ge=100, le=100_000)
    mode: JsonMode | None = None
    """None: found out at the first call and remembered."""
    stream: bool = True
    """Ask for the plan while it is written, so that it shows early."""
    thinking: bool = False
    """Let the model think before it writes: better plans for hard orders, seconds later."""
    extra_body: dict[str, Any] = Field(default_factory=dict, repr=False)
    """Fields for the server beside those that Pons writes, as they are."""
    parallel: int = Field(default=2, ge=1, le=16)
    """Goals that may be thought about at the same time."""
    rest_s: float = Field(default=20.0, ge=0.5, le=300.0)
    """How long a model that failed three times in a row is not asked; doubles up to 300 s."""
    allow_offhost: bool = False
    """Let people's sentences leave this machine: needed for every host but loopback."""

    keep_replies: int = Field(default=0, ge=0, le=200, strict=True)
    """Goals of which what the model wrote is kept in memory and can be shown; 0: none."""

    pictures: bool | None = None
    """Whether the model takes pictures; None: found out at the first one and remembered."""
    allow_pictures_offhost: bool = False
    """Let the camera's pictures leave this machine, too: the second yes."""

    @model_validator(mode="before")
    @classmethod
    def _with_preset(cls, given: Any) -> Any:
        """Fill in the preset's fields; an unknown name is refused by the field itself."""
        preset = known_as(given.get("preset")) if isinstance(given, dict) else None
        if preset is None:
            return given
        return {"url": preset.url, "max_tokens": preset.max_tokens, **given}

    @field_validator("extra_body")
    @classmethod
    def _check_extra(cls, extra: dict[str, Any]) -> dict[str, Any]:
        own = sorted(extra.keys() & OWN_FIELDS)
        if own:
            raise ValueError(f"Pons writes {', '.join(own)} itself")
        try:
            size = len(json.dumps(extra, allow_nan=False).encode())
        except (TypeError, ValueError, RecursionError):
            raise ValueError("must be what JSON can hold: no dates, no NaN") from None
        if size > MAX_EXTRA_BYTES or _depth(extra) > MAX_EXTRA_DEPTH:
            most = f"{MAX_EXTRA_BYTES} bytes, {MAX_EXTRA_DEPTH} levels"
            raise ValueError(f"is too large or too deep; at most {most}")
        return extra

    @property
    def known_preset(self) -> Preset | None:
        """Return the server's preset, where one is named."""
        return PRESETS[self.preset] if self.preset is not None else None


def _depth(value: object) -> int:
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    return 1 + max(map(_depth, inner), default=0)
