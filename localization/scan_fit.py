"""Find the pose near a predicted one that a scan fits best, and score it.

Gauss-Newton from the prediction; where the robot turned, or the score is doubtful, a correlative
search of the window around it may know better. A scan that fits well also tells how far off the
lidar's ranges are.
"""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from localization.correlative_search import WindowSearch
from localization.jump_law import DECLARED_M
from localization.quality import ENOUGH_SCORE, KEPT_SCORE, scores
from localization.range_scale import RangeScale
from localization.scan_matching import align

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from localization.deskew import PointCloud
    from localization.distance_field import DistanceField
    from localization.pose_fusion import PoseFusion

    Floats = NDArray[np.float64]

DOUBTED_SCORE = 0.8
"""Below it the window around the pose is searched too; homes as mapped give 0.84 and more."""
DOUBT_PAUSE_S = 0.5
"""Between two such searches while the score is enough: among people it stays below for long."""
BETTER, STEP_BETTER, FAR_BETTER = 0.05, 0.10, 0.15
"""By how much a pose must lead: one that the window's search found; one so far from the carried
pose that it must be declared as a jump; one where odometry can't have erred so far. A wardrobe that
was moved by 0.2 m pulls the robot with it by 0.07, and on ice odometry may have erred so far."""

NOTHING = np.zeros((3, 3))
"""What a scan tells of a pose that it was not fitted to."""


class ScanFit(NamedTuple):
    """Hold the pose near a start that a scan fits best."""

    pose: Floats
    """x [m], y [m], yaw [rad] in ``map``."""
    score: float
    free_axis: Floats
    information: Floats
    """Both as :class:`localization.scan_matching.Alignment` has them, of this pose alone."""


class ScanFitter:
    """Fit scans to one map."""

    def __init__(self, field: DistanceField, lidar_m: tuple[float, float]) -> None:
        """Prepare the window's search.

        Args:
            field: of the map.
            lidar_m: where the lidar is in ``base``.
        """
        self._field, self._lidar_m = field, lidar_m
        self._window = WindowSearch.of_field(field)
        self._window_s = -DOUBT_PAUSE_S
        self.range_scale = RangeScale(field, lidar_m)
        """Of the lidar, as the scans so far tell it."""

    def near(
        self, cloud: PointCloud, predicted: Floats, fusion: PoseFusion, *, turned: bool
    ) -> ScanFit:
        """Return what fits a scan best near a prediction.

        Args:
            cloud: the scan's returns.
            predicted: where odometry carried the last pose, shape (3,).
            fusion: of that pose; tells which others odometry may have hidden.
            turned: whether the robot turned so far that Gauss-Newton alone may settle beside it.
        """
        fit = self.align(cloud, predicted, redescending=True)
        if _is_step(predicted, fit.pose) or not fusion.expects(predicted, fit.pose):
            carried = self.score(cloud, predicted)
            if fit.score <= carried + _least_lead(carried, predicted, fit.pose, fusion):
                fit = fit._replace(pose=predicted, score=carried, information=NOTHING)
        doubted = fit.score < DOUBTED_SCORE and cloud.stamp_s - self._window_s >= DOUBT_PAUSE_S
        if turned or doubted or fit.score < KEPT_SCORE:
            self._window_s = cloud.stamp_s
            other = self.align(cloud, self._window.best(cloud.points_m, predicted))
            lead = _least_lead(fit.score, predicted, other.pose, fusion)
            if other.score > fit.score + max(BETTER, lead):
                return other
        if fit.score >= ENOUGH_SCORE and fit.information is not NOTHING:
            self.range_scale.see(cloud.points_m, fit.pose)
        return fit

    def align(self, cloud: PointCloud, start: Floats, *, redescending: bool = False) -> ScanFit:
        """Return where Gauss-Newton ends from a start, shape (3,)."""
        result = align(self._field, cloud.points_m, start[None], redescending=redescending)
        pose = result.poses[0]
        return ScanFit(pose, self.score(cloud, pose), result.free_axis[0], result.information[0])

    def score(self, cloud: PointCloud, pose: Floats) -> float:
        """Return a pose's score, at most 1."""
        return float(scores(self._field, cloud.points_m, self._lidar_m, pose[None])[0])


def _least_lead(score: float, carried: Floats, other: Floats, fusion: PoseFusion) -> float:
    """Return by how much a pose must lead what scores so much near the carried one, to count."""
    if not fusion.expects(carried, other):
        return FAR_BETTER
    return STEP_BETTER if _is_step(carried, other) and score >= KEPT_SCORE else 0.0


def _is_step(carried: Floats, other: Floats) -> bool:
    return hypot(*(other - carried)[:2]) > DECLARED_M
