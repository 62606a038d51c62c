"""Distance to the nearest obstacle of a map, with its gradient, and what rays meet on the way.

Built once from a map's occupied cells; every later module looks up here and nowhere else. Cells
lie in rows of rising y, as :class:`maps.GridMap` keeps them. Pure: arrays in, arrays out, metres in
``map``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from maps import FREE, OCCUPIED
from maps.cell_array import cell_array

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from maps import GridMap

    Floats = NDArray[np.float64]

MAX_DISTANCE_M = 2.0
"""Farther from everything, a lidar return is no evidence of where the map's obstacles are."""
BORDER_CELLS = 24
"""Unknown cells around the map: gradients lead back in, and a search window fits beside an outer
wall (1 m of cells of 0.05 m)."""
ROWS_AT_ONCE = 64
"""Of the map, while distances are computed: what a processor's cache holds."""


class DistanceField:
    """Look up distances to the surfaces of a map's obstacles."""

    def __init__(
        self,
        occupied: NDArray[np.bool_],
        free: NDArray[np.bool_],
        resolution_m: float,
        origin_m: tuple[float, float],
        surface: NDArray[np.bool_] | None = None,
    ) -> None:
        """Compute the field.

        Args:
            occupied: cells of obstacles, shape (rows, columns), row 0 at the lowest y.
            free: cells of known floor, same shape.
            resolution_m: side of a cell [m].
            origin_m: the lower left corner of cell (0, 0) in ``map`` [m].
            surface: the cells that distances are measured to; what a lidar can see of ``occupied``
                if left out.
        """
        self.resolution_m = resolution_m
        border = BORDER_CELLS
        self.occupied = np.pad(occupied, border)
        self.free = np.pad(free, border)
        self.rows, self.columns = self.occupied.shape
        self.origin_m = (
            origin_m[0] - border * resolution_m,
            origin_m[1] - border * resolution_m,
        )
        lines = surface_cells(self.occupied) if surface is None else np.pad(surface, border)
        self.distance_m = _distance_to(lines, resolution_m)
        self._flat = np.ascontiguousarray(self.distance_m, np.float64).ravel()
        self._occupied_flat = self.occupied.ravel()

    @classmethod
    def of_map(cls, grid: GridMap) -> DistanceField:
        """Return the field of a map; what is unknown is neither obstacle nor floor."""
        cells = cell_array(grid)
        origin_m = (grid.origin_x_m, grid.origin_y_m)
        return cls(cells == OCCUPIED, cells == FREE, grid.resolution_m, origin_m)

    def distance(self, x_m: Floats, y_m: Floats) -> Floats:
        """Return the distance at points, interpolated between cell centres [m]."""
        return self._interpolate(x_m, y_m)[0]

    def distance_and_gradient(self, x_m: Floats, y_m: Floats) -> tuple[Floats, Floats, Floats]:
        """Return the distance [m] and its derivatives by x and y, exact for the interpolation.

        A lookup rounded to a fixed fraction of a cell (``cv2.remap`` rounds to 1/32) keeps
        Gauss-Newton from settling: 20 iterations and a p95 error of 0.027 m in place of 0.016.
        """
        return self._interpolate(x_m, y_m)

    def is_occupied(self, x_m: Floats, y_m: Floats) -> NDArray[np.bool_]:
        """Return whether points lie in cells of obstacles; outside of the map none do."""
        column = np.floor((x_m - self.origin_m[0]) / self.resolution_m).astype(np.int64)
        row = np.floor((y_m - self.origin_m[1]) / self.resolution_m).astype(np.int64)
        inside = (column >= 0) & (column < self.columns) & (row >= 0) & (row < self.rows)
        index = np.where(inside, row * self.columns + column, 0)
        return np.asarray(self._occupied_flat[index] & inside)

    def cell_centre(self, row: NDArray[np.intp], column: NDArray[np.intp]) -> tuple[Floats, Floats]:
        """Return the centres of cells in ``map`` [m]."""
        x_m = self.origin_m[0] + (column + 0.5) * self.resolution_m
        y_m = self.origin_m[1] + (row + 0.5) * self.resolution_m
        return np.asarray(x_m, np.float64), np.asarray(y_m, np.float64)

    def _interpolate(self, x_m: Floats, y_m: Floats) -> tuple[Floats, Floats, Floats]:
        scale = 1.0 / self.resolution_m
        u = np.clip((x_m - self.origin_m[0]) * scale - 0.5, 0.0, self.columns - 1.001)
        v = np.clip((y_m - self.origin_m[1]) * scale - 0.5, 0.0, self.rows - 1.001)
        column, row = u.astype(np.int64), v.astype(np.int64)
        u -= column
        v -= row
        index = row * self.columns + column
        low_left, low_right = self._flat.take(index), self._flat.take(index + 1)
        index += self.columns
        high_left, high_right = self._flat.take(index), self._flat.take(index + 1)
        low_slope, high_slope = low_right - low_left, high_right - high_left
        low, high = low_left + u * low_slope, high_left + u * high_slope
        rise = high - low
        by_x = (low_slope + v * (high_slope - low_slope)) * scale
        return low + v * rise, by_x, rise * scale


def surface_cells(occupied: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return the occupied cells beside one that is not: what a lidar can see of an obstacle."""
    solid = np.pad(occupied, 1, constant_values=False)
    inner = solid[:-2, 1:-1] & solid[2:, 1:-1] & solid[1:-1, :-2] & solid[1:-1, 2:]
    return np.asarray(occupied & ~inner)


def _distance_to(surface: NDArray[np.bool_], resolution_m: float) -> NDArray[np.float32]:
    """Return each cell centre's distance to the nearest surface cell's, at most MAX_DISTANCE_M.

    Exact, one axis after the other (Saito and Toriwaki 1994), and no farther than it is asked for.
    In numpy, for OpenCV would add 18 MB to each of two processes; a home takes 5 ms.
    """
    reach = int(np.ceil(MAX_DISTANCE_M / resolution_m))
    far = np.float32(2 * reach)
    row = np.arange(len(surface), dtype=np.float32)[:, None]
    below = np.maximum.accumulate(np.where(surface, row, -far), axis=0)
    above = np.minimum.accumulate(np.where(surface, row, row[-1] + far)[::-1], axis=0)[::-1]
    squared = np.minimum(np.minimum(row - below, above - row), far) ** 2
    nearest = squared.copy()
    for start in range(0, len(surface), ROWS_AT_ONCE):
        rows = slice(start, start + ROWS_AT_ONCE)
        here, best = squared[rows], nearest[rows]
        for step in range(1, min(reach, surface.shape[1] - 1) + 1):
            along = here + np.float32(step * step)
            np.minimum(best[:, step:], along[:, :-step], out=best[:, step:])
            np.minimum(best[:, :-step], along[:, step:], out=best[:, :-step])
    metres = np.minimum(np.sqrt(nearest) * resolution_m, MAX_DISTANCE_M)
    return np.asarray(metres, np.float32)
