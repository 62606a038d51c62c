"""Put requests and results into frames between the planner and its route process. Pure."""

from __future__ import annotations

import json
from dataclasses import asdict

from planner.navigation.route import RouteLimits, RoutePoint, RouteRequest, RouteResult
from processes.worker_protocol import Frame
from wire.geometry import Pose2


def read_request(frame: Frame) -> RouteRequest:
    """Return the request whose fields a frame holds."""
    head, _ = frame
    start, goal = Pose2(**head["start"]), Pose2(**head["goal"])
    obstacles = tuple((float(x_m), float(y_m)) for x_m, y_m in head["obstacles"])
    return RouteRequest(start, goal, obstacles, bool(head["straight"]))


def result_frame(result: RouteResult) -> Frame:
    """Return a result as a frame."""
    points = [(point.x_m, point.y_m, point.speed_mps) for point in result.points]
    return {**asdict(result), "points": points}, b""


def read_result(frame: Frame) -> RouteResult:
    """Return the result that :func:`result_frame` wrote."""
    head, _ = frame
    return RouteResult(
        points=tuple(RoutePoint(*map(float, point)) for point in head["points"]),
        length_m=float(head["length_m"]),
        moved_goal_m=float(head["moved_goal_m"]),
        start_escaped=bool(head["start_escaped"]),
        took_s=float(head["took_s"]),
    )


def limits_text(limits: RouteLimits) -> str:
    """Return limits as JSON for a command line."""
    return json.dumps(asdict(limits))


def read_limits(text: str) -> RouteLimits:
    """Return the limits that :func:`limits_text` wrote."""
    return RouteLimits(**json.loads(text))
