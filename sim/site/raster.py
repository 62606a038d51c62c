"""Draw the occupancy grid, and measure clearance and reach on it.

A cell is occupied when any solid covers part of it, so that the map never shows less than the
physics holds. Row 0 of every array is the southern row (the lowest y); files turn it over.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import ceil, floor
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from sim.site.plan import room_rects, solids
from sim.site.shapes import EPS_M, Disc, Rect, Shape

if TYPE_CHECKING:
    from collections.abc import Iterable

    from sim.site.shapes import Solid
    from sim.site.spec import Home

RESOLUTION_M = 0.05
MARGIN_M = 0.5
"""Unknown cells kept around the home, so that nothing touches the image's edge."""
OCCUPIED, UNKNOWN, FREE = 0, 205, 254
"""Grey values as Nav2's map saver writes them."""


@dataclass(frozen=True, slots=True, eq=False)
class MapRaster:
    """Hold cells [row, column] and the map coordinates of the south-west corner."""

    cells: NDArray[np.uint8]
    x0_m: float
    y0_m: float

    def cell(self, x_m: float, y_m: float) -> tuple[int, int]:
        """Return the row and column under a point."""
        return floor((y_m - self.y0_m) / RESOLUTION_M), floor((x_m - self.x0_m) / RESOLUTION_M)

    def centres(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return x and y of every cell centre [m], each shaped like ``cells``."""
        rows, columns = self.cells.shape
        x = self.x0_m + (np.arange(columns) + 0.5) * RESOLUTION_M
        y = self.y0_m + (np.arange(rows) + 0.5) * RESOLUTION_M
        xs, ys = np.meshgrid(x, y)
        return xs, ys


def _blank(home: Home) -> MapRaster:
    boxes = [solid.shape.bounds for solid in solids(home)]
    x0 = floor(round((min(b.x0 for b in boxes) - MARGIN_M) / RESOLUTION_M, 6)) * RESOLUTION_M
    y0 = floor(round((min(b.y0 for b in boxes) - MARGIN_M) / RESOLUTION_M, 6)) * RESOLUTION_M
    columns = ceil(round((max(b.x1 for b in boxes) + MARGIN_M - x0) / RESOLUTION_M, 6))
    rows = ceil(round((max(b.y1 for b in boxes) + MARGIN_M - y0) / RESOLUTION_M, 6))
    cells = np.full((rows, columns), UNKNOWN, dtype=np.uint8)
    return MapRaster(cells, round(x0, 6), round(y0, 6))


def distance(shape: Shape, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the distance of many points from a shape [m]; 0 inside."""
    if isinstance(shape, Disc):
        return np.maximum(0.0, np.hypot(x - shape.x, y - shape.y) - shape.radius)
    dx = np.maximum(np.maximum(shape.x0 - x, x - shape.x1), 0.0)
    dy = np.maximum(np.maximum(shape.y0 - y, y - shape.y1), 0.0)
    return np.hypot(dx, dy)


def _covered_cells(grid: MapRaster, shape: Shape) -> NDArray[np.bool_]:
    """Mark the cells of which the shape covers some area."""
    xs, ys = grid.centres()
    half = RESOLUTION_M / 2 - EPS_M
    if isinstance(shape, Disc):
        dx = np.maximum(np.abs(xs - shape.x) - half, 0.0)
        dy = np.maximum(np.abs(ys - shape.y) - half, 0.0)
        return np.hypot(dx, dy) < shape.radius
    x_hit = (xs + half > shape.x0) & (xs - half < shape.x1)
    y_hit = (ys + half > shape.y0) & (ys - half < shape.y1)
    return x_hit & y_hit


def draw(home: Home) -> MapRaster:
    """Draw rooms free, solids occupied and the rest unknown."""
    grid = _blank(home)
    for room in room_rects(home).values():
        grid.cells[_covered_cells(grid, room)] = FREE
    for solid in solids(home):
        grid.cells[_covered_cells(grid, solid.shape)] = OCCUPIED
    return grid


def mark_near(standing: Iterable[Solid], grid: MapRaster, radius_m: float) -> NDArray[np.bool_]:
    """Mark the cells that are nearer to a solid than a radius, from centre to shape."""
    xs, ys = grid.centres()
    near = np.zeros(grid.cells.shape, dtype=np.bool_)
    for solid in standing:
        box = solid.shape.bounds.expand(radius_m)
        (row0, column0), (row1, column1) = grid.cell(box.x0, box.y0), grid.cell(box.x1, box.y1)
        part = np.s_[max(row0, 0) : row1 + 1, max(column0, 0) : column1 + 1]
        near[part] |= distance(solid.shape, xs[part], ys[part]) < radius_m
    return near


def reachable(open_cells: NDArray[np.bool_], start: tuple[int, int]) -> NDArray[np.bool_]:
    """Mark the open cells that are joined to ``start`` by steps to four neighbours."""
    seen = np.zeros_like(open_cells)
    rows, columns = open_cells.shape
    queue = deque([start] if open_cells[start] else [])
    seen[start] = bool(queue)
    while queue:
        row, column = queue.popleft()
        for r, c in ((row - 1, column), (row + 1, column), (row, column - 1), (row, column + 1)):
            if 0 <= r < rows and 0 <= c < columns and open_cells[r, c] and not seen[r, c]:
                seen[r, c] = True
                queue.append((r, c))
    return seen


def mark_inside(areas: list[Rect], grid: MapRaster) -> NDArray[np.bool_]:
    """Mark the cells whose centre lies in one of the rectangles."""
    xs, ys = grid.centres()
    marked = np.zeros(grid.cells.shape, dtype=np.bool_)
    for area in areas:
        marked |= (xs >= area.x0) & (xs <= area.x1) & (ys >= area.y0) & (ys <= area.y1)
    return marked
