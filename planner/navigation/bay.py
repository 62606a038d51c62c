"""Find where a robot may stand so that somebody who comes towards it can walk past.

Knows the costmap. A person is a disc; whether one can pass is whether the floor that is left with
the robot standing there still joins the person's side with the other.
"""

from __future__ import annotations

from math import ceil, hypot

import cv2
import numpy as np
from numpy.typing import NDArray

from planner.navigation.costmap import Costmap
from planner.navigation.raster import distance_m
from planner.navigation.route import RouteFailure
from planner.navigation.smoothing import sample

Point = tuple[float, float]

REACH_M = 1.2
"""No bay is sought farther away than this."""
STEP_M = 0.05
ROOM_M = 0.08
"""Kept from every wall: nearer, an error of the pose lets the gate shut the way out."""
HUGS_M = 0.14
"""A bay is at a wall: farther from it than this, beside the disc, nothing is gained."""
PERSON_M = (0.36, 0.32, 0.30)
"""Half of the lane that a person needs: 0.25 m, and some room; the most that there is."""
ENOUGH_M = 0.32
"""A robot that leaves so much already stays where it is: it blocks nobody."""
WINDOW_M = 2.5
BEYOND_M = 1.3
"""So far on the other side of the robot a person has passed."""
RIGHT_M = 0.3
"""A bay on the right is taken although it is so much farther: people expect that."""


def find_bay(mapped: Costmap, costmap: Costmap, robot: Point, person: Point) -> Point:
    """Return the centre of the nearest floor on which the robot leaves a person a lane.

    Args:
        mapped: the map alone: the person is free to walk wherever no wall is.
        costmap: with all that is seen: there the robot goes.
        robot: its centre now [m].
        person: the middle of the side that was seen [m].

    Returns the robot's own place where that will do.

    Raises:
        RouteFailure: ``no_route``: there is none within 1.2 m.
    """
    away_m = hypot(person[0] - robot[0], person[1] - robot[1])
    if not away_m > 0.0:
        raise RouteFailure("no_route", "the person stands where the robot does")
    towards = ((person[0] - robot[0]) / away_m, (person[1] - robot[1]) / away_m)
    if _leaves_lane(mapped, robot, robot, towards, ENOUGH_M):
        return robot
    column, row = costmap.grid.cell_of(*robot)
    part = int(costmap.labels[row, column]) if costmap.grid.contains(*robot) else 0
    bays = []
    for x_m, y_m in _candidates(robot, towards):
        if not costmap.grid.contains(x_m, y_m):
            continue
        column, row = costmap.grid.cell_of(x_m, y_m)
        label = int(costmap.labels[row, column])
        joined = label != 0 and (part in (0, label))
        hugs = ROOM_M <= mapped.clearance_m[row, column] - mapped.radius_m <= HUGS_M
        nearer = hypot(person[0] - x_m, person[1] - y_m) < away_m - 0.05
        if joined and hugs and not nearer and _leads_straight(mapped, robot, (x_m, y_m)):
            bays.append((x_m, y_m))
    for lane_m in PERSON_M:
        for bay in bays:
            if _leaves_lane(mapped, bay, robot, towards, lane_m):
                return bay
    raise RouteFailure("no_route", f"no bay within {REACH_M} m")


def _leads_straight(mapped: Costmap, robot: Point, bay: Point) -> bool:
    """Tell whether no wall is between: what lies behind one is reached by driving round it."""
    line = sample(np.asarray(robot), np.asarray(bay))
    return bool((mapped.clearance_at(line) >= mapped.radius_m).all())


def _candidates(robot: Point, towards: Point) -> list[Point]:
    """Return points around the robot, the best first: near, behind it, and on its right."""
    count = ceil(REACH_M / STEP_M)
    found = []
    for i in range(-count, count + 1):
        for j in range(-count, count + 1):
            x_m, y_m = i * STEP_M, j * STEP_M
            gone_m = hypot(x_m, y_m)
            right_m = x_m * towards[1] - y_m * towards[0]
            if gone_m <= REACH_M:
                price = gone_m + (0.0 if right_m >= 0.0 else RIGHT_M)
                found.append((price, robot[0] + x_m, robot[1] + y_m))
    return [(x_m, y_m) for _, x_m, y_m in sorted(found)]


def _leaves_lane(mapped: Costmap, bay: Point, robot: Point, towards: Point, half_m: float) -> bool:
    """Tell whether a person could walk from ahead of the robot to behind it."""
    grid, radius = mapped.grid, mapped.radius_m
    reach = ceil(WINDOW_M / grid.resolution_m)
    column, row = grid.cell_of(*robot)
    left, low = max(0, column - reach), max(0, row - reach)
    floor: NDArray[np.bool_] = ~mapped.occupied[low : row + reach + 1, left : column + reach + 1]
    floor = floor.copy()
    rows, columns = np.indices(floor.shape)
    x_m = grid.origin_x_m + (columns + left + 0.5) * grid.resolution_m
    y_m = grid.origin_y_m + (rows + low + 0.5) * grid.resolution_m
    floor[np.hypot(x_m - bay[0], y_m - bay[1]) <= radius] = False
    roomy = distance_m(floor, grid.resolution_m) >= half_m
    _, labels = cv2.connectedComponents(roomy.astype(np.uint8), connectivity=4)
    along = (x_m - robot[0]) * towards[0] + (y_m - robot[1]) * towards[1]
    away_m = np.hypot(x_m - robot[0], y_m - robot[1])
    ring = (away_m > BEYOND_M - 0.3) & (away_m < BEYOND_M + 0.3)
    ahead, behind = ring & (along > 0.9 * away_m), ring & (along < -0.9 * away_m)
    return bool(set(labels[ahead & roomy].tolist()) & set(labels[behind & roomy].tolist()))
