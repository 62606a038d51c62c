"""Find the cheapest way over a costmap: A* over eight neighbours. Knows cells; no metres, no robot.

A heap in plain Python beats array libraries here (docs/adr/0010-route-search.md): a search touches
few cells, above all where the exact cost to a known goal has been worked out beforehand.
A diagonal is taken only where both cells beside it are free, so no way cuts a blocked corner.
"""

from __future__ import annotations

from array import array
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from heapq import heappop, heappush
from math import inf, sqrt
from typing import cast

import numpy as np
from numpy.typing import NDArray

_SQRT2 = sqrt(2.0)

SLICE = 1000
"""Cells to settle in one go: some 5 ms."""
_GREED = 1.0001
"""Estimates are stretched by this: among the many ways of one cost across open floor the search
then finishes one instead of widening all. What it finds costs at most this much over the best."""


@dataclass(frozen=True)
class Lattice:
    """Hold a costmap as one flat list with a blocked border, the form the search is quickest on."""

    cost: Sequence[float]  # per cell; infinite where blocked
    stride: int  # cells in a row, the border included

    @classmethod
    def of(cls, cost: NDArray[np.float32]) -> Lattice:
        """Flatten a costmap of shape (rows, columns); every cost is at least 1."""
        padded = np.pad(cost.astype(np.float64), 1, constant_values=np.inf)
        return cls(padded.ravel().tolist(), padded.shape[1])

    def index(self, column: int, row: int) -> int:
        """Return the flat index of a cell."""
        return (row + 1) * self.stride + column + 1

    def cell(self, index: int) -> tuple[int, int]:
        """Return (column, row) of a flat index."""
        return index % self.stride - 1, index // self.stride - 1


def find_path(
    lattice: Lattice,
    start: int,
    goal: int,
    to_goal: Sequence[float] | None = None,
    landmarks: Sequence[Sequence[float]] = (),
) -> list[int] | None:
    """Return the cheapest way from start to goal, both included, or None when there is none.

    ``to_goal`` is :func:`costs_to` of the goal on this lattice or on a cheaper one, and makes
    the search expand little more than the way itself. ``landmarks`` are the same of other cells:
    by the triangle inequality the costs to one of them bound the cost between any two cells (ALT,
    Goldberg and Harrelson 2005).
    """
    cost = lattice.cost
    estimate = _estimate(lattice, start, goal, to_goal, landmarks)
    moves = _moves(lattice.stride)
    best, parent, done = {start: 0.0}, {start: start}, set[int]()
    heap = [(_GREED * estimate(start), start)]
    while heap:
        _, cell = heappop(heap)
        if cell == goal:
            return _trace(parent, goal)
        if cell in done:
            continue
        done.add(cell)
        here, so_far = cost[cell], best[cell]
        for step, half, beside, other in moves:
            there = cell + step
            price = cost[there]
            if price < inf and cost[cell + beside] < inf and cost[cell + other] < inf:
                total = so_far + half * (here + price)
                if total < best.get(there, inf):
                    best[there] = total
                    parent[there] = cell
                    heappush(heap, (total + _GREED * estimate(there), there))
    return None


def costs_to(lattice: Lattice, goal: int) -> array[float]:
    """Return the cost from every cell to the goal (Dijkstra); infinite where there is no way."""
    work = costs_in_slices(lattice, goal)
    while True:
        try:
            next(work)
        except StopIteration as done:
            return cast("array[float]", done.value)


def costs_in_slices(lattice: Lattice, goal: int) -> Generator[None, None, array[float]]:
    """Work out :func:`costs_to` a few milliseconds at a time, so that others may come between."""
    cost, moves = lattice.cost, _moves(lattice.stride)
    best = array("d", [inf]) * len(cost)
    best[goal] = 0.0
    heap = [(0.0, goal)]
    while heap:
        yield
        for _ in range(min(SLICE, len(heap))):
            so_far, cell = heappop(heap)
            if so_far > best[cell]:
                continue
            here = cost[cell]
            for step, half, beside, other in moves:
                there = cell + step
                price = cost[there]
                if price < inf and cost[cell + beside] < inf and cost[cell + other] < inf:
                    total = so_far + half * (here + price)
                    if total < best[there]:
                        best[there] = total
                        heappush(heap, (total, there))
    return array("f", best)  # half the memory; rounding is a thousandth of the greed


def _moves(stride: int) -> tuple[tuple[int, float, int, int], ...]:
    """List the eight steps: offset, half its length, and the two cells a diagonal passes beside."""
    straight = tuple((step, 0.5, 0, 0) for step in (1, -1, stride, -stride))
    diagonal = tuple(
        (row + column, _SQRT2 / 2, row, column) for row in (stride, -stride) for column in (1, -1)
    )
    return straight + diagonal


def _estimate(
    lattice: Lattice,
    start: int,
    goal: int,
    to_goal: Sequence[float] | None,
    landmarks: Sequence[Sequence[float]],
) -> Callable[[int], float]:
    if to_goal is not None:
        return to_goal.__getitem__
    stride = lattice.stride
    goal_row, goal_column = divmod(goal, stride)

    def octile(cell: int) -> float:
        """Return the length of the shortest way on an empty floor: never more than the cost."""
        row, column = divmod(cell, stride)
        rows, columns = abs(row - goal_row), abs(column - goal_column)
        return rows + columns - (2.0 - _SQRT2) * min(rows, columns)

    usable = [(field, field[goal]) for field in landmarks if field[start] < inf > field[goal]]
    usable.sort(key=lambda pair: -abs(pair[0][start] - pair[1]))
    if not usable:
        return octile
    first, from_first = usable[0]
    second, from_second = usable[min(1, len(usable) - 1)]
    third, from_third = usable[min(2, len(usable) - 1)]

    def largest_bound(cell: int) -> float:
        """Return the largest of the bounds; all are never more than the cost."""
        return max(
            octile(cell),
            abs(first[cell] - from_first),
            abs(second[cell] - from_second),
            abs(third[cell] - from_third),
        )

    return largest_bound


def _trace(parent: dict[int, int], goal: int) -> list[int]:
    path = [goal]
    while parent[path[-1]] != path[-1]:
        path.append(parent[path[-1]])
    path.reverse()
    return path
