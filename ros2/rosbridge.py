"""Write and read rosbridge's JSON operations (ROSBRIDGE_PROTOCOL 2.1). Pure.

Not-a-number and infinities come as null, or as the words that Python's own JSON writes, by the
server's version; both are read here, and judged by who reads the field.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

MOST_BYTES = 1 << 20
"""A scan of 4 000 beams has 80 kB; a server that sends more sends something else."""
TYPE_SERVICE = "/rosapi/topic_type"

Message = dict[str, Any]


@dataclass(frozen=True, slots=True)
class TopicMessage:
    """Hold what came on a topic."""

    topic: str
    message: Message


@dataclass(frozen=True, slots=True)
class TopicType:
    """Hold the graph's answer about one topic: its type, empty where nobody has it."""

    topic: str
    kind: str


@dataclass(frozen=True, slots=True)
class NoAnswer:
    """Hold why the graph could not be asked about a topic."""

    topic: str
    reason: str


@dataclass(frozen=True, slots=True)
class ServerWords:
    """Hold what the server says about an operation of ours."""

    level: str
    text: str


Operation = TopicMessage | TopicType | NoAnswer | ServerWords | None
"""None: of no use to us, or of no rosbridge."""


def advertise(topic: str, kind: str) -> str:
    """Return the operation that says what we will publish."""
    return _write(op="advertise", topic=topic, type=kind)


def unadvertise(topic: str) -> str:
    """Return the operation that says that we publish there no more."""
    return _write(op="unadvertise", topic=topic)


def publish(topic: str, message: Message) -> str:
    """Return the operation that publishes one message."""
    return _write(op="publish", topic=topic, msg=message)


def subscribe(topic: str, kind: str, every_ms: int = 0) -> str:
    """Return the operation that asks for a topic, at most once in ``every_ms``."""
    return _write(op="subscribe", topic=topic, type=kind, throttle_rate=every_ms, queue_length=1)


def ask_type(topic: str) -> str:
    """Return the operation that asks the graph for a topic's type."""
    args = {"topic": topic}
    return _write(op="call_service", id=f"type:{topic}", service=TYPE_SERVICE, args=args)


def read(frame: str | bytes) -> Operation:
    """Return what a frame of the server says."""
    try:
        raw = json.loads(frame)
    except (ValueError, RecursionError):
        return None
    if not isinstance(raw, dict):
        return None
    op = raw.get("op")
    if op == "publish" and isinstance(raw.get("topic"), str) and isinstance(raw.get("msg"), dict):
        return TopicMessage(raw["topic"], raw["msg"])
    if op == "service_response":
        return _read_answer(raw)
    if op == "status":
        return ServerWords(str(raw.get("level"))[:16], str(raw.get("msg"))[:200])
    return None


def plain_type(kind: str) -> str:
    """Return a type's name without the ``/msg/`` that some versions leave out."""
    return kind.replace("/msg/", "/")


def _read_answer(raw: Message) -> TopicType | NoAnswer | None:
    asked = raw.get("id")
    if not isinstance(asked, str) or not asked.startswith("type:"):
        return None
    topic, values = asked.removeprefix("type:"), raw.get("values")
    if raw.get("result") is not False and isinstance(values, dict):
        kind = values.get("type")
        if isinstance(kind, str):
            return TopicType(topic, kind)
    return NoAnswer(topic, str(values)[:200])


def _write(**members: object) -> str:
    return json.dumps(members, separators=(",", ":"), allow_nan=False)
