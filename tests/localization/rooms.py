"""Maps drawn by hand and scans cast in them, for tests of the localizer's parts."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from localization.distance_field import DistanceField
from wire import STILL, Odometry, Pose2, Scan, Twist2

RES_M = 0.05
BEAMS = 180
MAP_ID = "0123456789abcdef"
Boxes = tuple[tuple[float, float, float, float], ...]
ROOM: Boxes = (
    (0.0, 0.0, 6.0, 0.1), (0.0, 3.9, 6.0, 4.0), (0.0, 0.0, 0.1, 4.0), (5.9, 0.0, 6.0, 4.0),
    (1.0, 3.0, 2.2, 4.0), (4.6, 0.0, 6.0, 0.8),
)  # fmt: skip
"""A room of 6 m by 4 m with a cupboard and a sofa: x, y of two corners of each solid."""
CORRIDOR: Boxes = ((0.0, 0.0, 40.0, 0.1), (0.0, 1.5, 40.0, 1.6))
TWINS: Boxes = (
    (0.0, 0.0, 8.0, 0.1), (0.0, 2.9, 8.0, 3.0), (0.0, 0.0, 0.1, 3.0), (3.9, 0.0, 4.1, 3.0),
    (7.9, 0.0, 8.0, 3.0), (0.1, 0.1, 0.9, 0.7), (4.1, 0.1, 4.9, 0.7),
)  # fmt: skip
"""Two rooms, the same to the centimetre, and no door between."""


def field_of(boxes: Boxes, width_m: float, height_m: float) -> DistanceField:
    rows, columns = round(height_m / RES_M), round(width_m / RES_M)
    occupied = np.zeros((rows, columns), bool)
    for x0, y0, x1, y1 in boxes:
        occupied[round(y0 / RES_M) : round(y1 / RES_M), round(x0 / RES_M) : round(x1 / RES_M)] = (
            True
        )
    return DistanceField(occupied, ~occupied, RES_M, (0.0, 0.0))


def cast(
    boxes: Boxes, pose: Pose2, beams: int = BEAMS, far_m: float = 8.0
) -> tuple[float | None, ...]:
    """Return what a lidar at a pose measures to the edges of boxes, to the millimetre.

    A ray enters a box where it has passed the nearer edge of both axes, before a farther one.
    """
    angle = pose.yaw_rad - pi + 2 * pi * np.arange(beams) / beams
    corners = np.array(boxes)[:, None, :]
    with np.errstate(divide="ignore"):
        x_m = (corners[..., 0::2] - pose.x_m) / np.cos(angle)[None, :, None]
        y_m = (corners[..., 1::2] - pose.y_m) / np.sin(angle)[None, :, None]
    enters = np.maximum(x_m.min(axis=2), y_m.min(axis=2))
    leaves = np.minimum(x_m.max(axis=2), y_m.max(axis=2))
    met = np.where((enters < leaves) & (enters > 0.0), enters, np.inf).min(axis=0)
    return tuple(round(m, 3) if m < far_m else None for m in met.tolist())


def points_of(ranges: tuple[float | None, ...]) -> NDArray[np.float64]:
    angles = -pi + 2 * pi * np.arange(len(ranges)) / len(ranges)
    values = np.array(ranges, np.float64)
    points = np.column_stack((values * np.cos(angles), values * np.sin(angles)))
    return np.asarray(points[np.isfinite(values)])


def scan_of(
    ranges: tuple[float | None, ...], stamp_s: float, seq: int = 1, sweep_s: float = 0.0
) -> Scan:
    return Scan(
        boot_id="lidar-1", seq=seq, stamp_s=stamp_s, angle_min_rad=-pi,
        angle_increment_rad=2 * pi / len(ranges), range_min_m=0.12, range_max_m=8.0,
        ranges_m=ranges, time_increment_s=sweep_s / max(1, len(ranges) - 1),
    )  # fmt: skip


def odometry_of(
    stamp_s: float,
    pose: Pose2,
    *,
    odom_id: str = "bridge-1",
    twist: Twist2 = STILL,
    gyro_radps: float | None = None,
) -> Odometry:
    return Odometry(
        odom_id=odom_id, seq=1, stamp_s=stamp_s, base_in_odom=pose, twist=twist,
        yaw_rate_radps=gyro_radps,
    )  # fmt: skip
