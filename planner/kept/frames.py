"""Own the frames between a process and its child: two lengths, JSON, bytes behind it. Pure.

JSON and not pickle: what is read here is checked for shape, and nothing that arrives can run.
"""

from __future__ import annotations

import json
from struct import Struct
from typing import Any

HEADER = Struct(">II")
MAX_HEAD_BYTES = 8_000_000
"""A route of 100 km at 0.1 m is half of this."""
MAX_BODY_BYTES = 100_000_000
"""Colour and depth as the wire lets them through are a tenth."""

Frame = tuple[dict[str, Any], bytes]


def pack(head: dict[str, Any], *bodies: bytes) -> bytes:
    """Return one frame. Raises ValueError for a number that is not finite."""
    text = json.dumps(head, separators=(",", ":"), allow_nan=False).encode()
    return b"".join((HEADER.pack(len(text), sum(map(len, bodies))), text, *bodies))


def lengths(header: bytes) -> tuple[int, int]:
    """Return the lengths of JSON and bytes.

    Raises:
        ValueError: no frame of ours is so long; the stream is not ours or is out of step.
    """
    head, body = HEADER.unpack(header)
    if head <= MAX_HEAD_BYTES and body <= MAX_BODY_BYTES:
        return head, body
    raise ValueError(
        f"a frame of {head} + {body} bytes; at most {MAX_HEAD_BYTES} + {MAX_BODY_BYTES}"
    )


def unpack(text: bytes) -> dict[str, Any]:
    """Return a frame's JSON. Raises ValueError where it is no object."""
    content = json.loads(text)
    if isinstance(content, dict):
        return content
    raise ValueError(f"expected a JSON object, got {type(content).__name__}")
