"""Own the frames between planner and voice process: a length, JSON, and samples behind it. Pure."""

from __future__ import annotations

import json
import struct
from typing import Any

HEADER = struct.Struct(">II")
MAX_HEAD_BYTES = 1_000_000


def pack(head: dict[str, Any], body: bytes = b"") -> bytes:
    """Return one frame."""
    text = json.dumps(head, ensure_ascii=False).encode()
    return HEADER.pack(len(text), len(body)) + text + body


def lengths(header: bytes) -> tuple[int, int]:
    """Return the lengths of JSON and samples.

    Raises:
        ValueError: no frame of ours is so long.
    """
    head, body = HEADER.unpack(header)
    if head > MAX_HEAD_BYTES or body > 4_000_000:
        raise ValueError(f"a frame of {head} + {body} bytes")
    return head, body


def unpack(text: bytes) -> dict[str, Any]:
    """Return a frame's JSON.

    Raises:
        ValueError: it is no JSON object.
    """
    content = json.loads(text)
    if not isinstance(content, dict):
        raise ValueError("a frame that is no object")
    return content
