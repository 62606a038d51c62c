"""Tell the gaps between a lidar's beams from floor that nobody saw.

A scan of one beam a degree leaves unknown slivers in the floor from three metres on. As long as a
map is made they are no obstacle and no frontier: what stands in one is seen on the way there.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

from maps.cell_array import cell_array
from maps.grid import FREE, OCCUPIED, UNKNOWN

if TYPE_CHECKING:
    from maps.grid import GridMap

THIN_M = 0.25
"""A degree at 12 m is 0.21 m."""


def wide_unknown(grid: GridMap) -> NDArray[np.bool_]:
    """Return the unknown cells of places that are wider than the gaps between beams."""
    unknown = (cell_array(grid) == UNKNOWN).astype(np.uint8)
    size = max(1, round(THIN_M / grid.resolution_m))
    # The edge of the map bounds nothing: beyond it nothing is known either.
    padded = cv2.copyMakeBorder(unknown, size, size, size, size, cv2.BORDER_CONSTANT, value=1)
    wide = cv2.morphologyEx(padded, cv2.MORPH_OPEN, np.ones((size, size), np.uint8))
    return np.asarray(wide[size:-size, size:-size] > 0, np.bool_)


def fill_beam_gaps(grid: GridMap) -> GridMap:
    """Return the map with its slivers as floor; those beside a wall stay unknown."""
    cells = cell_array(grid)
    walls = cv2.dilate((cells == OCCUPIED).astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    slivers = (cells == UNKNOWN) & ~wide_unknown(grid) & ~walls
    return replace(grid, cells=np.where(slivers, FREE, cells).astype(np.uint8).tobytes())
