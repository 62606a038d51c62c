"""Make a hall of 8 x 8 m to look at things in, and put what a camera saw back into space."""

from __future__ import annotations

from math import cos, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.camera import Frame, focal_px
from sim.site import Home
from wire import CameraConfig, Pose2, transform

MIDDLE = Pose2(4.0, 4.0, 0.0)
CAMERA = CameraConfig(x_m=0.0, width_px=96, height_px=72, depth_max_m=20.0, pitch_rad=0.0)
WALL_M = 7.95
"""Inner face of the wall in the east."""


def hall(**parts: Any) -> Home:
    """Return the hall, with furniture, objects and people as in a home.yaml."""
    name = {"en": "hall", "zh": "厅"}
    room = {"name": name, "box": [0.0, 0.0, 8.0, 8.0], "pose": [1.0, 1.0, 0]}
    place = {"name": {"en": "dock", "zh": "充电桩"}, "pose": [1.0, 6.5, 0]}
    home = {
        "version": 1,
        "site": "hall",
        "name": {"en": "house", "zh": "房"},
        "dock": "dock",
        "rooms": {"hall": room},
        "places": {"dock": place},
        **parts,
    }
    return Home.model_validate(home)


def points(frame: Frame, camera: CameraConfig, base_in_map: Pose2) -> NDArray[np.float64]:
    """Return where every pixel's surface lies in ``map``, shape (rows, columns, 3).

    Written apart from the renderer: step from the pixel to camera, base and map.
    """
    rows, columns = frame.depth_m.shape
    u, v = np.meshgrid(np.arange(columns) + 0.5, np.arange(rows) + 0.5)
    ahead = frame.depth_m.astype(float)
    left = (columns / 2 - u) / focal_px(camera) * ahead
    up = (rows / 2 - v) / focal_px(camera) * ahead
    level = cos(camera.pitch_rad) * ahead + sin(camera.pitch_rad) * up
    z = camera.z_m + cos(camera.pitch_rad) * up - sin(camera.pitch_rad) * ahead
    c, s = cos(camera.yaw_rad), sin(camera.yaw_rad)
    x_base = camera.x_m + c * level - s * left
    y_base = camera.y_m + s * level + c * left
    x, y = transform(base_in_map, x_base, y_base)
    return np.stack((x, y, z), axis=2)
