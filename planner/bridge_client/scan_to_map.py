"""Turn a scan into points in ``map``, for routes around what the map doesn't know."""

from __future__ import annotations

from math import cos, sin

from wire import Pose2, Scan, compose
from wire.lidar_config import LidarConfig

FAR_M = 4.0
"""Farther away a pose error of 0.5° already moves a point by a cell."""


def points_in_map(
    scan: Scan, lidar: LidarConfig, robot_in_map: Pose2
) -> tuple[tuple[float, float], ...]:
    """Return the returns within 4 m as points [m]; a beam without a return is no obstacle."""
    lidar_in_map = compose(robot_in_map, Pose2(lidar.x_m, lidar.y_m, lidar.yaw_rad))
    points = []
    for index, range_m in enumerate(scan.ranges_m):
        if range_m is None or not scan.range_min_m <= range_m <= FAR_M:
            continue
        angle = lidar_in_map.yaw_rad + scan.angle_min_rad + index * scan.angle_increment_rad
        points.append(
            (lidar_in_map.x_m + range_m * cos(angle), lidar_in_map.y_m + range_m * sin(angle))
        )
    return tuple(points)
