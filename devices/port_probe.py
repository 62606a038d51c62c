"""Recognise what is behind a serial port by what it says: one probe a kind, beside its protocol.

A probe may listen, and may ask one question. A question is harmless: no kind of device that Pons
knows turns a wheel, changes a setting or forgets one because of it, whichever kind it was meant
for. tests/pons/robot holds every question against every firmware twin.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

LONGEST_QUESTION = 16
"""Bytes. Nothing that moves a wheel fits into so few where a line has a checksum."""


@dataclass(frozen=True, slots=True)
class PortAnswer:
    """Name the device that answers, and what robot.toml should say of it."""

    words: str
    """In English: model, firmware, what it measures of itself."""
    keys: Mapping[str, str | int] = field(default_factory=dict)
    """Beside ``kind`` and ``port``."""
    missing: Mapping[str, str] = field(default_factory=dict)
    """Keys that robot.toml needs and no device can tell, with where a person finds them."""


@dataclass(frozen=True, slots=True)
class PortProbe:
    """Tell one kind of device from all others at one speed of the line."""

    part: Literal["drive", "lidar"]
    """The part of robot.toml that it belongs to."""
    kind: str
    baud: int
    recognise: Callable[[bytes], PortAnswer | None]
    """Given all bytes heard at ``baud``; None where they are not this kind's."""
    question: bytes = b""
    """Empty: it speaks by itself. Else asked only where nothing speaks by itself."""

    def __post_init__(self) -> None:
        """Refuse a question that is too long to be harmless.

        Raises:
            ValueError: it is longer than ``LONGEST_QUESTION``.
        """
        if len(self.question) > LONGEST_QUESTION:
            raise ValueError(f"{self.kind}: a question of {len(self.question)} bytes")
