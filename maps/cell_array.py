"""View a map's cells as an array. Apart from the grid, which needs no numpy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from maps.grid import GridMap


def cell_array(grid: GridMap) -> NDArray[np.uint8]:
    """Return the cells as (rows, columns), row 0 the lowest y; read only, without a copy."""
    return np.frombuffer(grid.cells, np.uint8).reshape(grid.height, grid.width)
