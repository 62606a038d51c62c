"""Bound the small values that messages are made of: names, counters, times, ranges."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

PROTOCOL = 5
"""Number of this wire. Unknown fields are refused, so any added field is a new number."""

STATUS_RING = 256
"""Statuses whose sending times the bridge remembers; an older ``seen`` is dropped."""

MAX_POINTS = 50
MAX_BEAMS = 2048
MAX_TTL_S = 2.0

_MAX_COUNT = 2**53 - 1  # exact in every JSON reader, JavaScript's included

Count = Annotated[int, Field(ge=0, le=_MAX_COUNT)]
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.:-]{0,63}$")]
"""An id that somebody minted: planner, mission, source, stop, boot."""
Epoch = Annotated[str, Field(pattern=r"^[A-Za-z0-9]{1,32}-[0-9]{1,15}$")]
"""Boot nonce and counter, minted by the bridge alone."""
Code = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,63}$")]
RowName = Annotated[str, Field(pattern=r"^[A-Z][A-Z0-9_]{0,31}$")]
Fingerprint = Annotated[str, Field(pattern=r"^[0-9a-f]{16}$")]
Text = Annotated[str, Field(max_length=400)]
DevicePath = Annotated[str, Field(pattern=r"^/.+$", max_length=255)]
"""Of a device on this machine. ``.{1,254}`` would be 1 MB of automaton in each process."""

Seconds = Annotated[float, Field(ge=0.0, le=1e9)]
"""A duration, or a time on the sender's monotonic clock."""
Ratio = Annotated[float, Field(ge=0.0, le=1.0)]
Length = Annotated[float, Field(ge=0.0, le=100_000.0)]
WheelAngle = Annotated[float, Field(ge=-1e9, le=1e9)]
WheelSpeed = Annotated[float, Field(ge=-1_000.0, le=1_000.0)]
