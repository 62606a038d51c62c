"""Own the owner's settings about standing orders: time zone, quiet hours, who is told.

Data only. What is told off this machine goes to the URL that stands here and to no other.
"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal
from urllib.parse import urlsplit

from pydantic import BaseModel, ConfigDict, Field, field_validator

from planner.plan import QuietHours

Told = Literal["reminder", "missed", "failed", "done", "asks"]


class NotifySettings(BaseModel):
    """Say to which address the owner is told, in which form and of what."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    url: Annotated[str, Field(min_length=1, max_length=2000)] = Field(repr=False)
    """Of a webhook, or of an ntfy topic. Its path may be a secret: it is never logged."""
    form: Literal["webhook", "ntfy"] = "webhook"
    token_file: Path | None = None
    """Holds a token sent as ``Authorization: Bearer``; relative to the home folder."""
    words: bool = True
    """Tell the order's words and its outcome; without, the codes alone."""
    tells: tuple[Told, ...] = ("reminder", "missed", "failed", "done", "asks")

    @field_validator("url")
    @classmethod
    def _is_web(cls, url: str) -> str:
        try:
            parts = urlsplit(url)
            good = parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
            named = parts.username is not None
        except ValueError:
            good = named = False
        if not good or named or not url.isprintable() or " " in url:
            raise ValueError("expected http:// or https:// with a host, without user and password")
        return url


class OrderSettings(BaseModel):
    """Hold the owner's settings of standing orders."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, hide_input_in_errors=True
    )

    timezone: Annotated[str, Field(min_length=1, max_length=64)] | None = None
    """A name of the IANA list, as ``Europe/Berlin``; None: the system's."""
    quiet: QuietHours | None = None
    """``22:00-07:00``: orders that come again rest in between."""
    notify: NotifySettings | None = None

    @field_validator("quiet", mode="before")
    @classmethod
    def _read_quiet(cls, given: object) -> object:
        return QuietHours.read(given) if isinstance(given, str) else given
