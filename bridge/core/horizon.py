"""Judge a horizon of waypoints: every reason that holds is named, then the caller decides once.

Owns what a streamed path may look like. Knows no epoch, owner or time.
"""

from __future__ import annotations

from itertools import pairwise
from math import hypot
from typing import TYPE_CHECKING

from wire.scalars import MAX_POINTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bridge.core.fence import Fence
    from wire.commands import Waypoint
    from wire.geometry import Pose2

MIN_GAP_M, MAX_GAP_M = 0.05, 0.25
MIN_END_GAP_M = 0.01
"""The first point is where the robot happens to be, the last where the leg happens to end."""
FIRST_WITHIN_M = 0.5
MIN_SPEED_MPS = 0.05

GAP_TOLERANCE_M = 1e-3
"""Coordinates may come rounded to millimetres; a spacing rule has no use for more."""
SPEED_TOLERANCE_MPS = 1e-6
"""A limit that went through a division or a decimal text; the limiter holds the exact bound."""


def check_horizon(
    points: Sequence[Waypoint],
    robot_in_map: Pose2,
    max_speed_mps: float,
    fence: Fence | None,
) -> tuple[str, ...]:
    """Return every reason to refuse a horizon; none means that it may be followed.

    Args:
        points: in ``map``; no points at all is a ramp to a stop and always in order.
        robot_in_map: where the robot is now.
        max_speed_mps: robot.toml's bound on speed, without the caps of the moment.
        fence: bounds the robot's centre; None refuses, since nothing is known to be allowed.
    """
    if not points:
        return ()
    checks = (
        ("too_many_points", len(points) <= MAX_POINTS),
        ("first_point_far", _starts_here(points[0], robot_in_map)),
        ("bad_spacing", _spaced(points)),
        ("mixed_direction", _one_direction(points)),
        ("bad_speed", _speeds_fit(points, max_speed_mps)),
        ("heading_not_last", all(p.heading_rad is None for p in points[:-1])),
        ("fence_crossed", fence is not None and _inside(points, robot_in_map, fence)),
    )
    return tuple(code for code, fits in checks if not fits)


def _starts_here(first: Waypoint, robot_in_map: Pose2) -> bool:
    return hypot(first.x_m - robot_in_map.x_m, first.y_m - robot_in_map.y_m) <= FIRST_WITHIN_M


def _spaced(points: Sequence[Waypoint]) -> bool:
    last = len(points) - 2
    least, most = MIN_GAP_M - GAP_TOLERANCE_M, MAX_GAP_M + GAP_TOLERANCE_M
    for index, (a, b) in enumerate(pairwise(points)):
        gap_m = hypot(b.x_m - a.x_m, b.y_m - a.y_m)
        if not least <= gap_m <= most and not (
            index in (0, last) and MIN_END_GAP_M - GAP_TOLERANCE_M <= gap_m <= most
        ):
            return False
    return True


def _one_direction(points: Sequence[Waypoint]) -> bool:
    speeds = [p.speed_mps for p in points]
    return all(speed > 0.0 for speed in speeds) or all(speed < 0.0 for speed in speeds)


def _speeds_fit(points: Sequence[Waypoint], max_speed_mps: float) -> bool:
    low, high = MIN_SPEED_MPS - SPEED_TOLERANCE_MPS, max_speed_mps + SPEED_TOLERANCE_MPS
    return all(low <= abs(p.speed_mps) <= high for p in points)


def _inside(points: Sequence[Waypoint], robot_in_map: Pose2, fence: Fence) -> bool:
    """Test every segment, and the way to the first point unless the robot is already outside.

    A robot outside (pushed, or localized anew) must be able to come back in; the fence's gate
    watches that way, and only inwards.
    """
    x, y = robot_in_map.x_m, robot_in_map.y_m
    first = points[0]
    if fence.allows(x, y) and fence.crosses(x, y, first.x_m, first.y_m):
        return False
    if not fence.allows(first.x_m, first.y_m):
        return False
    clear_m = 0.0  # around the segment's start, as far as is known; saves most of the tests
    for a, b in pairwise(points):
        gap_m = hypot(b.x_m - a.x_m, b.y_m - a.y_m)
        if not gap_m < clear_m:
            clear_m = fence.margin_m(a.x_m, a.y_m)
        if not gap_m < clear_m and fence.crosses(a.x_m, a.y_m, b.x_m, b.y_m):
            return False
        clear_m -= gap_m  # of the next segment's start; below zero it is measured anew
    return True
