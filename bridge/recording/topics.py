"""Name the topics of a recording and their schemas.

``/pons/*`` is what replay and `pons why` live on: JSON as the bridge wrote it, bit for bit. The
others repeat some of it in Foxglove's well-known schemas, so that any MCAP viewer draws them.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from bridge.recording import pipe_frames, protobuf

if TYPE_CHECKING:
    from collections.abc import Mapping

SCAN, TRANSFORMS, POSE, PLAN, LOG = "/scan", "/tf", "/pose", "/plan", "/log"

OF_KIND = {
    pipe_frames.BOOT: "/pons/boot",
    pipe_frames.STATE: "/pons/state",
    pipe_frames.INBOX: "/pons/inbox",
    pipe_frames.COMMAND: "/pons/command",
    pipe_frames.STATUS: "/pons/status",
    pipe_frames.ODOMETRY: "/pons/odometry",
    pipe_frames.EVENT: "/pons/event",
    pipe_frames.DECISION: "/pons/decision",
}


@dataclass(frozen=True, slots=True)
class RecordedTopic:
    """Hold the schema and encoding of one topic."""

    schema: str
    schema_encoding: str
    schema_data: bytes
    encoding: str


def _object(**properties: Any) -> dict[str, Any]:
    return {"type": "object", "properties": properties, "required": list(properties)}


def _numbers(names: str) -> dict[str, Any]:
    return _object(**{name: {"type": "number"} for name in names})


_TEXT, _INTEGER = {"type": "string"}, {"type": "integer"}
_TIME = _object(sec=_INTEGER, nsec=_INTEGER) | {"title": "time"}
_POSE = _object(position=_numbers("xyz"), orientation=_numbers("xyzw"))
WELL_KNOWN: dict[str, tuple[str, dict[str, Any]]] = {
    TRANSFORMS: (
        "foxglove.FrameTransform",
        _object(timestamp=_TIME, parent_frame_id=_TEXT, child_frame_id=_TEXT,
                translation=_numbers("xyz"), rotation=_numbers("xyzw")),
    ),
    POSE: ("foxglove.PoseInFrame", _object(timestamp=_TIME, frame_id=_TEXT, pose=_POSE)),
    PLAN: (
        "foxglove.PosesInFrame",
        _object(timestamp=_TIME, frame_id=_TEXT, poses={"type": "array", "items": _POSE}),
    ),
    LOG: (
        "foxglove.Log",
        _object(timestamp=_TIME, level=_INTEGER, message=_TEXT, name=_TEXT, file=_TEXT,
                line=_INTEGER),
    ),
}  # fmt: skip
"""The fields that we write, in the JSON form of https://docs.foxglove.dev/docs/sdk/schemas."""


def topics(ours: Mapping[str, Mapping[str, Any]]) -> dict[str, RecordedTopic]:
    """Return all topics, told the schema names and JSON Schemas of our own."""
    made = {
        name: _json(str(told["name"]), told["schema"])
        for name, told in ours.items()
        if name in OF_KIND.values()
    }
    made |= {name: _json(*known) for name, known in WELL_KNOWN.items()}
    made[SCAN] = RecordedTopic("foxglove.LaserScan", "protobuf", protobuf.SCAN_SCHEMA, "protobuf")
    return made


def _json(name: str, schema: Mapping[str, Any]) -> RecordedTopic:
    return RecordedTopic(name, "jsonschema", json.dumps(schema).encode(), "json")
