"""Estimate, while the robot drives, by how much a lidar tells all ranges too long or too short.

A cheap lidar is off by 2 %: 0.08 m at a wall 4 m away, so that a robot near one wall and far from
another is placed where the two errors balance. A scan that fits the map tells, beside its pose, how
far its returns lie before or behind the map's surfaces. What grows with range is the lidar's scale;
what is the same for all surfaces is the map's own (half a cell, as a rule) and is left alone.
Weighted least squares of both over many views, the pose of each eliminated. Pure numpy.
"""

from __future__ import annotations

from math import hypot, radians
from typing import TYPE_CHECKING

import numpy as np

from localization.pose_fusion import BEAMS_A_FACT
from localization.scan_matching import LEAST_VARIANCE_M2, to_map
from wire import wrap

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from localization.distance_field import DistanceField

    Floats = NDArray[np.float64]

NEAR_M = 0.05
"""c of Welsch's loss: a return three times as far from the map's surfaces weighs nothing."""
BEFORE_M = 0.15
"""Before each return: farther than any lidar's error, nearer than most floors are wide."""
LEAST_FACING = -0.3
"""Distance by range of a beam that meets its surface well; grazing ones say little of range."""
PRIOR_OFFSET_M, PRIOR_SCALE = 0.03, 0.015
"""Spread of what maps and lidars have wrong, before any view: a few poor ones change nothing."""
LEAST_ERROR, LARGEST_ERROR = 0.006, 0.03
"""Of the scale. Less is left alone, for the estimate errs by 0.004, and in a hall that held a good
lidar's robot 0.04 m off; more is not a cheap lidar but a wrong map, or a wrong unit."""
KEPT_SHARE = 0.995
"""Of what was known, with each view: the last 200 count, so that a warming lidar is followed."""
NEXT_M, NEXT_RAD = 0.25, radians(20.0)
"""Between two views that count: from one spot one moved chair would count a thousand times."""


class RangeScale:
    """Hold what the views of one lidar in one map have told so far."""

    def __init__(self, field: DistanceField, lidar_m: tuple[float, float]) -> None:
        """Begin with ranges as they are.

        Args:
            field: of the map.
            lidar_m: where the lidar is in ``base``.
        """
        self._field, self._lidar_m = field, np.array([lidar_m])
        self._information = np.diag((PRIOR_OFFSET_M**-2, PRIOR_SCALE**-2))
        self._prior = self._information.copy()
        self._sum = np.zeros(2)
        self._last: Floats | None = None
        self.value = 1.0
        """Told range over true range; 1 where it is off by less than LEAST_ERROR."""

    def see(self, points_m: Floats, pose: Floats) -> None:
        """Take a view that fits the map, if the robot has moved on since the last one.

        Args:
            points_m: returns in ``base``, shape (n, 2), of ranges divided by the value so far.
            pose: of ``base`` in ``map``, shape (3,).
        """
        if self._last is not None:
            x_m, y_m, yaw_rad = pose - self._last
            if hypot(x_m, y_m) < NEXT_M and abs(wrap(yaw_rad)) < NEXT_RAD:
                return
        self._last = pose.copy()
        information, right = self._errors(points_m, pose)
        told = np.array((0.0, self.value - 1.0))  # the points are corrected by it already
        self._information = KEPT_SHARE * self._information + (1.0 - KEPT_SHARE) * self._prior
        self._information += information
        self._sum = KEPT_SHARE * self._sum + right + information @ told
        error = float(np.linalg.solve(self._information, self._sum)[1])
        error = min(max(error, -LARGEST_ERROR), LARGEST_ERROR)
        self.value = 1.0 + error if abs(error) >= LEAST_ERROR else 1.0

    def _errors(self, points_m: Floats, pose: Floats) -> tuple[Floats, Floats]:
        """Return a view's information on offset [m] and scale, and its weighted sum of both.

        Distances are looked up BEFORE_M in front of each return, on the floor side of its surface:
        beyond it the field can't tell a thin wall's front from its back. The normal equations of
        pose, offset and scale, with the pose eliminated (Schur complement): what a shift of the
        robot explains as well says nothing of the lidar.
        """
        lidar_m = np.concatenate(to_map(pose[None], self._lidar_m), axis=0)
        ends_m = np.concatenate(to_map(pose[None], points_m), axis=0)
        ray_m = ends_m - lidar_m
        range_m = np.maximum(np.hypot(*ray_m), 1e-6)
        along = ray_m / range_m
        x_m, y_m = ends_m - BEFORE_M * along
        distance, by_x, by_y = self._field.distance_and_gradient(x_m, y_m)
        by_range = by_x * along[0] + by_y * along[1]
        off_m = distance + BEFORE_M * by_range
        by_yaw = by_y * (x_m - pose[0]) - by_x * (y_m - pose[1])
        jacobian = np.stack((by_x, by_y, by_yaw, np.ones(len(points_m)), by_range * range_m))
        weight = np.exp(-0.5 * (off_m / NEAR_M) ** 2) * (by_range < LEAST_FACING)
        variance_m2 = float(weight @ off_m**2) / max(float(weight.sum()), 1e-9)
        weighted = jacobian * weight / (max(variance_m2, LEAST_VARIANCE_M2) * BEAMS_A_FACT)
        hessian, gradient = weighted @ jacobian.T, weighted @ off_m
        placed = hessian[:3, :3] + 1e-6 * np.eye(3)  # a direction that nothing holds has no inverse
        taken = np.linalg.solve(placed, hessian[:3, 3:]).T
        information: Floats = hessian[3:, 3:] - taken @ hessian[:3, 3:]
        return information, gradient[3:] - taken @ gradient[:3]
