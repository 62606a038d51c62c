"""Be the pinhole: where rays go, and which part of the picture a box in space can cover.

Axes of the camera: x ahead along the optical axis, y left, z up. Knows mathematics only.
"""

from __future__ import annotations

from math import cos, sin, tan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from wire import compose
from wire.geometry import Pose2

if TYPE_CHECKING:
    from wire import CameraConfig

Floats = NDArray[np.float64]
NEAR_M = 0.02
_EDGES = np.array([(i, i | bit) for i in range(8) for bit in (1, 2, 4) if not i & bit])
"""Pairs of a box's corners that differ in one coordinate."""


def focal_px(camera: CameraConfig) -> float:
    """Return the focal length [px]: half the picture's width over the tangent of half the view."""
    return camera.width_px / 2 / tan(camera.fov_rad / 2)


class View:
    """Hold where a camera is and looks, in ``map``."""

    def __init__(self, camera: CameraConfig, base_in_map: Pose2) -> None:
        on_floor = compose(base_in_map, Pose2(camera.x_m, camera.y_m, camera.yaw_rad))
        self.camera = camera
        self.eye: Floats = np.array([on_floor.x_m, on_floor.y_m, camera.z_m])
        self.turn: Floats = _turn(on_floor.yaw_rad, camera.pitch_rad)
        """Takes the camera's axes to ``map``."""

    def windows(self, boxes: Floats) -> list[tuple[slice, slice, float] | None]:
        """Return rows and columns that each box can cover, and how far ahead it begins [m].

        Args:
            boxes: corners in ``map``, shape (n, 8, 3).

        Returns:
            None for a box that lies outside the picture.
        """
        seen = (boxes - self.eye) @ self.turn
        windows: list[tuple[slice, slice, float] | None] = [None] * len(boxes)
        for index in np.flatnonzero(seen[..., 0].max(axis=1) > NEAR_M):
            windows[index] = self._window(seen[index])
        return windows

    def _window(self, box: Floats) -> tuple[slice, slice, float] | None:
        points = box[box[:, 0] >= NEAR_M]
        if len(points) < len(box):  # partly behind: cut its edges where the picture begins
            start, end = box[_EDGES[:, 0]], box[_EDGES[:, 1]]
            cut = (start[:, 0] >= NEAR_M) != (end[:, 0] >= NEAR_M)
            start, end = start[cut], end[cut]
            share = (NEAR_M - start[:, 0]) / (end[:, 0] - start[:, 0])
            points = np.vstack((points, start + share[:, None] * (end - start)))
        camera, focal = self.camera, focal_px(self.camera)
        u = camera.width_px / 2 - focal * points[:, 1] / points[:, 0]
        v = camera.height_px / 2 - focal * points[:, 2] / points[:, 0]
        column = (_inside(u.min(), camera.width_px), _inside(u.max() + 1.0, camera.width_px))
        row = (_inside(v.min(), camera.height_px), _inside(v.max() + 1.0, camera.height_px))
        if column[0] >= column[1] or row[0] >= row[1]:
            return None
        return slice(*row), slice(*column), float(points[:, 0].min())


def _inside(value: float, size: int) -> int:
    return int(min(max(value, 0.0), float(size)))


def rays(camera: CameraConfig) -> Floats:
    """Return unit vectors through all pixels' centres in camera axes, shape (rows, columns, 3)."""
    focal = focal_px(camera)
    aimed = np.ones((camera.height_px, camera.width_px, 3))
    aimed[..., 1] = (camera.width_px / 2 - 0.5 - np.arange(camera.width_px)) / focal
    aimed[..., 2] = ((camera.height_px / 2 - 0.5 - np.arange(camera.height_px)) / focal)[:, None]
    aimed /= np.linalg.norm(aimed, axis=2, keepdims=True)
    return aimed


def _turn(yaw_rad: float, pitch_rad: float) -> Floats:
    """Return the rotation from the camera's axes to ``map``; a positive pitch looks down."""
    cy, sy, cp, sp = cos(yaw_rad), sin(yaw_rad), cos(pitch_rad), sin(pitch_rad)
    return np.array([[cy * cp, -sy, cy * sp], [sy * cp, cy, sy * sp], [-sp, 0.0, cp]])
