"""Turn marked cells into outlines in ``map`` that a fence may hold: simple, and few corners."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import cv2
import numpy as np

from maps.errors import SiteError
from wire.fence import MIN_AREA_M2, area_m2, crosses_itself

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from maps.grid import GridMap

    Mask = NDArray[np.bool_]

cv2.setNumThreads(1)  # a pool of threads would compete with the bridge's loop

Polygon = tuple[tuple[float, float], ...]
_OPENINGS = (0, 3, 5, 7)
"""Cells of the square by which marked cells are opened until no outline touches itself."""


@dataclass(frozen=True, slots=True)
class CellOutlines:
    """Hold the outer lines of marked cells, and the lines around their holes."""

    outer: tuple[Polygon, ...]
    holes: tuple[Polygon, ...]

    @property
    def corners(self) -> int:
        """Return how many corners all lines have."""
        return sum(len(line) for line in (*self.outer, *self.holes))


def outlines(marked: Mask, grid: GridMap, tolerance_cells: float) -> CellOutlines:
    """Return simple outlines of the marked cells.

    Args:
        marked: (rows, columns) of the grid, row 0 the lowest y.
        grid: gives resolution and origin.
        tolerance_cells: how far a line may leave the cells' border, to either side.

    A line runs a quarter of a cell inside of the marked cells' border.

    Raises:
        SiteError: ``map_too_ragged``: no smoothing makes the lines simple.
    """
    for side in _OPENINGS:
        mask = marked.astype(np.uint8)
        if side:
            mask = np.asarray(
                cv2.morphologyEx(mask, cv2.MORPH_OPEN, np.ones((side, side), np.uint8)), np.uint8
            )
        # Twice as fine: cells in a row of one would give a line that runs back over itself.
        fine = np.pad(np.repeat(np.repeat(mask, 2, 0), 2, 1), 1)
        lines, tree = cv2.findContours(fine, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
        if not lines:
            return CellOutlines((), ())
        outer: list[Polygon] = []
        holes: list[Polygon] = []
        for line, links in zip(lines, tree[0], strict=True):
            simple = _simple(line, grid, tolerance_cells)
            if simple is None:
                break
            if simple:
                (outer if links[3] < 0 else holes).append(simple)
        else:
            return CellOutlines(tuple(outer), tuple(holes))
    text = "however they are smoothed, its borders cross themselves or take over 1000 corners"
    zh = "无论怎样平滑，边界仍会自相交，或超过 1000 个角"
    raise SiteError("map_too_ragged", text, zh)


def _simple(line: NDArray[Any], grid: GridMap, tolerance_cells: float) -> Polygon | None:
    """Return the line in metres; empty where it has no area, None where it crosses itself."""
    for share in (1.0, 0.5, 0.25):
        corners = cv2.approxPolyDP(line, 2 * tolerance_cells * share, closed=True)[:, 0, :]
        polygon = tuple(
            (
                round(grid.origin_x_m + (float(x) - 0.5) / 2 * grid.resolution_m, 4),
                round(grid.origin_y_m + (float(y) - 0.5) / 2 * grid.resolution_m, 4),
            )
            for x, y in corners
        )
        if len(polygon) < 3 or not area_m2(polygon) > MIN_AREA_M2:
            if share == 1.0 and cv2.contourArea(line) > 16 * tolerance_cells**2:
                continue
            return ()
        if len(polygon) <= 1000 and crosses_itself(polygon) is None:
            return polygon
    return None
