"""Search a large floor coarse to fine: over blocks of cells, then over the cells along that way.

A block is as cheap as its cheapest cell, so whatever is joined by cells is joined by blocks, and
no way over blocks costs more than one over cells. Around the thinnest wall a strip of two radii is
blocked, so blocks that are narrower than a radius lose no wall.
"""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from planner.navigation.search import Lattice, costs_to, find_path
from planner.navigation.start_and_goal import Cell

Floats = NDArray[np.float32]

BLOCK = 4
"""Cells of a block each way."""
LARGE_CELLS = 300_000
"""From here on a floor is searched coarse to fine. A home of 10 x 12 m has 58 000 cells of 5 cm."""
CORRIDORS = (3, 24)
"""Blocks to each side of the coarse way that the fine search may use; the second where the first
holds no way. 3 is what a way round a crate takes; wider found nothing cheaper (ADR 0040)."""
_FAR = np.float32(1e9)


class SearchFloor(Protocol):
    """Find ways between cells of one costmap; fields of costs to a goal are on its lattice."""

    lattice: Lattice
    cells_a_step: int
    """Cells between neighbours of the lattice."""

    def index(self, cell: Cell) -> int:
        """Return where a cell's costs stand in a field over the lattice."""
        ...

    def find_path(
        self, start: Cell, goal: Cell, fields: dict[int, array[float]]
    ) -> list[Cell] | None:
        """Return the cells of the cheapest way, both ends included; None where there is none."""
        ...


def floor_of(cost: Floats, resolution_m: float, radius_m: float) -> SearchFloor:
    """Return what finds ways on a costmap (rows, columns), coarse to fine where it is large."""
    if cost.size >= LARGE_CELLS and BLOCK * resolution_m <= radius_m:
        return CoarseFloor(cost)
    return CellFloor(cost)


class CellFloor:
    """Search all cells at once: exact, and quick up to a home's size."""

    cells_a_step = 1

    def __init__(self, cost: Floats) -> None:
        """Take the costs of cells, shape (rows, columns), infinite where blocked."""
        self.lattice = Lattice.of(cost)

    def index(self, cell: Cell) -> int:
        """Return the flat index of the cell."""
        return self.lattice.index(*cell)

    def find_path(
        self, start: Cell, goal: Cell, fields: dict[int, array[float]]
    ) -> list[Cell] | None:
        """Return the cheapest way; fields of costs to any cells bound it (ALT)."""
        end = self.index(goal)
        known = tuple(fields.values())
        path = find_path(self.lattice, self.index(start), end, fields.get(end), known)
        return None if path is None else [self.lattice.cell(index) for index in path]


class CoarseFloor:
    """Search blocks of cells, then the cells along the way over blocks."""

    cells_a_step = BLOCK

    def __init__(self, cost: Floats) -> None:
        """Take the costs of cells, shape (rows, columns), infinite where blocked."""
        self._cost = cost
        self._blocks = cheapest_of_blocks(cost)
        self.lattice = Lattice.of(self._blocks)

    def index(self, cell: Cell) -> int:
        """Return the flat index of the block that holds the cell."""
        return self.lattice.index(cell[0] // BLOCK, cell[1] // BLOCK)

    def find_path(
        self, start: Cell, goal: Cell, fields: dict[int, array[float]]
    ) -> list[Cell] | None:
        """Return a way that costs 0.3 % more than the cheapest at most, as measured (ADR 0040)."""
        end = self.index(goal)
        known = tuple(fields.values())
        coarse = find_path(self.lattice, self.index(start), end, fields.get(end), known)
        if coarse is None:
            return None
        blocks = [self.lattice.cell(index) for index in coarse]
        for width in CORRIDORS:
            corridor = _Corridor.along(self._cost, self._blocks, blocks, width)
            path = corridor.find_path(start, goal)
            if path is not None:
                return path
        # Two parts that only a block joins: so near the bound of a radius that all cells are asked.
        return CellFloor(self._cost).find_path(start, goal, {})


@dataclass(frozen=True)
class _Corridor:
    """Hold the costs along a way over blocks, cropped to where it lies; blocked beside it."""

    cells: Floats
    blocks: Floats
    first: Cell  # the block at its corner, (column, row)

    @classmethod
    def along(cls, cost: Floats, blocks: Floats, way: Sequence[Cell], width: int) -> _Corridor:
        """Keep what lies within ``width`` blocks of the way."""
        columns, rows = np.asarray(way).T
        left, low = max(0, int(columns.min()) - width), max(0, int(rows.min()) - width)
        right, high = int(columns.max()) + width + 1, int(rows.max()) + width + 1
        near = blocks[low:high, left:right]
        mask = np.zeros(near.shape, np.uint8)
        mask[rows - low, columns - left] = 1
        wide = np.ones((2 * width + 1, 2 * width + 1), np.uint8)
        mask = np.asarray(cv2.dilate(mask, wide), np.uint8)
        cells = cost[low * BLOCK : high * BLOCK, left * BLOCK : right * BLOCK]
        kept = _each_cell(mask, cells.shape) > 0
        infinite = np.float32(np.inf)
        return cls(np.where(kept, cells, infinite), np.where(mask, near, infinite), (left, low))

    def find_path(self, start: Cell, goal: Cell) -> list[Cell] | None:
        """Return the way over cells of the whole floor; None where the corridor holds none."""
        column, row = self.first[0] * BLOCK, self.first[1] * BLOCK
        framed = np.pad(self.cells, 1, constant_values=np.inf)
        # Views, not lists: a list of a large floor's costs takes 32 bytes a cell and a second.
        lattice = Lattice(framed.ravel().data, framed.shape[1])
        estimate = np.pad(self._costs_to(goal), 1, constant_values=np.inf)
        path = find_path(
            lattice,
            lattice.index(start[0] - column, start[1] - row),
            lattice.index(goal[0] - column, goal[1] - row),
            estimate.ravel().data,
        )
        if path is None:
            return None
        return [(x + column, y + row) for x, y in map(lattice.cell, path)]

    def _costs_to(self, goal: Cell) -> Floats:
        """Return an estimate of the cost from each cell to the goal, by the blocks' exact one.

        It is drawn smoothly from block to block: with steps between them A*, which settles each
        cell once, found ways that cost up to 2 % more.
        """
        lattice = Lattice.of(self.blocks)
        end = lattice.index(goal[0] // BLOCK - self.first[0], goal[1] // BLOCK - self.first[1])
        field = np.frombuffer(costs_to(lattice, end), np.float32).reshape(-1, lattice.stride)
        known = np.where(np.isfinite(field), field * BLOCK, _FAR)
        # A blocked block beside a free one is met by the smoothing: it goes on as they do.
        beside = cv2.erode(known, np.ones((3, 3), np.uint8)) + BLOCK * np.float32(np.sqrt(2.0))
        whole = np.where(known < _FAR, known, beside)[1:-1, 1:-1]
        rows, columns = whole.shape
        size = (columns * BLOCK, rows * BLOCK)
        smooth = cv2.resize(whole, size, interpolation=cv2.INTER_LINEAR)
        height, width = self.cells.shape
        # The middle of a block is up to a block's diagonal farther than the cell.
        return np.asarray(np.maximum(smooth[:height, :width] - 1.5 * BLOCK, 0.0), np.float32)


def cheapest_of_blocks(cost: Floats) -> Floats:
    """Return the least cost in each block of a costmap (rows, columns); the last may be cut."""
    rows, columns = -(-cost.shape[0] // BLOCK), -(-cost.shape[1] // BLOCK)
    missing = ((0, rows * BLOCK - cost.shape[0]), (0, columns * BLOCK - cost.shape[1]))
    whole = np.pad(cost, missing, constant_values=np.inf) if np.any(missing) else cost
    return np.asarray(whole.reshape(rows, BLOCK, columns, BLOCK).min(axis=(1, 3)), np.float32)


def _each_cell(blocks: NDArray[np.uint8], shape: tuple[int, ...]) -> NDArray[np.uint8]:
    """Spread a value of each block over its cells, cut to a shape (rows, columns)."""
    spread = np.repeat(np.repeat(blocks, BLOCK, axis=0), BLOCK, axis=1)
    return spread[: shape[0], : shape[1]]
