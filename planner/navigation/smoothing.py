"""Straighten a way of cells into few corners, and round those. Knows the costmap; no speeds.

Every piece kept is checked against the costmap cell by cell: shaping never leaves free floor, and
never trades the middle of a door for a shorter line along its jamb.
"""

from __future__ import annotations

from itertools import pairwise
from math import ceil, hypot

import numpy as np
from numpy.typing import NDArray

from planner.navigation.costmap import Costmap

Line = NDArray[np.float64]  # (n, 2) points in ``map`` [m]

SAMPLE_M = 0.02
"""Between samples of a line, under half a cell of 0.05 m: no cell's corner thicker than this."""
COST_SLACK = 1.01
"""A straight line may cost this much more than the cells it replaces: rounding, no more."""
ROUNDS = 40
STEP_M = 0.10


def sample(a: Line, b: Line, step_m: float = SAMPLE_M) -> Line:
    """Return points from a to b, both included, at most ``step_m`` apart."""
    count = max(1, ceil(hypot(b[0] - a[0], b[1] - a[1]) / step_m))
    share = np.arange(count + 1) / count
    return np.asarray(a + share[:, None] * (b - a), np.float64)


def lengths_m(line: Line) -> Line:
    """Return the way from the first point to each point of a line [m]."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])


def price(costmap: Costmap, a: Line, b: Line) -> float:
    """Return the cost of the straight line from a to b [m of open floor]; infinite if blocked."""
    cost = costmap.cost_at(sample(a, b))
    return float(cost.sum()) / len(cost) * hypot(b[0] - a[0], b[1] - a[1])


def is_free(costmap: Costmap, line: Line) -> bool:
    """Tell whether a line through all its points stays on free floor."""
    along_m = lengths_m(line)
    count = ceil(float(along_m[-1]) / SAMPLE_M) + 1
    # The corners are among the samples, so a straight piece is never judged by a cut corner.
    at_m = np.union1d(np.linspace(0.0, along_m[-1], count), along_m)
    points = np.column_stack([np.interp(at_m, along_m, line[:, axis]) for axis in (0, 1)])
    return bool(np.isfinite(costmap.cost_at(points)).all())


def straighten(costmap: Costmap, line: Line) -> Line:
    """Drop every point whose neighbours can be joined straight at no higher cost.

    From each corner the farthest point that can be joined is sought by halving the stretch.
    """
    cost = costmap.cost_at(line).astype(np.float64)
    steps_m = np.hypot(*np.diff(line, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps_m * (cost[:-1] + cost[1:]) / 2)])
    keep, here = [0], 0
    while here < len(line) - 1:
        reach = len(line) - 1 - here
        while reach > 1:
            there = here + reach
            budget = (along[there] - along[here]) * COST_SLACK
            if price(costmap, line[here], line[there]) <= budget:
                break
            reach = reach * 3 // 4 if reach > 4 else reach - 1
        here += reach
        keep.append(here)
    return np.asarray(line[keep], np.float64)


def densify(line: Line, step_m: float = STEP_M) -> Line:
    """Return the line with points at most ``step_m`` apart, its corners among them."""
    pieces = [sample(a, b, step_m)[:-1] for a, b in pairwise(line) if hypot(*(b - a)) > 0]
    return np.concatenate([*pieces, line[-1:]])


def relax(costmap: Costmap, line: Line) -> Line:
    """Round the corners: draw each inner point towards its neighbours' middle while it stays cheap.

    A point moves only if its cost there is no higher than the larger of its neighbours'; the ends
    stay. Falls back to the line as it came where the rounded one would leave free floor.
    """
    rounded, cost = line.copy(), costmap.cost_at(line)
    for _ in range(ROUNDS if len(line) > 2 else 0):
        inner = rounded[1:-1]
        wanted = 0.5 * inner + 0.25 * (rounded[:-2] + rounded[2:])
        new_cost = costmap.cost_at(wanted)
        # A cost that is not lower than both sides and its own would be a push towards a wall.
        cheap = new_cost <= np.maximum(np.maximum(cost[:-2], cost[2:]), cost[1:-1])
        inner[cheap] = wanted[cheap]
        cost[1:-1][cheap] = new_cost[cheap]
    return rounded if is_free(costmap, rounded) else line
