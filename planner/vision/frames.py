"""Own the frames between planner and vision process: lengths, JSON, picture bytes behind it. Pure.

JSON and not pickle: what is read here is checked for shape, and nothing that arrives can run.
"""

from __future__ import annotations

import json
from dataclasses import asdict
from struct import Struct
from typing import Any

from planner.vision.records import Detection
from planner.vision.result import About, LookResult

HEADER = Struct(">II")
MAX_HEAD_BYTES = 1_000_000
MAX_BODY_BYTES = 100_000_000
"""Colour and depth as the wire lets them through are a tenth."""


def pack(head: dict[str, Any], *bodies: bytes) -> bytes:
    """Return one frame. Raises ValueError for a number that is not finite."""
    text = json.dumps(head, separators=(",", ":"), allow_nan=False).encode()
    return b"".join((HEADER.pack(len(text), sum(map(len, bodies))), text, *bodies))


def lengths(header: bytes) -> tuple[int, int]:
    """Return the lengths of JSON and bytes.

    Raises:
        ValueError: no frame of ours is so long.
    """
    head, body = HEADER.unpack(header)
    if head <= MAX_HEAD_BYTES and body <= MAX_BODY_BYTES:
        return head, body
    raise ValueError(f"a frame of {head} + {body} bytes")


def unpack(text: bytes) -> dict[str, Any]:
    """Return a frame's JSON. Raises ValueError where it is no object."""
    content = json.loads(text)
    if isinstance(content, dict):
        return content
    raise ValueError(f"expected a JSON object, got {type(content).__name__}")


def look_head(result: LookResult) -> dict[str, Any]:
    """Return a result as JSON can hold it."""
    return asdict(result)


def read_look(head: dict[str, Any]) -> LookResult:
    """Return the result that :func:`look_head` wrote. Raises KeyError, TypeError or ValueError."""
    skipped, depth_lost = head["skipped"], head["depth_lost"]
    return LookResult(
        detections=tuple(map(_detection, head["detections"])),
        width=int(head["width"]),
        height=int(head["height"]),
        took_s=float(head["took_s"]),
        skipped=None if skipped is None else str(skipped),
        depth_lost=None if depth_lost is None else str(depth_lost),
    )


def _detection(item: dict[str, Any]) -> Detection:
    left, top, right, bottom = (float(side) for side in item["box"])
    return Detection(**{**item, "box": (left, top, right, bottom)})


def read_about(head: dict[str, Any] | None) -> About | None:
    """Return what runs; None where no model does. Raises KeyError or TypeError."""
    return None if head is None else About(**{**head, "classes": tuple(head["classes"])})
