"""Put requests and results into frames between the planner and its route process. Pure."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from planner.navigation.route import (
    FloorReport,
    Mover,
    ObstacleReport,
    RouteLimits,
    RoutePoint,
    RouteRequest,
    RouteResult,
    RouteSurvey,
    ScanObservation,
)
from processes.worker_protocol import Frame
from wire.geometry import Pose2


def read_request(frame: Frame) -> RouteRequest:
    """Return the request whose fields a frame holds."""
    head, _ = frame
    start, goal = Pose2(**head["start"]), Pose2(**head["goal"])
    obstacles = tuple((float(x_m), float(y_m)) for x_m, y_m in head["obstacles"])
    kinds = {
        name: bool(head[name]) for name in ("straight", "aside", "strict", "explore", "survey")
    }
    return RouteRequest(
        start,
        goal,
        obstacles,
        keep_right_m=float(head["keep_right_m"]),
        passes_m=float(head["passes_m"]),
        sees=_read_point(head["sees"]),
        sees_from_m=float(head["sees_from_m"]),
        **kinds,
    )


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
        floor=_read_floor(head["floor"]),
        faces=_read_point(head["faces"]),
        survey=_read_survey(head["survey"]),
    )


def _read_survey(head: dict[str, Any] | None) -> RouteSurvey | None:
    if head is None:
        return None
    narrowest_m = head["narrowest_m"]
    return RouteSurvey(
        narrowest_m=None if narrowest_m is None else float(narrowest_m),
        narrowest_at=_read_point(head["narrowest_at"]),
        suspect_m=float(head["suspect_m"]),
        hoped=bool(head["hoped"]),
    )


def _read_point(point: Any) -> tuple[float, float] | None:
    return None if point is None else (float(point[0]), float(point[1]))


def _read_floor(head: dict[str, Any] | None) -> FloorReport | None:
    return None if head is None else FloorReport(float(head["known_m2"]), bool(head["explored"]))


def is_observation(frame: Frame) -> bool:
    """Return whether a frame shows a scan, and does not ask for a route."""
    return "ranges_m" in frame[0]


def read_observation(frame: Frame) -> ScanObservation:
    """Return the observation whose fields a frame holds."""
    head, _ = frame
    return ScanObservation(
        base_in_map=Pose2(**head["base_in_map"]),
        lidar_in_base=Pose2(**head["lidar_in_base"]),
        first_rad=float(head["first_rad"]),
        step_rad=float(head["step_rad"]),
        range_min_m=float(head["range_min_m"]),
        ranges_m=tuple(head["ranges_m"]),
        at_s=float(head["at_s"]),
        ahead=tuple((float(x_m), float(y_m)) for x_m, y_m in head["ahead"]),
    )


def report_frame(report: ObstacleReport) -> Frame:
    """Return a report as a frame: the cells are its body."""
    head = {
        "version": report.version,
        "blocked_ahead_m": report.blocked_ahead_m,
        "movers": [asdict(mover) for mover in report.movers],
        "cells_bytes": len(report.cells),
    }
    return head, report.cells + report.suspicions


def read_report(frame: Frame) -> ObstacleReport:
    """Return the report that :func:`report_frame` wrote."""
    head, body = frame
    ahead_m, split = head["blocked_ahead_m"], int(head["cells_bytes"])
    return ObstacleReport(
        version=int(head["version"]),
        blocked_ahead_m=None if ahead_m is None else float(ahead_m),
        movers=tuple(Mover(**mover) for mover in head["movers"]),
        cells=body[:split],
        suspicions=body[split:],
    )


def limits_text(limits: RouteLimits) -> str:
    """Return limits as JSON for a command line."""
    return json.dumps(asdict(limits))


def read_limits(text: str) -> RouteLimits:
    """Return the limits that :func:`limits_text` wrote."""
    return RouteLimits(**json.loads(text))
