"""Judge by one scan whether there is room to calibrate, and which way. Pure geometry.

Frame ``base``: x forward, y left. The robot is the disc of robot.toml; free lengths are counted
from its edge, as the bridge does.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, pi, sin, tau
from typing import TYPE_CHECKING

from pons.calibrate.refusals import CalibrationRefused
from wire import Pose2, transform, wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from wire import RobotDescription, Scan

ASIDE_M = 0.05
"""Kept free on either side of the disc."""
END_M = 0.30
"""Beyond a run's end: the bridge slows down where it could not stop, and a run must be even."""
BEHIND_M = 0.25
"""Behind a run's beginning, for the way back."""
LONGEST_M, SHORTEST_M = 1.2, 0.75
OFF = 1.12
"""A radius may be so much larger than robot.toml believes."""
RETURNS = 0.5
HEADINGS = 72

Points = list[tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Way:
    """Name a heading to drive back and forth in, and how far."""

    heading_rad: float
    run_m: float


def points_of(scan: Scan, robot: RobotDescription) -> Points:
    """Return where beams came back, in ``base`` [m].

    Raises:
        CalibrationRefused: ``no_lidar``: fewer than half of them did.
    """
    lidar_in_base = Pose2(robot.lidar.x_m, robot.lidar.y_m, robot.lidar.yaw_rad)
    points: Points = []
    for index, range_m in enumerate(scan.ranges_m):
        if range_m is not None:
            angle = scan.angle_min_rad + index * scan.angle_increment_rad
            points.append(transform(lidar_in_base, range_m * cos(angle), range_m * sin(angle)))
    if not len(points) >= RETURNS * len(scan.ranges_m) > 0:
        text = f"{len(points)} of {len(scan.ranges_m)} beams came back"
        raise CalibrationRefused("no_lidar", text)
    return points


def free_m(points: Points, radius_m: float, heading_rad: float) -> float:
    """Return the free length from the disc's edge along a heading."""
    c, s = cos(heading_rad), sin(heading_rad)
    nearest = 100.0
    for x, y in points:
        along, aside = x * c + y * s, y * c - x * s
        if along > 0.0 and abs(aside) <= radius_m + ASIDE_M:
            nearest = min(nearest, along)
    return max(0.0, nearest - radius_m)


def needed_m(run_m: float) -> float:
    """Return the free length that a run of so many believed metres needs ahead."""
    return OFF * run_m + END_M


def clear_to_turn(points: Points, radius_m: float) -> None:
    """See that the robot may turn on the spot.

    Raises:
        CalibrationRefused: ``no_room``.
    """
    nearest = min(hypot(x, y) for x, y in points)
    if not nearest >= radius_m + ASIDE_M:
        needs_m = radius_m + ASIDE_M
        text = f"something is {nearest:.2f} m from the middle; turning needs {needs_m:.2f} m"
        raise CalibrationRefused("no_room", text)


def best_way(points: Points, radius_m: float, headings: Sequence[float] = ()) -> Way:
    """Choose the heading that needs the least turning among those with room for a long run.

    Raises:
        CalibrationRefused: ``no_room``, with what the best heading has.
    """
    clear_to_turn(points, radius_m)
    candidates = headings or [wrap(index * tau / HEADINGS) for index in range(HEADINGS)]
    best, most = Way(0.0, 0.0), -1.0
    for heading in candidates:
        ahead, behind = free_m(points, radius_m, heading), free_m(points, radius_m, heading + pi)
        run_m = min(LONGEST_M, (ahead - END_M) / OFF) if behind >= BEHIND_M else 0.0
        worth = run_m - 0.1 * abs(heading)
        if worth > most:
            best, most = Way(heading, run_m), worth
    if not best.run_m >= SHORTEST_M:
        had = max(free_m(points, radius_m, heading) for heading in candidates)
        text = (
            f"{had:.2f} m are free at best; a run needs {needed_m(SHORTEST_M):.2f} m ahead and "
            f"{BEHIND_M:.2f} m behind"
        )
        raise CalibrationRefused("no_room", text)
    return best
