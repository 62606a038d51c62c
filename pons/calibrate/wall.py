"""Find the flat wall ahead in a scan. Pure geometry.

Frame ``base``: x forward, y left. Distances are counted along x from the robot's middle.
"""

from __future__ import annotations

from dataclasses import dataclass
from statistics import fmean, median

from pons.calibrate.errors import CalibrationRefusal

HALF_M, OFF_M, SHARE, FEWEST = 0.35, 0.03, 0.9, 8
STEEPEST = 1.0

Points = list[tuple[float, float]]


@dataclass(frozen=True, slots=True)
class WallFit:
    """Give the wall's distance [m] and by how much it recedes for each metre to the left."""

    distance_m: float
    slope: float


def wall_ahead(points: Points, scans: int = 1) -> WallFit:
    """Return the flat wall ahead.

    Args:
        points: where beams came back [m].
        scans: of so many scans.

    Raises:
        CalibrationRefusal: ``no_wall``: what is ahead is not flat, or nothing is.
    """
    near = _ahead(points)
    if len(near) < FEWEST * scans:
        raise CalibrationRefusal("no_wall", f"{len(near)} points ahead")
    # Least squares of x = d + m y: the wall stands across the heading, so x is the far side of it.
    for _ in range(3):
        wall = _line(near)
        flat = [(x, y) for x, y in near if abs(x - wall.distance_m - wall.slope * y) <= OFF_M]
        if not len(flat) >= SHARE * len(near) or abs(wall.slope) > STEEPEST:
            raise CalibrationRefusal("no_wall", f"{len(flat)} of {len(near)} points on one line")
        near = flat
    return _line(near)


def _ahead(points: Points) -> Points:
    """Return the points before the robot, on the nearest surface there."""
    ahead = [(x, y) for x, y in points if x > 0.0 and abs(y) <= HALF_M]
    if not ahead:
        return []
    middle = median(x for x, _ in ahead)
    return [(x, y) for x, y in ahead if abs(x - middle) <= HALF_M]


def _line(points: Points) -> WallFit:
    mean_x, mean_y = fmean(x for x, _ in points), fmean(y for _, y in points)
    spread = sum((y - mean_y) ** 2 for _, y in points)
    m = sum((x - mean_x) * (y - mean_y) for x, y in points) / spread if spread > 0.0 else 0.0
    return WallFit(mean_x - m * mean_y, m)
