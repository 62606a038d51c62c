"""Own the owner's settings about standing orders: time zone, quiet hours, who is told.

Data only. What is told off this machine goes to the URL that stands here and to no other.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated, Literal
from urllib.parse import urlsplit

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

_CLOCK = re.compile(r"([01]\d|2[0-3]):([0-5]\d)")
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
    quiet: tuple[str, str] | None = None
    """From and to, as ``["22:00", "07:00"]``: orders that come again rest in between."""
    notify: NotifySettings | None = None

    @model_validator(mode="after")
    def _leaves_time(self) -> OrderSettings:
        if self.quiet is not None and self.quiet_min is None:
            raise ValueError('quiet: expected two different times as ["22:00", "07:00"]')
        return self

    @property
    def quiet_min(self) -> tuple[int, int] | None:
        """Return the quiet hours in minutes since midnight; None where there are none."""
        if self.quiet is None:
            return None
        found = [_CLOCK.fullmatch(each) for each in self.quiet]
        minutes = [int(m[1]) * 60 + int(m[2]) for m in found if m is not None]
        return (minutes[0], minutes[1]) if len(minutes) == 2 and minutes[0] != minutes[1] else None
