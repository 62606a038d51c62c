"""Make the smallest JPEGs that have a head: what is looked at here is bytes, not pixels."""

from __future__ import annotations

from planner.brain.image_questions import PosedPicture


def jpeg(width: int = 320, height: int = 240, padding: int = 0) -> bytes:
    """Return a JPEG of that size with an APP0 segment before its frame, and nothing drawn in it."""
    size = height.to_bytes(2, "big") + width.to_bytes(2, "big")
    frame = b"\xff\xc0\x00\x0b\x08" + size + b"\x01\x01\x11\x00"
    scan = b"\xff\xda\x00\x08\x01\x01\x00\x00\x3f\x00"
    app0 = b"\xff\xe0\x00\x10JFIF\x00\x01\x01\x00\x00\x01\x00\x01\x00\x00"
    return b"\xff\xd8" + app0 + frame + scan + b"\x00" * padding + b"\xff\xd9"


def picture(width: int = 320, height: int = 240, padding: int = 0) -> PosedPicture:
    """Return such a picture."""
    return PosedPicture(jpeg(width, height, padding), width, height, seq=7)
