"""Compute each cell's cost for the robot's centre. Knows the map, the fence and obstacles.

Arrays are (rows, columns) like the map's cells: row 0 is the lowest y. A cell is blocked where the
robot's disc would touch an obstacle or the unknown, or where its centre would leave the fence.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import cv2
import numpy as np
from numpy.typing import NDArray

from maps.cell_array import cell_array
from planner.navigation.raster import distance_m, draw_points, fence_mask
from planner.site import FREE, GridMap, Site
from wire import margins

Floats: TypeAlias = NDArray[np.float32]
Mask: TypeAlias = NDArray[np.bool_]
Points: TypeAlias = Sequence[tuple[float, float]]

MARGIN_M = margins.OBSTACLE_MARGIN_M
FENCE_MARGIN_M = margins.FENCE_MARGIN_M
SOFT_M = 0.40
"""From here on a wall no longer matters."""
SOFT_WEIGHT = 4.0
"""A metre along a wall costs five, so the route goes through the middle of doors and corridors."""
SUSPECT_COST = 8.0
"""A metre through what may still stand there costs so much more: a way that much longer is tried
first."""
EXPLAINED_M = 0.10
EXPLAINED_RAD = 0.02
"""A lidar point this near to a mapped obstacle, and so much more for each metre it is away from the
robot, is that obstacle, seen through two sigma of the pose's error (0.04 m and 1 degree), the
lidar's noise and half a cell. Without it the noise at the jambs would close doors."""
OWN_BODY_M = 0.20
"""A lidar point this near to the robot's centre is inside the robot."""


@dataclass(frozen=True)
class Costmap:
    """Hold clearance and cost for one moment: the map, or the map with the lidar's points."""

    grid: GridMap
    radius_m: float
    occupied: Mask  # obstacles, and the unknown, themselves
    clearance_m: Floats  # from a cell's centre to the nearest edge of an occupied cell
    fence_gap_m: Floats  # from a cell's centre to where the robot's centre may not be
    suspicion: Mask | None = None  # where something may still stand; dear, not blocked

    @cached_property
    def free(self) -> Mask:
        """Return where the robot's centre may be."""
        roomy = self.clearance_m >= self.radius_m + MARGIN_M
        return roomy & (self.fence_gap_m >= FENCE_MARGIN_M)

    @cached_property
    def cost(self) -> Floats:
        """Return the price of a metre through each cell: 1 in the open, infinite where blocked."""
        spare_m = np.minimum(
            self.clearance_m - (self.radius_m + MARGIN_M), self.fence_gap_m - FENCE_MARGIN_M
        )
        nearness = np.clip(1.0 - spare_m / SOFT_M, 0.0, 1.0)
        cost = 1.0 + SOFT_WEIGHT * nearness * nearness
        if self.suspicion is not None:
            gap_m = distance_m(~self.suspicion, self.grid.resolution_m)
            cost = cost + SUSPECT_COST * (gap_m < self.radius_m + MARGIN_M)
        return np.where(self.free, cost, np.inf).astype(np.float32)

    @cached_property
    def labels(self) -> NDArray[np.int32]:
        """Number the connected parts of the free floor; 0 is blocked.

        Four-connected, as the search is: it takes a diagonal only where both sides are free.
        """
        _, labels = cv2.connectedComponents(self.free.astype(np.uint8), connectivity=4)
        return np.asarray(labels, np.int32)

    def cost_at(self, xy_m: NDArray[np.float64]) -> Floats:
        """Return the cost at points (n, 2) of ``map`` [m]; infinite beyond the map."""
        return self._at(self._framed_cost, xy_m)

    def clearance_at(self, xy_m: NDArray[np.float64]) -> Floats:
        """Return the clearance at points (n, 2) of ``map`` [m]; negative beyond the map."""
        return self._at(self._framed_clearance_m, xy_m)

    def fence_gap_at(self, xy_m: NDArray[np.float64]) -> Floats:
        """Return the distance inside the fence at points (n, 2) [m]; negative outside it."""
        return self._at(np.pad(self.fence_gap_m, 1, constant_values=-1.0), xy_m)

    @cached_property
    def _framed_cost(self) -> Floats:
        return np.pad(self.cost, 1, constant_values=np.inf)

    @cached_property
    def _framed_clearance_m(self) -> Floats:
        return np.pad(self.clearance_m, 1, constant_values=-1.0)

    def _at(self, framed: Floats, xy_m: NDArray[np.float64]) -> Floats:
        # Called a thousand times a route: the frame of one cell saves the tests for the edge.
        grid = self.grid
        column = ((xy_m[:, 0] - grid.origin_x_m) / grid.resolution_m + 1.0).astype(np.intp)
        row = ((xy_m[:, 1] - grid.origin_y_m) / grid.resolution_m + 1.0).astype(np.intp)
        np.clip(column, 0, grid.width + 1, out=column)
        np.clip(row, 0, grid.height + 1, out=row)
        return np.asarray(framed[row, column], np.float32)

    def with_cells(self, occupied: Mask, suspicion: Mask | None = None) -> Costmap:
        """Add cells that hold something, and cells that may."""
        if not occupied.any() and (suspicion is None or not suspicion.any()):
            return self
        both = self.occupied | occupied
        clearance_m = distance_m(~both, self.grid.resolution_m)
        gap_m = self.fence_gap_m
        return Costmap(self.grid, self.radius_m, both, clearance_m, gap_m, suspicion)

    def with_obstacles(self, points: Points, robot_xy_m: tuple[float, float]) -> Costmap:
        """Add lidar points [m, in ``map``] that the map does not explain."""
        news = self.find_unexplained(points, robot_xy_m)
        if len(news) == 0:
            return self
        occupied = np.zeros_like(self.occupied)
        draw_points(occupied, self.grid, news)
        return self.with_cells(occupied, self.suspicion)

    def find_unexplained(
        self, points: Points | NDArray[np.float64], robot_xy_m: tuple[float, float]
    ) -> NDArray[np.float64]:
        """Return the points, shape (n, 2), that lie on the map and that it does not explain."""
        seen: NDArray[np.float64] = np.asarray(points, np.float64).reshape(-1, 2)
        column = np.floor((seen[:, 0] - self.grid.origin_x_m) / self.grid.resolution_m)
        row = np.floor((seen[:, 1] - self.grid.origin_y_m) / self.grid.resolution_m)
        # Written as accepting conditions, so that what is not finite is dropped here.
        inside = (column >= 0) & (column < self.grid.width) & (row >= 0) & (row < self.grid.height)
        seen, column, row = seen[inside], column[inside].astype(int), row[inside].astype(int)
        away_m = np.hypot(*(seen - np.asarray(robot_xy_m)).T)
        known = self.clearance_m[row, column] <= EXPLAINED_M + EXPLAINED_RAD * away_m
        return np.asarray(seen[~known & (away_m >= OWN_BODY_M)], np.float64)


def static_costmap(site: Site, radius_m: float) -> Costmap:
    """Make the costmap of a site as mapped, for a robot that is a disc."""
    grid = site.grid
    occupied = cell_array(grid) != FREE
    gap_m = distance_m(fence_mask(site.fence, grid), grid.resolution_m)
    return Costmap(grid, radius_m, occupied, distance_m(~occupied, grid.resolution_m), gap_m)
