"""Draw a fence around the known floor of a map: loose at walls, strict where the known ends.

The lidar and the costmap keep the robot off walls, so that there the line may run in the wall. At
floor that borders on unknown cells nothing stops a robot (stairs look so on a map): there the line
keeps so far inside that, with the gate's FENCE_MARGIN_M, the robot's disc stays on what was seen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import cv2
import numpy as np

from maps.cell_array import cell_array
from maps.errors import SiteError
from maps.grid import FREE, OCCUPIED, UNKNOWN
from maps.outlines import outlines
from wire.fence import MAX_CORNERS, FenceFile
from wire.margins import FENCE_MARGIN_M

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from maps.grid import GridMap
    from maps.masks import MaskAreas

    Cells = NDArray[np.bool_]

_INTO_WALL_CELLS = 2
_SPECKLE_M2 = 0.03
"""Unknown cells fewer than this are noise, no stairs; the costmap blocks them anyway."""
_TOLERANCES_CELLS = (1.0, 2.0, 3.0, 4.0)


def floor_around(grid: GridMap, x_m: float, y_m: float) -> Cells:
    """Return the free cells that are joined to a point's; none where that is not free."""
    free = cell_array(grid) == FREE
    column, row = grid.cell_of(x_m, y_m)
    if not (0 <= column < grid.width and 0 <= row < grid.height and free[row, column]):
        return np.zeros_like(free)
    _, parts = cv2.connectedComponents(free.astype(np.uint8), connectivity=4)
    return np.asarray(parts == parts[row, column], np.bool_)


def draw_fence(
    grid: GridMap,
    map_id: str,
    floor: Cells,
    radius_m: float,
    masks: Sequence[MaskAreas] = (),
) -> FenceFile:
    """Return a fence around ``floor`` with the areas of the masks.

    Args:
        grid: the map.
        map_id: its name, which the fence carries.
        floor: the cells that the robot may come to.
        radius_m: of the robot's disc.
        masks: what keep-out and speed masks say.

    Raises:
        SiteError: ``map_too_ragged``: it takes more than MAX_CORNERS corners.
    """
    keep_outs = [area for mask in masks for area in mask.keep_outs]
    zones = [zone for mask in masks for zone in mask.speed_zones]
    taken = sum(map(len, keep_outs)) + sum(len(zone.polygon) for zone in zones)
    corners, ragged = taken, None
    for tolerance in _TOLERANCES_CELLS:
        try:
            found = outlines(_mark_allowed(grid, floor, radius_m, tolerance), grid, tolerance)
        except SiteError as error:  # a looser line may have few enough corners
            ragged = error
            continue
        ragged = None
        corners = taken + found.corners
        lines = len(found.holes) + len(keep_outs)
        if found.outer and corners <= MAX_CORNERS and lines <= 200 and len(zones) <= 200:
            return FenceFile(
                version=1,
                map_id=map_id,
                allowed=found.outer,
                keep_outs=(*found.holes, *keep_outs),
                speed_zones=tuple(zones),
            )
    if ragged is not None:
        raise ragged
    text = f"its fence takes {corners} corners; at most {MAX_CORNERS}"
    zh = f"围栏有 {corners} 个角；最多 {MAX_CORNERS} 个。请清除图像上的杂点，或自己画围栏"
    text = f"{text}. Clean the picture of speckles, or draw a fence"
    raise SiteError("map_too_ragged", text, zh)


def _mark_allowed(grid: GridMap, floor: Cells, radius_m: float, tolerance: float) -> Cells:
    cells = cell_array(grid)
    cross = np.asarray(cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3)), np.uint8)
    beside = np.asarray(cv2.dilate(floor.astype(np.uint8), cross), np.uint8).astype(bool)
    edge = beside & (cells == UNKNOWN) & _no_speckles(cells == UNKNOWN, grid.resolution_m)
    side = 2 * _INTO_WALL_CELLS + 1
    grown = cv2.dilate(floor.astype(np.uint8), np.ones((side, side), np.uint8)).astype(bool)
    allowed = floor | (grown & (cells == OCCUPIED))
    allowed |= _islands(allowed, edge)
    # Half a cell from the unknown's centre to its edge, and what the line's rounding may take.
    keep_m = max(0.0, radius_m - FENCE_MARGIN_M) + (0.5 + tolerance) * grid.resolution_m
    gap = cv2.distanceTransform((~edge).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    if edge.any():
        allowed &= np.asarray(gap, np.float64) * grid.resolution_m > keep_m
    return np.asarray(allowed, np.bool_)


def _no_speckles(unknown: Cells, resolution_m: float) -> Cells:
    _, parts, about, _ = cv2.connectedComponentsWithStats(unknown.astype(np.uint8), connectivity=8)
    large = about[:, cv2.CC_STAT_AREA] * resolution_m**2 >= _SPECKLE_M2
    return np.asarray(large[parts] & unknown, np.bool_)


def _islands(allowed: Cells, edge: Cells) -> Cells:
    """Return what the floor goes round without unknown cells: furniture, pillars, speckles."""
    outside = np.pad((~allowed).astype(np.uint8), 1, constant_values=1)
    count, parts = cv2.connectedComponents(outside, connectivity=4)
    inner = np.asarray(parts)[1:-1, 1:-1]
    open_parts = np.zeros(count, np.bool_)
    open_parts[parts[0, 0]] = True
    open_parts[np.unique(inner[edge])] = True
    return np.asarray(~open_parts[inner] & ~allowed, np.bool_)
