"""Cast scans in drawn rooms, for tests of what is remembered of them."""

from __future__ import annotations

from functools import lru_cache
from math import cos, inf, pi, sin

import numpy as np

from maps.cell_array import cell_array
from planner.navigation import ScanObservation
from planner.site import FREE, GridMap
from wire import Pose2

BEAMS = 180
STILL = Pose2(0.0, 0.0, 0.0)
Disc = tuple[float, float, float]
"""x, y, radius [m]."""


def seen_from(
    grid: GridMap,
    robot: Pose2,
    at_s: float,
    *discs: Disc,
    ahead: tuple[tuple[float, float], ...] = (),
    noise_m: float = 0.0,
    seed: int = 0,
) -> ScanObservation:
    """Return what a lidar in the robot's middle sees of the map's walls and of discs."""
    draws = np.random.default_rng(seed)
    walls_m = _to_walls(grid, robot)
    ranges = []
    for beam in range(BEAMS):
        angle = robot.yaw_rad - pi + 2 * pi * beam / BEAMS
        near_m = min((_to_disc(robot, angle, disc) for disc in discs), default=inf)
        far_m = min(walls_m[beam], near_m)
        far_m += float(draws.normal(0.0, noise_m)) if noise_m else 0.0
        ranges.append(far_m if far_m < 8.0 else None)
    return ScanObservation(robot, STILL, -pi, 2 * pi / BEAMS, 0.1, tuple(ranges), at_s, ahead)


@lru_cache(maxsize=8)
def _to_walls(grid: GridMap, robot: Pose2) -> list[float]:
    """March along each beam in steps of 2 cm to the first cell that is not free."""
    angles = robot.yaw_rad - pi + 2 * pi * np.arange(BEAMS) / BEAMS
    away_m = np.arange(0.02, 8.0, 0.02)
    x_m = robot.x_m + away_m * np.cos(angles)[:, None]
    y_m = robot.y_m + away_m * np.sin(angles)[:, None]
    column = np.floor((x_m - grid.origin_x_m) / grid.resolution_m).astype(int)
    row = np.floor((y_m - grid.origin_y_m) / grid.resolution_m).astype(int)
    inside = (column >= 0) & (column < grid.width) & (row >= 0) & (row < grid.height)
    cells = cell_array(grid)[np.clip(row, 0, grid.height - 1), np.clip(column, 0, grid.width - 1)]
    hit = ~inside | (cells != FREE)
    return [float(away_m[beam.argmax()]) if beam.any() else inf for beam in hit]


def _to_disc(robot: Pose2, angle: float, disc: Disc) -> float:
    x_m, y_m, radius_m = disc[0] - robot.x_m, disc[1] - robot.y_m, disc[2]
    along_m = x_m * cos(angle) + y_m * sin(angle)
    beside_m = abs(-x_m * sin(angle) + y_m * cos(angle))
    if along_m <= 0.0 or beside_m >= radius_m:
        return inf
    return float(along_m - (radius_m**2 - beside_m**2) ** 0.5)
