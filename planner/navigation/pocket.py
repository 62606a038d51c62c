"""Find where a robot may stand so that another one can drive past: a place that cuts nothing off.

Knows the costmap. A bay lets a person squeeze by; what is as wide as a robot needs floor that stays
joined beside the one that stands. So the hallway in front of a door is no pocket, and its end is.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, hypot, pi

import cv2
import numpy as np

from planner.navigation.costmap import MARGIN_M, Costmap
from planner.navigation.route import RouteFailure, RouteRequest
from planner.navigation.start_and_goal import Cell, choose_start
from wire import Pose2

Point = tuple[float, float]

MOST_M = 10.0
"""Of a way's price: five metres along walls and through a door."""
STEP = 3
"""Cells from one candidate to the next."""
ROOM_M = 0.08
"""Kept from every wall, as in a bay."""
LANE_M = 0.06
"""What the other keeps from walls: a centimetre more than its gate needs."""
BESIDE_M = 0.3
"""What both keep from each other: nearer, the gate lets the one who passes creep only."""
WINDOW_M = 3.0
"""Floor that a standing robot cuts in two is cut within sight of it: a way round is no way past."""
CROSSES_M = 0.1
"""A way aside may come so much nearer to the other one."""
EQUAL_M = 0.4
"""Ways aside that differ by less are equally long: chance decides then."""
WIDER_M = 0.1
"""Than this robot, as the tracker draws discs. What is wider still is two that stand side by side:
no hallway would let both of them pass at once, so that any place in one would seem aside."""
SMALL_M2 = 0.3
"""For a robot's middle: a smaller part of the floor leads nowhere."""


def choose_pocket(
    mapped: Costmap,
    costmap: Costmap,
    request: RouteRequest,
    price_from: Callable[[Costmap, Cell], Callable[[Cell], float]],
) -> Point:
    """Return where the robot lets one pass that is as wide as a robot; its own place if it does.

    Law: two that meet know the same of each other. Who has the shorter way aside makes way; asked
    strictly, nobody else does.

    Args:
        mapped: the map alone.
        costmap: with all that is seen: there the robot goes.
        request: from where, for whom: the middle of the side that is seen, and a radius.
        price_from: of the ways from a cell on a costmap.

    Raises:
        RouteFailure: ``no_route``: there is no such place, or the other one is nearer to one.
    """
    robot = (request.start.x_m, request.start.y_m)
    radius_m = min(request.passes_m, mapped.radius_m + WIDER_M)
    other = _middle_of(robot, (request.goal.x_m, request.goal.y_m), radius_m)
    own = _find_pocket(mapped, costmap, robot, other, radius_m, price_from)
    if own is None:
        raise RouteFailure("no_route", "there is no place where the other one could pass")
    if request.strict:
        around = np.linspace(0.0, 2 * pi, 24)
        body = np.stack(
            [robot[0] + radius_m * np.cos(around), robot[1] + radius_m * np.sin(around)]
        )
        seen = mapped.with_obstacles([(x, y) for x, y in body.T.tolist()], other)
        seen = keep_off(seen, other, robot)
        theirs = _find_pocket(mapped, seen, other, robot, mapped.radius_m, price_from)
        if theirs is not None and theirs[1] < own[1] - EQUAL_M:
            raise RouteFailure("no_route", "the other one has the shorter way aside")
    return robot if own[1] <= EQUAL_M else mapped.grid.centre_of(*own[0])


def keep_off(costmap: Costmap, robot: Point, other: Point) -> Costmap:
    """Return the costmap with all closed that is nearer to the other one than the robot is now.

    Who makes way across the other's way meets it there.
    """
    away_m = hypot(robot[0] - other[0], robot[1] - other[1])
    ring_m = away_m - CROSSES_M - costmap.radius_m - MARGIN_M
    if not ring_m > 0.0:
        return costmap
    around = np.linspace(0.0, 2 * pi, max(8, ceil(2 * pi * ring_m / costmap.grid.resolution_m)))
    ring = zip(other[0] + ring_m * np.cos(around), other[1] + ring_m * np.sin(around), strict=True)
    return costmap.with_obstacles([(float(x_m), float(y_m)) for x_m, y_m in ring], robot)


def _middle_of(robot: Point, seen: Point, radius_m: float) -> Point:
    """Return the middle of a disc whose near side is seen."""
    away_m = max(hypot(seen[0] - robot[0], seen[1] - robot[1]), 0.01)
    share = 1.0 + radius_m / 2 / away_m
    return robot[0] + share * (seen[0] - robot[0]), robot[1] + share * (seen[1] - robot[1])


def _find_pocket(
    mapped: Costmap,
    costmap: Costmap,
    robot: Point,
    other: Point,
    radius_m: float,
    price_from: Callable[[Costmap, Cell], Callable[[Cell], float]],
) -> tuple[Cell, float] | None:
    """Return the cell that is cheapest to reach where a robot cuts no floor off, and its price."""
    here = Pose2(*robot, 0.0)
    try:
        price_m = price_from(costmap, choose_start(costmap, RouteRequest(here, here)))
    except RouteFailure:
        return None
    stands = costmap.free & (costmap.clearance_m >= costmap.radius_m + ROOM_M)
    rows, columns = np.nonzero(stands[::STEP, ::STEP])
    cells = zip((columns * STEP).tolist(), (rows * STEP).tolist(), strict=True)
    size_m, there = mapped.grid.resolution_m, mapped.grid.cell_of(*other)
    near = (mapped.radius_m + radius_m + BESIDE_M) / size_m
    priced = sorted(
        (price, cell)
        for cell in cells
        if (price := price_m(cell)) <= MOST_M
        and hypot(cell[0] - there[0], cell[1] - there[1]) > near
    )
    for price, cell in priced:
        if not _cuts_off(mapped, cell, radius_m):
            return cell, price
    return None


def _cuts_off(mapped: Costmap, cell: Cell, radius_m: float) -> bool:
    """Tell whether a robot that stands there parts floor on which another one drives."""
    size_m, (column, row) = mapped.grid.resolution_m, cell
    reach = ceil(WINDOW_M / size_m)
    left, low = max(0, column - reach), max(0, row - reach)
    window = np.s_[low : row + reach + 1, left : column + reach + 1]
    roomy = (mapped.clearance_m[window] >= radius_m + LANE_M) & (mapped.fence_gap_m[window] > 0.0)
    rows, columns = np.indices(roomy.shape)
    away_m = size_m * np.hypot(columns + left - column, rows + low - row)
    rest = roomy & (away_m > mapped.radius_m + radius_m + BESIDE_M)
    _, before = cv2.connectedComponents(roomy.astype(np.uint8), connectivity=4)
    _, after = cv2.connectedComponents(rest.astype(np.uint8), connectivity=4)
    for part in set(before[roomy & ~rest].tolist()):
        cells = np.sort(np.bincount(after[rest & (before == part)]))
        if size_m**2 * cells[:-1].sum() > SMALL_M2:
            return True
    return False
