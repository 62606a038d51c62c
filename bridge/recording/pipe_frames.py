"""Define the frames from the loop to the writing process and the words back.

A frame is one letter, a length and so many bytes. A tick is ``TICK`` (its number and time), what it
was given, what came of it, and ``DECISION`` last: a tick without one was cut short and counts as
missing. ``BOOT`` and ``STATE`` begin a segment; a file begins at a segment.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

SCHEMAS = b"K"
"""JSON Schemas of the topics, by topic; once, first of all."""
TICK = b"T"
BOOT = b"B"
STATE = b"X"
RANGES = b"S"
"""The scan's ranges, little-endian doubles, +inf where nothing came back. Before ``INBOX``."""
INBOX = b"I"
COMMAND = b"C"
STATUS = b"U"
ODOMETRY = b"O"
EVENT = b"E"
DECISION = b"D"
_KINDS = frozenset(
    (SCHEMAS, TICK, BOOT, STATE, RANGES, INBOX, COMMAND, STATUS, ODOMETRY, EVENT, DECISION)
)

TICK_OF = struct.Struct("<Qd")
"""Number of the tick before the step, and its time on the host's monotonic clock [s]."""
_HEAD = struct.Struct("<cI")
MAX_BYTES = 8 << 20
"""A state with everything in it is 40 kB; a longer frame is no frame of ours."""

WRITING = b"W"
"""All that came is in a file."""
FULL = b"R"
"""Likewise, and the file is full: begin a segment."""
NEXT = b"N"
"""There is no file: begin a segment."""
FAILING = b"F"
"""Nothing can be written; why follows."""
WORD_MOST = 300


class BadFrame(Exception):
    """The stream is out of step; nothing that follows can be trusted."""


def frame(kind: bytes, payload: bytes) -> bytes:
    """Return one frame."""
    return _HEAD.pack(kind, len(payload)) + payload


class Splitter:
    """Cut a stream into frames, wherever its reads end."""

    def __init__(self) -> None:
        self._part = b""

    def feed(self, data: bytes) -> Iterator[tuple[bytes, bytes]]:
        """Yield kind and payload of each frame that is whole now.

        Raises:
            BadFrame: what came is no frame.
        """
        data = self._part + data if self._part else data
        at, end = 0, len(data)
        while end - at >= _HEAD.size:
            kind, length = _HEAD.unpack_from(data, at)
            if kind not in _KINDS or length > MAX_BYTES:
                self._part = b""
                raise BadFrame(f"kind {kind!r}, {length} bytes")
            if end - at - _HEAD.size < length:
                break
            start = at + _HEAD.size
            at = start + length
            yield kind, data[start:at]
        self._part = data[at:]


def word(kind: bytes, text: str = "") -> bytes:
    """Return one word for the loop, a line."""
    return kind + text.replace("\n", " ").encode()[:WORD_MOST] + b"\n"
