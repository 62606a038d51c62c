"""Find the pose near a predicted one that a scan fits best, and score it.

Gauss-Newton from the prediction; where the robot turned, or the score is doubtful, a correlative
search of the window around it may know better.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from localization.correlative_search import WindowSearch
from localization.quality import KEPT_SCORE, scores
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
BETTER, FAR_BETTER = 0.05, 0.15
"""The window's pose counts where its score leads by so much; the second, where odometry can't have
erred so far: a wardrobe that was moved by 0.2 m pulls the robot with it by a lead of 0.07."""

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
        if not fusion.expects(predicted, fit.pose):
            carried = self.score(cloud, predicted)
            if fit.score <= carried + FAR_BETTER:
                fit = fit._replace(pose=predicted, score=carried, information=NOTHING)
        doubted = fit.score < DOUBTED_SCORE and cloud.stamp_s - self._window_s >= DOUBT_PAUSE_S
        if turned or doubted or fit.score < KEPT_SCORE:
            self._window_s = cloud.stamp_s
            other = self.align(cloud, self._window.best(cloud.points_m, predicted))
            lead = BETTER if fusion.expects(predicted, other.pose) else FAR_BETTER
            if other.score > fit.score + lead:
                return other
        return fit

    def align(self, cloud: PointCloud, start: Floats, *, redescending: bool = False) -> ScanFit:
        """Return where Gauss-Newton ends from a start, shape (3,)."""
        result = align(self._field, cloud.points_m, start[None], redescending=redescending)
        pose = result.poses[0]
        return ScanFit(pose, self.score(cloud, pose), result.free_axis[0], result.information[0])

    def score(self, cloud: PointCloud, pose: Floats) -> float:
        """Return a pose's score, at most 1."""
        return float(scores(self._field, cloud.points_m, self._lidar_m, pose[None])[0])
