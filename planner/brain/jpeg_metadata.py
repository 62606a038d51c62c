"""Read the head of a JPEG: its size and its segments; take out what tells more than the picture.

Nothing is decoded here. ITU-T T.81, annex B: markers of two bytes, most with a length; a frame's
header holds the size.
"""

from __future__ import annotations

from collections.abc import Iterator

START = b"\xff\xd8\xff"
MAX_SEGMENTS = 200
SCAN = 0xDA
_FRAMES = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
"""SOF0 to SOF15; the three left out hold tables."""
_BARE = frozenset({0x01, *range(0xD0, 0xD8)})
"""TEM and RSTn have no length."""
_NOTES = (frozenset(range(0xE1, 0xF0)) - {0xE2, 0xEE}) | {0xFE}
"""APPn and COM: place, time, the camera's name. What JFIF, ICC and Adobe write is about colours."""


def jpeg_size(data: bytes) -> tuple[int, int] | None:
    """Return width and height, or None where this is no JPEG or ends too early."""
    for marker, body in segments(data):
        if marker in _FRAMES:  # precision, height, width
            whole = len(body) >= 6
            height, width = int.from_bytes(body[1:3], "big"), int.from_bytes(body[3:5], "big")
            return (width, height) if whole else None
    return None


def without_notes(data: bytes) -> bytes:
    """Return a JPEG without comments and the camera's notes of place, time and make."""
    kept, at = bytearray(), 0
    for marker, begin, end in _spans(data):
        if marker in _NOTES:
            kept += data[at:begin]
            at = end
    return bytes(kept + data[at:])


def segments(data: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield the marker and the body of each segment before the picture's own data."""
    return ((marker, data[begin + 4 : end]) for marker, begin, end in _spans(data))


def _spans(data: bytes) -> Iterator[tuple[int, int, int]]:
    """Yield the marker of each segment, where it begins and where it ends."""
    at = 2 if data.startswith(START) else len(data)
    for _ in range(MAX_SEGMENTS):
        if at + 4 > len(data) or data[at] != 0xFF or data[at + 1] == SCAN:
            return
        marker = data[at + 1]
        if marker == 0xFF:  # fill byte
            at += 1
        elif marker in _BARE:
            at += 2
        else:
            end = at + 2 + max(2, int.from_bytes(data[at + 2 : at + 4], "big"))
            yield marker, at, end
            at = end
