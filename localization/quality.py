"""Measure how well a scan agrees with the map, and how that trust fades without scans.

The score of a pose is the share of returns within 0.10 m of the map's obstacles, less the share of
beams that pass through an obstacle. People and cartons lower the first, but nothing that moves lets
light through a wall: the second tells a wrong place from a crowded one. It is a count of beams,
never a covariance: Gauss-Newton's Hessian is over-confident wherever it converges.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from localization.scan_matching import thin, to_map

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from localization.distance_field import DistanceField

    Floats = NDArray[np.float64]

NEAR_M = 0.10
"""A return so close to an obstacle of the map is explained by it."""
CLEAR_BEFORE_M = 0.25
"""The last part of a beam may graze the surface that it ends on."""
PASSED_STEP_M = 0.05
PASSED_BEAMS = 120
ENOUGH_SCORE = 0.6
"""To place the robot. At the true pose never below 0.67 beside four unmapped things; at wrong poses
p95 0.31."""
KEPT_SCORE = 0.5
"""To keep a pose that was tracked from scan to scan: a wardrobe that was moved by 0.2 m, with a
person beside it, leaves 0.55 at the true pose, and nothing near it fits better. Below ENOUGH_SCORE
the whole map is asked meanwhile whether the robot is elsewhere: 2 of 40 carried ones kept 0.46."""
POOR_QUALITY = 0.5
"""The bridge holds below it (POSE_LOST)."""
FADING_S, FADING_M = 1.0, 0.5
"""Without an accepted scan quality falls to 0.5 within so many seconds or metres of wheels."""
BLIND_AXIS_M = 10.0
"""Along a corridor that holds nothing: wheels that are 5 % wrong err by 0.5 m in so many metres."""


def scores(
    field: DistanceField, points_m: Floats, lidar_m: tuple[float, float], poses: Floats
) -> Floats:
    """Return the score of each pose, at most 1; 0 where a scan has no returns.

    Args:
        field: of the map.
        points_m: returns in ``base``, shape (n, 2).
        lidar_m: where the lidar is in ``base``.
        poses: shape (poses, 3).
    """
    if not len(points_m):
        return np.zeros(len(poses))
    x_m, y_m = to_map(poses, points_m)
    explained = (field.distance(x_m, y_m) <= NEAR_M).mean(axis=1)
    beams = thin(points_m, PASSED_BEAMS)
    return np.asarray(explained - passed_share(field, beams, lidar_m, poses))


def passed_share(
    field: DistanceField, points_m: Floats, lidar_m: tuple[float, float], poses: Floats
) -> Floats:
    """Return the share of beams that pass through an obstacle of the map, by pose."""
    origin = np.asarray(lidar_m)
    along = points_m - origin
    range_m = np.hypot(along[:, 0], along[:, 1])
    steps_m = np.arange(PASSED_STEP_M, max(range_m.max(), 2 * PASSED_STEP_M), PASSED_STEP_M)
    beam, step = np.nonzero(steps_m[None, :] < range_m[:, None] - CLEAR_BEFORE_M)
    if not len(beam):
        return np.zeros(len(poses))
    way = origin + along[beam] * (steps_m[step] / range_m[beam])[:, None]
    passed = np.empty(len(poses))
    for index in range(len(poses)):  # one pose at a time: all at once would not fit a cache
        x_m, y_m = to_map(poses[index : index + 1], way)
        met = beam[field.is_occupied(x_m[0], y_m[0])]
        passed[index] = len(np.unique(met)) / len(points_m)
    return passed


def quality_of(score: float, unseen_s: float, unseen_m: float, blind_axis_m: float) -> float:
    """Return the quality to publish, in [0, 1]; below 0.5 the bridge holds the robot.

    Args:
        score: of the last accepted scan.
        unseen_s: time since that scan.
        unseen_m: metres of wheels since then.
        blind_axis_m: metres driven along an axis that scans have not held since.
    """
    measured = 1.0 + (score - 1.0) * (1.0 - POOR_QUALITY) / (1.0 - KEPT_SCORE)
    faded = max(unseen_s / FADING_S, unseen_m / FADING_M, blind_axis_m / BLIND_AXIS_M)
    return min(max(min(measured, 1.0 - (1.0 - POOR_QUALITY) * faded), 0.0), 1.0)
