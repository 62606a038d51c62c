"""Remember what the lidar saw and the map does not know: marks, clears and fades. Told the time.

Nav2's obstacle layer, with a memory. A return that the map does not explain marks its cell; a beam
that passes a cell twice clears it. What is out of sight fades: soon where it never stood still,
after minutes where it did, and then it is a suspicion, dear to drive through but not forbidden, so
that a robot tries a door again. Ages count from one scan's time to another's: without scans nothing
fades, and nothing drives.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING

import cv2
import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from maps import GridMap
    from planner.navigation.costmap import Costmap
    from wire.geometry import Pose2

Mask = NDArray[np.bool_]
Points = NDArray[np.float64]

MARK_M = 4.0
"""Farther away a pose error of 0.5 degrees already moves a point by a cell."""
SEE_M = 6.0
"""What moves is followed from so far away: half a metre more or less means nothing there."""
CLEAR_M = 3.0
"""So far a beam that did not return clears: black cloth returns nothing either."""
CLEARED_BY = 2
"""Scans in a row that must see through a cell: one alone may be noise."""
SURE_HITS = 2
"""Scans that must mark a cell before it counts: noise that falls into a door closes nothing."""
NEWEST_S = 1.0
"""What was marked so lately is in sight."""
STOOD_S = 2.0
"""What was marked for so long stood there."""
MOVED_FADES_S = 20.0
STOOD_FADES_S = 600.0
SUSPECT_S = 1_800.0
"""A suspicion lasts so long."""


@dataclass(frozen=True, slots=True)
class ScanView:
    """Hold one scan and where the lidar was in ``map``."""

    lidar_in_map: Pose2
    first_rad: float
    step_rad: float
    range_min_m: float
    ranges_m: NDArray[np.float64]
    """NaN where nothing came back."""
    at_s: float
    """On the planner's clock."""


class ObstacleLayer:
    """Hold the memory of one map's cells."""

    def __init__(self, shape: tuple[int, int]) -> None:
        """Begin with nothing seen, for a map of so many rows and columns."""
        self._began_s: float | None = None
        self._last_s = np.full(shape, -np.inf, np.float32)
        """When each cell was last marked, since the first scan."""
        self._first_s = np.zeros(shape, np.float32)
        self._hits = np.zeros(shape, np.uint8)
        self._through = np.zeros(shape, np.uint8)
        self._now_s = 0.0
        self.version = 0
        """Rises with each scan."""

    def observe(self, mapped: Costmap, view: ScanView, movers: Points | None = None) -> Points:
        """Take a scan; return its points that the map does not explain, shape (n, 2) in ``map``.

        Args:
            mapped: the map's own costmap, always the same.
            view: the scan.
            movers: points (m, 2) of things known to move, which leave no mark.
        """
        if self._began_s is None:
            self._began_s = view.at_s
        self._now_s = max(self._now_s, view.at_s - self._began_s)
        self.version += 1
        points, ends = _points_and_ends(view)
        lidar_xy_m = (view.lidar_in_map.x_m, view.lidar_in_map.y_m)
        news = mapped.find_unexplained(points, lidar_xy_m)
        near = news[np.hypot(*(news - lidar_xy_m).T) <= MARK_M]
        self._mark_and_clear(mapped.grid, _leave_out(near, movers), ends, lidar_xy_m)
        return news

    def recall(self, obstacles: Mask, suspicions: Mask) -> None:
        """Begin with what another memory held: it stood there, and is out of sight."""
        both = obstacles | suspicions
        self._hits[both] = SURE_HITS
        self._last_s[both] = np.where(obstacles[both], -2.0 * NEWEST_S, -STOOD_FADES_S - 1.0)
        self._first_s[both] = self._last_s[both] - STOOD_S

    @property
    def obstacles(self) -> Mask:
        """Return the cells that hold something, in sight or remembered."""
        return self._is_sure & (self._age_s <= self._fades_s)

    @property
    def in_sight(self) -> Mask:
        """Return the cells in which something was seen within the last second."""
        return self._is_sure & (self._age_s <= NEWEST_S)

    @property
    def suspicions(self) -> Mask:
        """Return the cells in which something stood so long ago that it may be gone."""
        stood = self._last_s - self._first_s >= STOOD_S
        faded = self._age_s > self._fades_s
        return self._is_sure & stood & faded & (self._age_s <= SUSPECT_S)

    @property
    def _is_sure(self) -> Mask:
        return self._hits >= SURE_HITS

    @property
    def _age_s(self) -> NDArray[np.float32]:
        return np.asarray(np.float32(self._now_s) - self._last_s, np.float32)

    @property
    def _fades_s(self) -> NDArray[np.float32]:
        stood = self._last_s - self._first_s >= STOOD_S
        return np.where(stood, STOOD_FADES_S, MOVED_FADES_S).astype(np.float32)

    def _mark_and_clear(
        self, grid: GridMap, marks: Points, ends: Points, lidar_xy_m: tuple[float, float]
    ) -> None:
        reach = ceil((MARK_M + 0.5) / grid.resolution_m)
        column, row = grid.cell_of(*lidar_xy_m)
        low_row, high_row = max(0, row - reach), min(grid.height, row + reach + 1)
        low_column, high_column = max(0, column - reach), min(grid.width, column + reach + 1)
        if low_row >= high_row or low_column >= high_column:
            return
        window = np.s_[low_row:high_row, low_column:high_column]
        shape = (high_row - low_row, high_column - low_column)
        origin_m = np.array(
            [
                grid.origin_x_m + low_column * grid.resolution_m,
                grid.origin_y_m + low_row * grid.resolution_m,
            ]
        )
        marked = np.zeros(shape, np.bool_)
        cells = np.floor((marks - origin_m) / grid.resolution_m).astype(np.intp)
        inside = ((cells >= 0) & (cells < (shape[1], shape[0]))).all(axis=1)
        marked[cells[inside, 1], cells[inside, 0]] = True
        seen = np.zeros(shape, np.uint8)
        corners = np.round(((ends - origin_m) / grid.resolution_m - 0.5) * 256).astype(np.int32)
        if len(corners) >= 3:
            cv2.fillPoly(seen, [corners], 1, shift=8)
        self._update(window, marked, seen.astype(bool) & ~marked)

    def _update(self, window: tuple[slice, slice], marked: Mask, free: Mask) -> None:
        now_s = np.float32(self._now_s)
        last_s, first_s = self._last_s[window], self._first_s[window]
        hits, through = self._hits[window], self._through[window]
        fresh = marked & (hits == 0)
        first_s[fresh] = now_s
        last_s[marked] = now_s
        hits[marked] = np.minimum(hits[marked] + 1, 250)
        through[marked] = 0
        through[free] = np.minimum(through[free] + 1, 250)
        gone = free & (through >= CLEARED_BY)
        hits[gone] = 0
        last_s[gone] = -np.inf


def _points_and_ends(view: ScanView) -> tuple[Points, Points]:
    """Return where beams returned within SEE_M, and the outline of what all beams saw free."""
    lidar = view.lidar_in_map
    ranges = view.ranges_m
    angles = lidar.yaw_rad + view.first_rad + view.step_rad * np.arange(len(ranges))
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    origin = np.array([lidar.x_m, lidar.y_m])
    returned = (ranges >= view.range_min_m) & (ranges <= SEE_M)
    points = origin + ranges[returned, None] * directions[returned]
    free_m = np.where(ranges <= MARK_M, ranges, np.where(np.isnan(ranges), CLEAR_M, MARK_M))
    ends = origin + free_m[:, None] * directions
    if view.step_rad * len(ranges) < 2.0 * np.pi - 1e-6:
        ends = np.concatenate([[origin], ends])
    return points, ends


def _leave_out(points: Points, others: Points | None, within_m: float = 0.15) -> Points:
    """Return the points that are not near any of the others."""
    if others is None or len(others) == 0 or len(points) == 0:
        return points
    away_m = np.hypot(*(points[:, None, :] - others[None, :, :]).transpose(2, 0, 1))
    return np.asarray(points[away_m.min(axis=1) > within_m], np.float64)
