"""Judge a horizon of waypoints: every reason that holds is named, then the caller decides once.

Owns what a streamed path may look like. Knows no epoch, owner or time.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from wire.bounded_types import MAX_POINTS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bridge.core.geometry.fence import FenceGrid
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
    fence: FenceGrid | None,
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
    xs, ys = [p.x_m for p in points], [p.y_m for p in points]
    gaps = [hypot(bx - ax, by - ay) for ax, bx, ay, by in zip(xs, xs[1:], ys, ys[1:], strict=False)]
    speeds = [p.speed_mps for p in points]
    checks = (
        ("too_many_points", len(points) <= MAX_POINTS),
        ("first_point_far", _starts_here(points[0], robot_in_map)),
        ("bad_spacing", _is_well_spaced(gaps)),
        ("mixed_direction", _one_direction(speeds)),
        ("bad_speed", _speeds_fit(speeds, max_speed_mps)),
        ("heading_not_last", not [p for p in points[:-1] if p.heading_rad is not None]),
        ("fence_crossed", fence is not None and _keeps_inside(xs, ys, gaps, robot_in_map, fence)),
    )
    return tuple([code for code, fits in checks if not fits])


def _starts_here(first: Waypoint, robot_in_map: Pose2) -> bool:
    return hypot(first.x_m - robot_in_map.x_m, first.y_m - robot_in_map.y_m) <= FIRST_WITHIN_M


def _is_well_spaced(gaps: list[float]) -> bool:
    """Tell whether all points lie well apart; the first and the last gap may be small."""
    low, most = MIN_GAP_M - GAP_TOLERANCE_M, MAX_GAP_M + GAP_TOLERANCE_M
    least = MIN_END_GAP_M - GAP_TOLERANCE_M
    ends = (*gaps[:1], *gaps[-1:])
    return _all_within(ends, least, most) and _all_within(gaps[1:-1], low, most)


def _one_direction(speeds: list[float]) -> bool:
    ahead, back = [v for v in speeds if v > 0.0], [v for v in speeds if v < 0.0]
    return len(speeds) in {len(ahead), len(back)}


def _speeds_fit(speeds: list[float], max_speed_mps: float) -> bool:
    low, high = MIN_SPEED_MPS - SPEED_TOLERANCE_MPS, max_speed_mps + SPEED_TOLERANCE_MPS
    return _all_within(map(abs, speeds), low, high)


def _all_within(values: Iterable[float], low: float, high: float) -> bool:
    """Return whether all values lie within their bounds; NaN does not."""
    return not [value for value in values if not low <= value <= high]


def _keeps_inside(
    xs: list[float], ys: list[float], gaps: list[float], robot_in_map: Pose2, fence: FenceGrid
) -> bool:
    """Test every segment, and the way to the first point unless the robot is already outside.

    A robot outside (pushed, or localized anew) must be able to come back in; the fence's gate
    watches that way, and only inwards.
    """
    x, y = robot_in_map.x_m, robot_in_map.y_m
    # Around the segment's start, as far as is known; saves most of the tests.
    clear_m = fence.margin_m(x, y) - hypot(xs[0] - x, ys[0] - y)
    if not clear_m > 0.0:
        if fence.allows(x, y) and fence.crosses(x, y, xs[0], ys[0]):
            return False
        if not fence.allows(xs[0], ys[0]):
            return False
    for i, gap_m in enumerate(gaps):
        if not gap_m < clear_m:
            clear_m = fence.margin_m(xs[i], ys[i])
            if not gap_m < clear_m and fence.crosses(xs[i], ys[i], xs[i + 1], ys[i + 1]):
                return False
        clear_m -= gap_m  # of the next segment's start; below zero it is measured anew
    return True
