"""Write requests and answers as JSON frames between the planner and its route process.

A frame is four bytes of length, big-endian, and that many bytes of JSON. JSON and not pickle: what
is read here is checked for shape, and nothing that arrives can run.
"""

from __future__ import annotations

import json
from dataclasses import asdict
from struct import Struct
from typing import Any

from planner.route.request import (
    RouteFailure,
    RouteLimits,
    RoutePoint,
    RouteRequest,
    RouteResult,
)
from wire.geometry import Pose2

HEADER = Struct(">I")
MAX_FRAME_BYTES = 8_000_000
"""A route of 100 km at 0.1 m is half of this."""


def pack(message: dict[str, Any]) -> bytes:
    """Return a message as one frame. Raises ValueError for a number that is not finite."""
    body = json.dumps(message, separators=(",", ":"), allow_nan=False).encode()
    return HEADER.pack(len(body)) + body


def body_length(header: bytes) -> int:
    """Return the length that a header announces.

    Raises:
        ValueError: it is over the limit; the stream is not ours or is out of step.
    """
    length = int(HEADER.unpack(header)[0])
    if length <= MAX_FRAME_BYTES:
        return length
    raise ValueError(f"a frame of {length} bytes; at most {MAX_FRAME_BYTES}")


def unpack(body: bytes) -> dict[str, Any]:
    """Return the message of a frame's body. Raises ValueError if it is no JSON object."""
    message = json.loads(body)
    if isinstance(message, dict):
        return message
    raise ValueError(f"expected a JSON object, got {type(message).__name__}")


def pack_request(number: int, request: RouteRequest) -> bytes:
    """Return a numbered request as a frame.

    Raises:
        RouteFailure: ``route_request_malformed`` for a number that is not finite.
    """
    try:
        return pack({"number": number, **asdict(request)})
    except (TypeError, ValueError) as error:
        raise RouteFailure("route_request_malformed", str(error)) from error


def read_request(message: dict[str, Any]) -> tuple[int, RouteRequest]:
    """Return the number and the request of a message."""
    start, goal = Pose2(**message["start"]), Pose2(**message["goal"])
    obstacles = tuple((float(x_m), float(y_m)) for x_m, y_m in message["obstacles"])
    straight = bool(message["straight"])
    return int(message["number"]), RouteRequest(start, goal, obstacles, straight)


def pack_result(number: int, result: RouteResult) -> bytes:
    """Return a numbered result as a frame."""
    points = [(point.x_m, point.y_m, point.speed_mps) for point in result.points]
    return pack({"number": number, **asdict(result), "points": points})


def pack_failure(number: int, failure: RouteFailure) -> bytes:
    """Return a numbered failure as a frame."""
    return pack({"number": number, "code": failure.code, "detail": failure.detail})


def read_answer(message: dict[str, Any]) -> RouteResult:
    """Return the result of a message.

    Raises:
        RouteFailure: the answer is a failure.
    """
    if "code" in message:
        raise RouteFailure(message["code"], message["detail"])
    points = tuple(RoutePoint(*map(float, point)) for point in message["points"])
    return RouteResult(
        points=points,
        length_m=float(message["length_m"]),
        moved_goal_m=float(message["moved_goal_m"]),
        start_escaped=bool(message["start_escaped"]),
        took_s=float(message["took_s"]),
    )


def limits_text(limits: RouteLimits) -> str:
    """Return limits as JSON for a command line."""
    return json.dumps(asdict(limits))


def read_limits(text: str) -> RouteLimits:
    """Return the limits that :func:`limits_text` wrote."""
    return RouteLimits(**json.loads(text))
