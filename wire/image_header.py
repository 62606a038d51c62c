"""Read a picture's size from its first bytes, before anything is unpacked. JPEG and PNG alone.

A picture of 50 000 x 50 000 is a few bytes as JPEG and gigabytes in memory, so its own header is
asked first. Sources: ITU-T T.81 annex B (markers), PNG specification (IHDR).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from wire.png import SIGNATURE, chunks_fit

PNG_HEAD_BYTES = 33
PNG_CHANNELS = {0: 1, 2: 3, 3: 3, 4: 2, 6: 4}
"""By colour type; a palette unpacks to three."""
PALETTE, PALETTE_BITS = 3, 8
"""A palette's colours have eight bits a channel, however few its pixels take to choose one."""
START, END, SCAN = 0xD8, 0xD9, 0xDA
FRAMES = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
"""Markers of a frame's header; the three others are tables and an extension."""
ALONE = frozenset({0x01, *range(0xD0, 0xD8)})
"""Markers without a length."""


@dataclass(frozen=True, slots=True)
class PictureHeader:
    """Hold a picture's statements about itself."""

    kind: Literal["jpeg", "png"]
    width: int
    height: int
    channels: int
    bits: int
    """Per channel."""
    whole: bool
    """Its end is there, and nothing within speaks of more than came."""


def read_header(data: bytes) -> PictureHeader | None:
    """Return a picture's header; None where these bytes begin no JPEG and no PNG."""
    if data.startswith(SIGNATURE):
        return _png(data)
    if data.startswith(b"\xff\xd8\xff"):
        return _jpeg(data)
    return None


def _png(data: bytes) -> PictureHeader | None:
    if len(data) < PNG_HEAD_BYTES or data[12:16] != b"IHDR":
        return None
    width, height = int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")
    channels = PNG_CHANNELS.get(data[25])
    if channels is None:
        return None
    bits = PALETTE_BITS if data[25] == PALETTE else data[24]
    return PictureHeader("png", width, height, channels, bits, chunks_fit(data))


def _jpeg(data: bytes) -> PictureHeader | None:
    """Walk the segments to the first scan; the frame's header lies before it."""
    at, frame = 2, None
    while at + 4 <= len(data):
        if data[at] != 0xFF:
            return None
        marker = data[at + 1]
        if marker == 0xFF:  # fill bytes
            at += 1
            continue
        if marker in ALONE:
            at += 2
            continue
        if marker in (START, END):
            return None
        length = int.from_bytes(data[at + 2 : at + 4], "big")
        if length < 2:
            return None
        if marker in FRAMES and len(data) >= at + 10:
            frame = data[at + 4 : at + 10]
        if marker == SCAN:
            return _read_frame(frame, whole=data.rfind(b"\xff\xd9", at) > 0)
        at += 2 + length
    return _read_frame(frame, whole=False)


def _read_frame(frame: bytes | None, *, whole: bool) -> PictureHeader | None:
    if frame is None:
        return None
    height, width = int.from_bytes(frame[1:3], "big"), int.from_bytes(frame[3:5], "big")
    return PictureHeader("jpeg", width, height, frame[5], frame[0], whole)
