"""Write and read rosbridge's JSON operations (ROSBRIDGE_PROTOCOL 2.1). Pure.

Not-a-number and infinities come as null, or as the words that Python's own JSON writes, by the
server's version; both are read here, and judged by who reads the field.
"""

from __future__ import annotations

import json

from ros2.operations import (
    Advertise,
    Answer,
    AskType,
    Message,
    NoAnswer,
    Publish,
    Request,
    ServerWords,
    Subscribe,
    TopicMessage,
    TopicType,
)

TYPE_SERVICE = "/rosapi/topic_type"


def write(request: Request) -> str:
    """Return the operation of a request."""
    if isinstance(request, Publish):
        return _write(op="publish", topic=request.topic, msg=request.message)
    if isinstance(request, Advertise):
        return _write(op="advertise", topic=request.topic, type=request.kind)
    if isinstance(request, Subscribe):
        return _write(
            op="subscribe",
            topic=request.topic,
            type=request.kind,
            throttle_rate=request.every_ms,
            queue_length=1,
        )
    if isinstance(request, AskType):
        args = {"topic": request.topic}
        ident = f"type:{request.topic}"
        return _write(op="call_service", id=ident, service=TYPE_SERVICE, args=args)
    return _write(op="unadvertise", topic=request.topic)


def read(frame: str | bytes) -> Answer | None:
    """Return what a frame of the server says; None: of no use to us, or of no rosbridge."""
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
        return ServerWords(_text(raw.get("level"))[:16], _text(raw.get("msg"))[:200])
    return None


def _read_answer(raw: Message) -> TopicType | NoAnswer | None:
    asked = raw.get("id")
    if not isinstance(asked, str) or not asked.startswith("type:"):
        return None
    topic, values = asked.removeprefix("type:"), raw.get("values")
    if raw.get("result") is not False and isinstance(values, dict):
        kind = values.get("type")
        if isinstance(kind, str):
            return TopicType(topic, _text(kind))
    return NoAnswer(topic, _text(values)[:200])


def _text(value: object) -> str:
    """Return words that people are told; JSON can hold half of a letter, which no message may."""
    return str(value).encode("utf-8", "replace").decode()


def _write(**members: object) -> str:
    return json.dumps(members, separators=(",", ":"), allow_nan=False)
