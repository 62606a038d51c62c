"""Hold a map as cells: free, occupied or unknown. Knows no files; bytes only, so no numpy here."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor

FREE, OCCUPIED, UNKNOWN = 0, 1, 2


@dataclass(frozen=True, slots=True)
class GridMap:
    """Keep a map's cells row by row. Row 0 is the lowest y and column 0 the lowest x in ``map``."""

    width: int
    height: int
    resolution_m: float
    origin_x_m: float  # of the lower left corner of cell (0, 0)
    origin_y_m: float
    cells: bytes  # width * height values of FREE, OCCUPIED, UNKNOWN

    def cell_of(self, x_m: float, y_m: float) -> tuple[int, int]:
        """Return (column, row) of a point in ``map``; it may lie outside the map."""
        column = floor((x_m - self.origin_x_m) / self.resolution_m)
        return column, floor((y_m - self.origin_y_m) / self.resolution_m)

    def centre_of(self, column: int, row: int) -> tuple[float, float]:
        """Return the centre of a cell in ``map`` [m]."""
        x_m = self.origin_x_m + (column + 0.5) * self.resolution_m
        return x_m, self.origin_y_m + (row + 0.5) * self.resolution_m

    def contains(self, x_m: float, y_m: float) -> bool:
        """Tell whether a point lies on the map."""
        column, row = self.cell_of(x_m, y_m)
        return 0 <= column < self.width and 0 <= row < self.height

    def at(self, x_m: float, y_m: float) -> int:
        """Return the cell at a point; beyond the edge nothing is known."""
        if not self.contains(x_m, y_m):
            return UNKNOWN
        column, row = self.cell_of(x_m, y_m)
        return self.cells[row * self.width + column]
