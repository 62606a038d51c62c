"""Look along a line over the map: where the first wall stands. Bytes only, no numpy."""

from __future__ import annotations

from math import cos, sin
from typing import TYPE_CHECKING

from maps.grid import OCCUPIED

if TYPE_CHECKING:
    from maps.grid import GridMap

MOST_STEPS = 1_000


def first_wall_m(
    grid: GridMap, start: tuple[float, float], angle_rad: float, most_m: float
) -> float | None:
    """Return how far away the first occupied cell is [m]; None where none is within ``most_m``.

    Steps are half a cell: a wall of one cell is passed over at its very corner at most.
    """
    step_m = max(grid.resolution_m / 2, most_m / MOST_STEPS)
    dx, dy = step_m * cos(angle_rad), step_m * sin(angle_rad)
    x_m, y_m = start
    for step in range(1, int(most_m / step_m) + 1):
        if grid.at(x_m + step * dx, y_m + step * dy) == OCCUPIED:
            return step * step_m
    return None
