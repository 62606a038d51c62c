"""Lay a map with a yaw in its origin along the axes of ``map``. Brings numpy; loaded when needed.

Nav2's costmap ignored this yaw for years (navigation2#1511); a map that is used must be turned.
"""

from __future__ import annotations

from math import ceil, cos, floor, sin
from typing import TYPE_CHECKING

import numpy as np

from maps.cell_array import cell_array
from maps.errors import SiteError
from maps.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from maps.image import MAX_PIXELS

if TYPE_CHECKING:
    from pathlib import Path

_REACH = 0.3
"""Of a cell, from its centre to where its neighbours are looked at, too. A wall of one pixel stays
joined edge to edge at any angle: it needs |cos| + |sin| of width, 1.41 at 45 degrees, and
1 + 2 x 0.3 x 0.71 = 1.42 are seen. It grows by at most 0.3 of a cell on each side."""
_LOOKS = ((0.0, 0.0), (_REACH, 0.0), (-_REACH, 0.0), (0.0, _REACH), (0.0, -_REACH))
_ROWS_AT_ONCE = 256
"""Bounds the memory: the coordinates of a whole map take sixteen times its cells."""


def straighten(grid: GridMap, yaw_rad: float, where: Path) -> GridMap:
    """Return the map's cells in rows along x of ``map``, at the same resolution.

    Args:
        grid: the cells as in the picture; its origin is the corner about which they are turned.
        yaw_rad: turn of the picture's x axis against x of ``map``, anticlockwise.
        where: names the map in a refusal.

    A cell is occupied where any of five points in it is, free where all of them are.

    Raises:
        SiteError: ``map_image_too_large``: the rectangle around the turned map has too many cells.
    """
    size = grid.resolution_m
    turn, rise = cos(yaw_rad), sin(yaw_rad)
    corners = [
        (column * turn - row * rise, column * rise + row * turn)
        for column in (0, grid.width)
        for row in (0, grid.height)
    ]
    left, low = (floor(min(c[axis] for c in corners) + 1e-6) for axis in (0, 1))
    width = ceil(max(c[0] for c in corners) - 1e-6) - left
    height = ceil(max(c[1] for c in corners) - 1e-6) - low
    if not width * height <= MAX_PIXELS:
        text = f"{where}: turned by {yaw_rad} rad it covers {width} x {height} cells"
        zh = f"{where}：旋转 {yaw_rad} 弧度后占 {width} x {height} 格；总数最多 {MAX_PIXELS}"
        text = f"{text}; expected at most {MAX_PIXELS} in all"
        raise SiteError("map_image_too_large", text, zh)
    source = np.pad(cell_array(grid), 1, constant_values=UNKNOWN)
    turned = np.empty((height, width), np.uint8)
    x = left + np.arange(width) + 0.5
    for first in range(0, height, _ROWS_AT_ONCE):
        y = low + np.arange(first, min(first + _ROWS_AT_ONCE, height))[:, None] + 0.5
        found = np.full((len(y), width), FREE, np.uint8)
        for dx, dy in _LOOKS:
            column = np.floor((x + dx) * turn + (y + dy) * rise).astype(np.int64)
            row = np.floor((y + dy) * turn - (x + dx) * rise).astype(np.int64)
            np.clip(column, -1, grid.width, out=column)
            np.clip(row, -1, grid.height, out=row)
            kinds = source[row + 1, column + 1]
            # OCCUPIED beats UNKNOWN beats FREE.
            found[(kinds == UNKNOWN) & (found == FREE)] = UNKNOWN
            found[kinds == OCCUPIED] = OCCUPIED
        turned[first : first + len(y)] = found
    x_m, y_m = grid.origin_x_m + left * size, grid.origin_y_m + low * size
    return GridMap(width, height, size, x_m, y_m, turned.tobytes())
