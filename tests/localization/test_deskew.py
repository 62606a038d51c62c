"""A scan that was swept while the robot moved gives the points of one that was not."""

from __future__ import annotations

import numpy as np
import pytest

from localization.deskew import deskew, sweep_s
from localization.odometry_integration import OdometryTrail
from tests.localization.rooms import ROOM, cast, odometry_of, points_of, scan_of
from wire import Pose2, between
from wire.lidar_config import LidarConfig

SWEEP_S, BEAMS = 0.1, 180
BEGAN = Pose2(2.6, 1.7, 0.4)


def at(share: float) -> Pose2:
    """Drive at 0.5 m/s and turn at 1 rad/s, along the chord."""
    return Pose2(BEGAN.x_m + 0.05 * share, BEGAN.y_m, BEGAN.yaw_rad + 0.1 * share)


@pytest.mark.parametrize("clockwise", [False, True])
def test_beams_are_put_where_the_robot_was(clockwise: bool) -> None:
    shares = [beam / (BEAMS - 1) for beam in range(BEAMS)]
    taken = shares[::-1] if clockwise else shares
    swept = tuple(cast(ROOM, at(share))[beam] for beam, share in enumerate(taken))
    trail = OdometryTrail()
    for step in range(6):
        trail.add(odometry_of(step * 0.02, between(at(0.0), at(step / 5))))
    scan = scan_of(swept, 0.0, sweep_s=SWEEP_S).model_copy(update={"clockwise": clockwise})
    assert sweep_s(scan) == pytest.approx(SWEEP_S)
    cloud = deskew(scan, LidarConfig(), trail)
    still = points_of(cast(ROOM, at(1.0)))
    assert cloud.beams == BEAMS
    assert cloud.stamp_s == pytest.approx(SWEEP_S)

    def farthest(points: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
        # Angles differ a little, so that points are compared with the wall, not one by one.
        gaps = np.hypot(*(points[:, None, :] - still[None, :, :]).transpose(2, 0, 1))
        return float(np.percentile(gaps.min(axis=1), 90))

    raw = deskew(scan_of(swept, SWEEP_S), LidarConfig(), trail).points_m
    assert farthest(cloud.points_m) < 0.06
    assert farthest(raw) > 1.2 * farthest(cloud.points_m)


def test_the_lidars_place_counts_and_what_is_no_measurement_does_not() -> None:
    trail = OdometryTrail()
    trail.add(odometry_of(0.0, BEGAN))
    scan = scan_of((1.0, None, 0.05, 8.0, None, None, None, None), 0.0)
    cloud = deskew(scan, LidarConfig(x_m=0.1, y_m=0.2, yaw_rad=np.pi / 2), trail)
    assert cloud.points_m == pytest.approx(np.array([[0.1, 0.2 - 1.0]]))
    assert cloud.beams == 8
