"""Find people's ways over the floor of a home: shortest ones, never through walls or furniture.

Cells of 0.1 m whose centre keeps a person's radius from every solid and that are joined to the
dock. Distance fields to some spots are made once; a way is then read off one. Knows no robot but a
disc.
"""

from __future__ import annotations

from heapq import heappop, heappush
from math import hypot, inf
from typing import TYPE_CHECKING

import numpy as np

from sim.site.classes import PERSON_RADIUS_M
from sim.site.plan import solids
from sim.site.raster import RESOLUTION_M, draw, mark_near, reachable
from wire import ConfigError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from random import Random

    from sim.site import Home

Cell = tuple[int, int]
Point = tuple[float, float]

STRIDE = 2
CELL_M = STRIDE * RESOLUTION_M
CLEAR_M = PERSON_RADIUS_M + 0.03
"""A straight line between two cells may cut a corner by less than that."""
SPOTS_TRIED = 500
PAST_M = 1.0
"""Who has come so much nearer to where they go is past whoever stood in their way."""
_NEIGHBOURS = tuple(
    (row, column, hypot(row, column) * CELL_M)
    for row in (-1, 0, 1)
    for column in (-1, 0, 1)
    if row or column
)


class WalkingFloor:
    """Hold the cells on which a person's centre may be."""

    def __init__(self, home: Home) -> None:
        """Mark them.

        Raises:
            ConfigError: ``walkers_without_floor``: there is none around the dock.
        """
        grid = draw(home)
        open_cells = ~mark_near(solids(home), grid, CLEAR_M)
        dock = home.places[home.dock].pose
        floor = reachable(open_cells, grid.cell(dock[0], dock[1]))
        self._fine: list[list[bool]] = floor.tolist()
        joined = floor[::STRIDE, ::STRIDE]
        self._x0_m, self._y0_m = grid.x0_m + RESOLUTION_M / 2, grid.y0_m + RESOLUTION_M / 2
        self._open: list[list[bool]] = joined.tolist()
        self._cells = [(int(row), int(column)) for row, column in np.argwhere(joined)]
        if not self._cells:
            text = "walkers find no floor around the dock on which a person could stand"
            raise ConfigError("walkers_without_floor", text)
        self._fields: dict[Cell, dict[Cell, float]] = {}

    def is_open(self, x_m: float, y_m: float) -> bool:
        """Return whether a person's centre may be at a point."""
        row, column = self._cell(x_m, y_m)
        return (
            0 <= row < len(self._open)
            and 0 <= column < len(self._open[0])
            and self._open[row][column]
        )

    def draw_spot(self, random: Random, away: Iterable[tuple[float, float, float]]) -> Point:
        """Draw a point of the floor that is away from points (x, y, least distance) [m].

        Raises:
            ConfigError: ``walkers_without_floor``: there is no such point.
        """
        kept = list(away)
        for _ in range(SPOTS_TRIED):
            x_m, y_m = self._centre(random.choice(self._cells))
            if all(hypot(x_m - x, y_m - y) >= far for x, y, far in kept):
                return x_m, y_m
        raise ConfigError("walkers_without_floor", "no floor is left for a further walker")

    def way(self, start: Point, goal: Point) -> list[Point]:
        """Return the corners of the shortest way; nothing where there is none."""
        field = self._field(self._cell(*goal))
        cell = self._nearest(start)
        cells: list[Cell] = []
        while cell is not None and field.get(cell, inf) > 0.0:
            row, column = cell
            near = [
                (row + r, column + c)
                for r, c, _ in _NEIGHBOURS
                if _may_step(self._open, cell, r, c)
            ]
            cell = min(near, key=lambda one: field.get(one, inf), default=None)
            if cell is None or cell in cells[-2:] or cell not in field:
                return []
            cells.append(cell)
        return self._pull_tight(start, [self._centre(one) for one in cells])

    def way_round(
        self, start: Point, goal: Point, disc: tuple[float, float, float], longer_m: float
    ) -> list[Point]:
        """Return a way that stays out of a disc, at most so much longer; nothing for none.

        A* on cells of half the size, for beside a robot a hand's width decides; its estimate is the
        exact distance where the disc is not, so that it looks at few cells. Once past the disc it
        goes on as everybody does.
        """
        field, began = self._field(self._cell(*goal)), self._nearest(start)
        if began is None or began not in field:
            return []
        first = self._fine_cell(*start)
        most_m, past_m = field[began] + longer_m, max(0.0, field[began] - PAST_M)
        queue: list[tuple[float, float, Cell]] = [(field[began], 0.0, first)]
        came: dict[Cell, Cell] = {}
        cost = {first: 0.0}
        while queue:
            _, gone_m, cell = heappop(queue)
            left_m = self._left_m(field, cell)
            is_past = left_m <= past_m and self._away_m(cell, disc) >= disc[2]
            if is_past or left_m <= 0.0:
                cells = [cell]
                while cell in came:
                    cell = came[cell]
                    cells.append(cell)
                corners = self._pull_tight(
                    start, [self._fine_centre(c) for c in cells[-2::-1]], disc
                )
                return corners + self.way(corners[-1] if corners else start, goal)
            if gone_m > cost[cell]:
                continue
            for r, c, step_m in _NEIGHBOURS:
                further = (cell[0] + r, cell[1] + c)
                if not _may_step(self._fine, cell, r, c) or self._away_m(further, disc) < disc[2]:
                    continue
                new_m, rest_m = gone_m + step_m / STRIDE, self._left_m(field, further)
                if new_m < cost.get(further, inf) and new_m + rest_m <= most_m:
                    cost[further], came[further] = new_m, cell
                    heappush(queue, (new_m + rest_m, new_m, further))
        return []

    def _left_m(self, field: dict[Cell, float], fine: Cell) -> float:
        """Return the distance from the nearest cells of a field, seen from a small cell [m]."""
        row, column = fine[0] // STRIDE, fine[1] // STRIDE
        around = ((row + r, column + c) for r in (0, 1) for c in (0, 1))
        return min(field.get(one, inf) for one in around)

    def _away_m(self, fine: Cell, disc: tuple[float, float, float]) -> float:
        x_m, y_m = self._fine_centre(fine)
        return hypot(x_m - disc[0], y_m - disc[1])

    def prepare(self, goal: Point) -> None:
        """Make the field of a goal now, so that walking there costs no time later."""
        self._field(self._cell(*goal))

    def _field(self, goal: Cell) -> dict[Cell, float]:
        """Return each cell's distance to a goal by steps to eight neighbours (Dijkstra) [m]."""
        known = self._fields.get(goal)
        if known is not None:
            return known
        field: dict[Cell, float] = {}
        queue = [(0.0, goal)]
        best = {goal: 0.0}
        while queue:
            far_m, cell = heappop(queue)
            if cell in field:
                continue
            field[cell] = far_m
            for r, c, step_m in _NEIGHBOURS:
                if _may_step(self._open, cell, r, c):
                    further = (cell[0] + r, cell[1] + c)
                    if far_m + step_m < best.get(further, inf):
                        best[further] = far_m + step_m
                        heappush(queue, (far_m + step_m, further))
        self._fields[goal] = field
        return field

    def _pull_tight(
        self, start: Point, rest: Sequence[Point], disc: tuple[float, float, float] | None = None
    ) -> list[Point]:
        """Return the corners that are left when a way is pulled tight."""
        points = [start, *rest]
        corners: list[Point] = []
        at = 0
        while at < len(points) - 1:
            further = at + 1
            while further + 1 < len(points) and self._sees(points[at], points[further + 1], disc):
                further += 1
            corners.append(points[further])
            at = further
        return corners

    def _sees(self, one: Point, other: Point, disc: tuple[float, float, float] | None) -> bool:
        count = max(1, round(hypot(other[0] - one[0], other[1] - one[1]) / RESOLUTION_M))
        for step in range(1, count + 1):
            share = step / count
            x_m, y_m = one[0] + share * (other[0] - one[0]), one[1] + share * (other[1] - one[1])
            if not (self.is_open(x_m, y_m) if disc is None else self._is_fine(x_m, y_m)):
                return False
            if disc is not None and hypot(x_m - disc[0], y_m - disc[1]) < disc[2]:
                return False
        return True

    def _nearest(self, point: Point) -> Cell | None:
        """Return the open cell of a point, or one beside it."""
        row, column = self._cell(*point)
        around = [(row, column), *((row + r, column + c) for r, c, _ in _NEIGHBOURS)]
        return next((one for one in around if self.is_open(*self._centre(one))), None)

    def _cell(self, x_m: float, y_m: float) -> Cell:
        return round((y_m - self._y0_m) / CELL_M), round((x_m - self._x0_m) / CELL_M)

    def _is_fine(self, x_m: float, y_m: float) -> bool:
        """Return whether a person's centre may be at a point, by the small cells."""
        row, column = self._fine_cell(x_m, y_m)
        rows = self._fine
        return 0 <= row < len(rows) and 0 <= column < len(rows[0]) and rows[row][column]

    def _fine_cell(self, x_m: float, y_m: float) -> Cell:
        return round((y_m - self._y0_m) / RESOLUTION_M), round((x_m - self._x0_m) / RESOLUTION_M)

    def _fine_centre(self, cell: Cell) -> Point:
        return self._x0_m + cell[1] * RESOLUTION_M, self._y0_m + cell[0] * RESOLUTION_M

    def _centre(self, cell: Cell) -> Point:
        return self._x0_m + cell[1] * CELL_M, self._y0_m + cell[0] * CELL_M


def _may_step(cells: list[list[bool]], cell: Cell, row: int, column: int) -> bool:
    """Return whether a step leads to open floor and cuts no corner."""
    r, c = cell
    if not (0 <= r + row < len(cells) and 0 <= c + column < len(cells[0])):
        return False
    return cells[r + row][c + column] and cells[r][c + column] and cells[r + row][c]
