"""Find frontiers: where known floor borders on floor that nobody saw yet, and from where to look.

After Yamauchi (1997). Knows cells and the costmap; no requests, no process. What is thinner than
the gaps between beams is no frontier. A frontier is looked at from the nearest floor that the robot
can stand on with nothing known between the two; it need not be driven onto.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

from maps.beam_gaps import wide_unknown
from maps.cell_array import cell_array
from maps.grid import FREE, OCCUPIED
from planner.navigation.smoothing import sample
from planner.navigation.start_and_goal import Cell

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from maps.grid import GridMap
    from planner.navigation.costmap import Costmap

Point = tuple[float, float]
Mask = NDArray[np.bool_]

SHORTEST_M = 0.5
"""Nothing wider than the robot lies behind less."""
LONGEST_M = 2.5
"""A longer frontier is cut in parts, each looked at by itself: its middle may be far from all."""
VIEW_M = 2.0
"""A frontier is looked at from no farther away than this."""
STRIDE = 7
"""Of so many spots that are about as near to a frontier one is compared."""
REACH_M = 4.0
"""So far a look is counted to reach: most of a room."""
GAIN_WORTH, MOST_GAIN_M2 = 1.0, 4.0
"""Metres of way that a square metre of unknown floor in view is worth, up to so many of them."""
LEAST_GAIN_M2 = 0.5
"""Less behind a frontier is no floor to stand on: a nook beside a cupboard."""
KEEP_M, NEAR_TARGET_M = 3.0, 1.0
"""The frontier that was driven to before stays the choice unless another is so much better; its
middle moves as it comes into view."""
SAME_M = 0.5
"""Frontiers whose middles are nearer to each other than this are one."""
STOOD_M = 0.3
"""From a spot nearer than this to one where the robot stood nothing new is seen."""
SHUT_GAIN_M2 = 2.0
"""More than a nook, behind which a home goes on."""
BEAMS, NEAR_M = 180, 0.25
MOST_VISITS, MOST_TRIES = 2, 2
"""A frontier is looked at so often, and asked for from one spot in vain so often."""


@dataclass(frozen=True, slots=True)
class Frontier:
    """Hold one stretch of border, and the spot from which it is looked at."""

    middle: Point
    """The cell of the border nearest to its mean [m]."""
    length_m: float
    viewpoint: Cell
    stand: Point
    """The middle of the viewpoint [m]."""
    way_m: float
    """Cost of the way there: metres in the open, more beside walls."""
    gain_m2: float
    """Unknown floor that should come into view there."""

    @property
    def score(self) -> float:
        """Return the price of a look at it; the lowest is the best."""
        return self.way_m - GAIN_WORTH * min(self.gain_m2, MOST_GAIN_M2)


class FrontierMemory:
    """Remember what was driven to, so that no frontier is looked at in vain for ever."""

    def __init__(self) -> None:
        self._target: Frontier | None = None
        self._asked_at: Point | None = None
        self._tries = 0
        self._map: GridMap | None = None
        self._visits: list[tuple[Point, Point]] = []
        """Middle of each frontier that was looked at, and from where."""

    def forget(self) -> None:
        """Begin anew: all was explored, and whoever asks again wants another look."""
        self._target, self._tries = None, 0
        self._visits.clear()

    def note_start(self, start: Point, grid: GridMap) -> None:
        """Take where the robot is as it asks where to look, there or on its way; and the map.

        A map that is still the one of the last question shows nothing of what was seen since.
        """
        target, before = self._target, self._asked_at
        stays = before is not None and _away_m(start, before) <= STOOD_M
        self._tries = self._tries + 1 if stays else 0
        self._asked_at = start
        is_drawn, self._map = grid is not self._map, grid
        if target is None:
            return
        arrived = is_drawn and _away_m(start, target.stand) <= STOOD_M
        if arrived or self._tries >= MOST_TRIES:
            self._visits += [(target.middle, target.stand)] * (1 if arrived else MOST_VISITS)
            self._target, self._tries = None, 0

    def choose(self, frontiers: list[Frontier]) -> Frontier | None:
        """Return the frontier to look at next; None: no way leads to one that is left."""
        best = min(
            (one for one in frontiers if not self.is_in_vain(one)),
            key=lambda one: one.score - (KEEP_M if self._is_target(one) else 0.0),
            default=None,
        )
        self._target = best
        return best

    def leaves_out(self, frontiers: list[Frontier]) -> bool:
        """Tell whether frontiers that no way leads to show more than a nook, and were not seen."""
        shut = (one for one in frontiers if one.gain_m2 >= SHUT_GAIN_M2)
        return any(not self.is_in_vain(one) for one in shut)

    def is_in_vain(self, frontier: Frontier) -> bool:
        """Tell whether a look at a frontier shows nothing that was not seen before."""
        looks = sum(_away_m(middle, frontier.middle) <= SAME_M for middle, _ in self._visits)
        stood = any(_away_m(stand, frontier.stand) <= STOOD_M for _, stand in self._visits)
        return stood or looks >= MOST_VISITS

    def _is_target(self, frontier: Frontier) -> bool:
        target = self._target
        return target is not None and _away_m(target.middle, frontier.middle) <= NEAR_TARGET_M


def find_frontiers(
    grid: GridMap, costmap: Costmap, way_m: Callable[[Cell], float]
) -> list[Frontier]:
    """Return the frontiers that can be looked at.

    Args:
        grid: the map as known.
        costmap: of the same cells, with what was seen since.
        way_m: the cost of the way from the robot to a cell; infinite where there is none.
    """
    found = []
    look = _LookModel(grid)
    for cells in _stretches(grid):
        length_m = _length_m(cells, grid.resolution_m)
        if not length_m >= SHORTEST_M:
            continue
        middle = _middle(cells)
        spots = [
            Frontier(
                *(grid.centre_of(*middle), length_m, spot, grid.centre_of(*spot)),
                *(way_m(spot), look.gain_m2(spot)),
            )
            for spot in _viewpoints(grid, costmap, middle, way_m)
        ]
        worth = [spot for spot in spots if spot.gain_m2 >= LEAST_GAIN_M2]
        found += sorted(worth, key=lambda spot: spot.score)[:1]
    return found


class _LookModel:
    """Foresee what a look round from a spot adds to the map."""

    def __init__(self, grid: GridMap) -> None:
        self._wide = wide_unknown(grid)
        walls = (cell_array(grid) == OCCUPIED).astype(np.uint8)
        # Between two returns a wall has holes that no beam goes through.
        self._walls = cv2.dilate(walls, np.ones((3, 3), np.uint8)) > 0
        self._resolution_m = grid.resolution_m
        angles = np.arange(0.0, 2.0 * np.pi, 2.0 * np.pi / BEAMS)
        along = np.arange(1, round(REACH_M / grid.resolution_m) + 1)
        self._columns = np.rint(np.outer(np.cos(angles), along)).astype(np.intp)
        self._rows = np.rint(np.outer(np.sin(angles), along)).astype(np.intp)

    def gain_m2(self, cell: Cell) -> float:
        """Return the unknown floor that no known wall hides from a cell [m2]."""
        rows, columns = self._wide.shape
        column = np.clip(self._columns + cell[0], 0, columns - 1)
        row = np.clip(self._rows + cell[1], 0, rows - 1)
        # Beside the robot a dilated wall hides nothing: it stands there.
        hit = self._walls[row, column]
        hit[:, : round(NEAR_M / self._resolution_m)] = False
        seen = self._wide[row, column] & ~np.logical_or.accumulate(hit, axis=1)
        cells = np.unique(row[seen] * columns + column[seen])
        return len(cells) * self._resolution_m**2


def known_m2(grid: GridMap) -> float:
    """Return how much floor is known [m2]."""
    return float(np.count_nonzero(cell_array(grid) == FREE)) * grid.resolution_m**2


def border_cells(grid: GridMap) -> Mask:
    """Return the free cells beside unknown floor that is wider than the gaps between beams."""
    cross = cv2.getStructuringElement(cv2.MORPH_CROSS, (3, 3))
    beside = cv2.dilate(wide_unknown(grid).astype(np.uint8), cross) > 0
    return np.asarray((cell_array(grid) == FREE) & beside, np.bool_)


def _stretches(grid: GridMap) -> Iterator[NDArray[np.intp]]:
    """Yield the cells (column, row) of each connected border, long ones in parts."""
    border = border_cells(grid)
    # A gap of one cell, where a single beam went, parts no frontier.
    joined = cv2.dilate(border.astype(np.uint8), np.ones((3, 3), np.uint8))
    _, labels = cv2.connectedComponents(joined, connectivity=8)
    rows, columns = np.nonzero(border)
    order = np.argsort(labels[rows, columns], kind="stable")
    cells = np.column_stack([columns, rows])[order]
    ends = np.nonzero(np.diff(labels[rows, columns][order]))[0] + 1
    for part in np.split(cells, ends):
        if len(part):
            yield from _parts(part, grid.resolution_m)


def _parts(cells: NDArray[np.intp], resolution_m: float) -> Iterator[NDArray[np.intp]]:
    """Cut a long border across its longest axis."""
    middle = cells - cells.mean(axis=0)
    axis = np.linalg.svd(middle, full_matrices=False)[2][0] if len(cells) > 1 else np.ones(2)
    along = middle @ axis
    span_m = float(np.ptp(along)) * resolution_m
    count = max(1, ceil(span_m / LONGEST_M))
    place = np.minimum((along - along.min()) * resolution_m / max(span_m, 1e-9) * count, count - 1)
    for number in range(count):
        part = cells[place.astype(np.intp) == number]
        if len(part):
            yield part


def _length_m(cells: NDArray[np.intp], resolution_m: float) -> float:
    """Return a border's extent: the diagonal of the box around it."""
    wide, high = np.ptp(cells, axis=0) + 1
    return float(hypot(wide, high)) * resolution_m


def _middle(cells: NDArray[np.intp]) -> Cell:
    off = np.abs(cells - cells.mean(axis=0)).sum(axis=1)
    column, row = cells[int(np.argmin(off))].tolist()
    return column, row


def _viewpoints(
    grid: GridMap, costmap: Costmap, middle: Cell, way_m: Callable[[Cell], float]
) -> list[Cell]:
    """Return where to stand with nothing known between: nearest to the frontier, to the robot."""
    reach = ceil(VIEW_M / grid.resolution_m)
    left, low = max(0, middle[0] - reach), max(0, middle[1] - reach)
    window = costmap.free[low : middle[1] + reach + 1, left : middle[0] + reach + 1]
    rows, columns = np.nonzero(window)
    rows, columns = rows + low, columns + left
    away_m = np.hypot(columns - middle[0], rows - middle[1]) * grid.resolution_m
    order = np.argsort(away_m, kind="stable")
    near = [(int(columns[at]), int(rows[at])) for at in order if away_m[at] <= VIEW_M]
    joined = [cell for cell in near if way_m(cell) < np.inf]
    by_way = sorted(joined[::STRIDE], key=way_m)
    firsts = (
        next((cell for cell in cells if _is_in_sight(grid, cell, middle)), None)
        for cells in (joined, by_way)
    )
    return [cell for cell in firsts if cell is not None]


def _is_in_sight(grid: GridMap, one: Cell, other: Cell) -> bool:
    line = sample(np.asarray(grid.centre_of(*one)), np.asarray(grid.centre_of(*other)))
    return all(grid.at(x_m, y_m) != OCCUPIED for x_m, y_m in line.tolist())


def _away_m(one: Point, other: Point) -> float:
    return hypot(one[0] - other[0], one[1] - other[1])
