"""Lay a straight way along the robot's heading, ahead or backwards, as far as floor is free.

Knows the costmap and no search: what stands in the way ends the line, nothing is gone round. Where
it ends short of the goal the caller judges by the distance that is left.
"""

from __future__ import annotations

from math import cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

from planner.navigation.costmap import Costmap
from planner.navigation.route import RouteFailure, RouteRequest
from planner.navigation.smoothing import Line, sample
from planner.navigation.waypoints import MIN_END_GAP_M, evenly

BACK_MPS = 0.2
"""Backwards nobody looks where the robot goes; the bridge watches, but people do not expect it."""


def straight_line(costmap: Costmap, request: RouteRequest) -> Line:
    """Return evenly spaced points from the start towards the goal, up to where floor ends.

    A robot that stands nearer to something than the map allows may leave it straight, but never
    comes nearer to it. A single point: there is no room at all, or no way to go.

    Raises:
        RouteFailure: ``start_outside_map``.
    """
    grid = costmap.grid
    start_m = np.asarray((request.start.x_m, request.start.y_m))
    goal_m = np.asarray((request.goal.x_m, request.goal.y_m))
    if not grid.contains(*start_m.tolist()):
        raise RouteFailure("start_outside_map", f"({start_m[0]:.2f}, {start_m[1]:.2f})")
    line = sample(start_m, goal_m)
    free = _passable(costmap, line)
    last = int(np.argmin(free)) - 1 if not free.all() else len(line) - 1
    end_m = line[max(0, last)]
    if hypot(*(end_m - start_m)) < MIN_END_GAP_M:
        return start_m[None, :]
    return evenly(np.stack([start_m, end_m]))


def backwards(request: RouteRequest) -> bool:
    """Tell whether the goal lies behind the robot."""
    dx, dy = request.goal.x_m - request.start.x_m, request.goal.y_m - request.start.y_m
    return dx * cos(request.start.yaw_rad) + dy * sin(request.start.yaw_rad) < 0.0


def _passable(costmap: Costmap, line: Line) -> NDArray[np.bool_]:
    """Say of each point whether the robot's centre may be there; the first always may."""
    free: NDArray[np.bool_] = np.isfinite(costmap.cost_at(line))
    if free[0]:
        return free
    inside = costmap.fence_gap_at(line) > 0.0
    clearance_m = costmap.clearance_at(line)
    # One cell of tolerance, as for any way out: clearance is known per cell.
    leaving = clearance_m >= max(0.0, float(clearance_m[0]) - costmap.grid.resolution_m)
    out = int(np.argmax(free)) if free.any() else len(line)
    free[:out] = leaving[:out] & (inside[:out] | ~inside[0])
    return free
