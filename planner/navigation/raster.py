"""Draw outlines and points on a map's cells, and measure distances. Knows cells; no robot."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from planner.site import Fence, GridMap
from planner.site.polygon import Polygon

cv2.setNumThreads(1)  # a pool of threads would compete with the bridge's loop for two cores

_SHIFT = 8  # OpenCV draws in fixed point with this many fractional bits


def distance_m(clear: NDArray[np.bool_], resolution_m: float) -> NDArray[np.float32]:
    """Return the distance from each cell's centre to the edge of the nearest cell not clear [m].

    What lies beyond the edge of the map is not clear. Negative (half a cell) in cells not clear.
    Half a cell is taken off a distance between centres, which beside a corner leaves up to 0.21 of
    a cell too much: 0.01 m at 0.05 m, within the costmap's margin.
    """
    padded = np.pad(clear.astype(np.uint8), 1)
    cells = cv2.distanceTransform(padded, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)[1:-1, 1:-1]
    return np.asarray((cells - 0.5) * resolution_m, np.float32)


def fence_mask(fence: Fence, grid: GridMap) -> NDArray[np.bool_]:
    """Return the cells that lie wholly where the fence lets the robot's centre be."""
    shape = (grid.height, grid.width)
    allowed = np.zeros(shape, np.uint8)
    for outline in fence.record.allowed:
        one = np.zeros(shape, np.uint8)
        corners = _corners(outline, grid)
        cv2.fillPoly(one, [corners], 1, shift=_SHIFT)
        # The line itself is drawn away, so that a cell it crosses does not count as inside.
        cv2.polylines(one, [corners], isClosed=True, color=0, thickness=1, shift=_SHIFT)
        allowed |= one
    for outline in fence.record.keep_outs:
        cv2.fillPoly(allowed, [_corners(outline, grid)], 0, shift=_SHIFT)
    return allowed.astype(bool)


def draw_points(mask: NDArray[np.bool_], grid: GridMap, points_m: NDArray[np.float64]) -> None:
    """Set the cells of points that lie on the map, in place."""
    column = ((points_m[:, 0] - grid.origin_x_m) / grid.resolution_m).astype(int)
    row = ((points_m[:, 1] - grid.origin_y_m) / grid.resolution_m).astype(int)
    mask[row, column] = True


def _corners(outline: Polygon, grid: GridMap) -> NDArray[np.int32]:
    xy_m = np.asarray(outline, np.float64) - (grid.origin_x_m, grid.origin_y_m)
    # OpenCV's pixel (0, 0) has its centre at 0, ours at half a cell.
    pixels = np.clip(xy_m / grid.resolution_m - 0.5, -1e4, 1e5)
    return np.round(pixels * (1 << _SHIFT)).astype(np.int32)
