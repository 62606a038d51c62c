"""Project by a pinhole: directions of rays, and the window of a box in space.

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


class CameraView:
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
        windows: list[tuple[slice, slice, float] | None] = [None] * len(boxes)
        seen = (boxes - self.eye) @ self.turn
        nearest, farthest = seen[..., 0].min(axis=1), seen[..., 0].max(axis=1)
        whole = np.flatnonzero(nearest >= NEAR_M)
        for index, window in zip(whole, self._project(seen[whole]), strict=True):
            windows[index] = window
        for index in np.flatnonzero((nearest < NEAR_M) & (farthest > NEAR_M)):
            windows[index] = self._project(_cut(seen[index])[None])[0]
        return windows

    def _project(self, points: Floats) -> list[tuple[slice, slice, float] | None]:
        """Return the window around each of n sets of points that all lie ahead."""
        camera, focal = self.camera, focal_px(self.camera)
        scaled = points[..., 1:] * (-focal / points[..., :1])
        middle = np.array([camera.width_px, camera.height_px]) / 2
        most = (camera.width_px, camera.height_px)
        low = np.clip(scaled.min(axis=1) + middle, 0, most).astype(int).tolist()
        high = np.clip(scaled.max(axis=1) + middle + 1.0, 0, most).astype(int).tolist()
        ahead = points[..., 0].min(axis=1).tolist()
        return [
            (slice(r0, r1), slice(c0, c1), near) if r0 < r1 and c0 < c1 else None
            for (c0, r0), (c1, r1), near in zip(low, high, ahead, strict=True)
        ]


def _cut(box: Floats) -> Floats:
    """Return the corners ahead of a box, and where its edges come out from behind the camera."""
    start, end = box[_EDGES[:, 0]], box[_EDGES[:, 1]]
    cut = (start[:, 0] >= NEAR_M) != (end[:, 0] >= NEAR_M)
    start, end = start[cut], end[cut]
    share = (NEAR_M - start[:, 0]) / (end[:, 0] - start[:, 0])
    return np.vstack((box[box[:, 0] >= NEAR_M], start + share[:, None] * (end - start)))


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
