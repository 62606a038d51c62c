"""Align scans with what a few keyframes saw: a distance field of their returns around a point.

The field's cells lie askew to ``map``, by an angle that walls rarely have. Each return counts as
its cell's centre; of a wall along the axes all returns are off to the same side by up to half a
cell, and the first scan of a home stands along its walls: everything after it was 0.035 m off. Of a
wall askew these errors cancel.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import cv2
import numpy as np

from localization.correlative_search import WindowSearch
from localization.distance_field import DistanceField
from localization.mapping.keyframes import pose_after
from localization.quality import NEAR_M, passed_share
from localization.scan_matching import align, to_map

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from localization.mapping.keyframes import Keyframe

    Floats = NDArray[np.float64]

SKEW_RAD = 0.37
CREST_SIGMA_CELLS = 1.5
CREST_SHARE = 0.3
"""Of the densest cell near by; less is the skirt of a wall."""
PASSED_EVERY = 3
"""Of the returns, whose beams are followed: their share is a share still."""


class LocalMap:
    """Hold the returns of some keyframes within a square around a point in ``map``."""

    def __init__(
        self, keyframes: Sequence[Keyframe], centre_m: Floats, reach_m: float, resolution_m: float
    ) -> None:
        """Make the field.

        Args:
            keyframes: whose returns count.
            centre_m: x, y in ``map``.
            reach_m: half the side of the square.
            resolution_m: side of a cell.
        """
        # The field's frame: map turned about the square's centre.
        self._in_map = np.array((centre_m[0], centre_m[1], SKEW_RAD))
        c, s = np.cos(SKEW_RAD), np.sin(SKEW_RAD)
        self._from_map = np.array((-c * centre_m[0] - s * centre_m[1],
                                   s * centre_m[0] - c * centre_m[1], -SKEW_RAD))  # fmt: skip
        cells = 2 * round(reach_m / resolution_m)
        corner_m = -0.5 * cells * resolution_m
        returns = np.zeros(cells * cells, np.float32)
        for keyframe in keyframes:
            pose = pose_after(self._from_map, keyframe.pose)
            x_m, y_m = to_map(pose[None], keyframe.points_m)
            column = np.floor((x_m[0] - corner_m) / resolution_m).astype(np.int64)
            row = np.floor((y_m[0] - corner_m) / resolution_m).astype(np.int64)
            inside = (column >= 0) & (column < cells) & (row >= 0) & (row < cells)
            np.add.at(returns, row[inside] * cells + column[inside], 1.0)
        counts = returns.reshape(cells, cells)
        occupied = counts > 0.0
        self._field = DistanceField(
            occupied, np.zeros_like(occupied), resolution_m, (corner_m, corner_m), crests(counts)
        )
        self._window: WindowSearch | None = None

    def align(self, points_m: Floats, start: Floats) -> tuple[Floats, float, bool]:
        """Return where Gauss-Newton takes a scan, its fit there, and whether an axis is free.

        Args:
            points_m: returns in ``base``, shape (n, 2).
            start: x, y, yaw in ``map``.
        """
        result = align(self._field, points_m, pose_after(self._from_map, start)[None])
        fit = self._near_share(points_m, result.poses)
        return pose_after(self._in_map, result.poses[0]), fit, bool(result.free_axis.any())

    def fit(self, points_m: Floats, pose: Floats) -> float:
        """Return the share of a scan's returns that lie on what was seen, at a pose."""
        return self._near_share(points_m, pose_after(self._from_map, pose)[None])

    def search(
        self, points_m: Floats, around: Floats, window_m: float, window_rad: float
    ) -> Floats:
        """Return the pose of a window around one that correlates best."""
        if self._window is None:
            self._window = WindowSearch.of_field(self._field)
        start = pose_after(self._from_map, around)
        return pose_after(self._in_map, self._window.best(points_m, start, window_m, window_rad))

    def passed_share(self, points_m: Floats, lidar_m: tuple[float, float], pose: Floats) -> float:
        """Return the share of a scan's beams that would pass through what was seen."""
        poses = pose_after(self._from_map, pose)[None]
        return float(passed_share(self._field, points_m[::PASSED_EVERY], lidar_m, poses)[0])

    def _near_share(self, points_m: Floats, poses: Floats) -> float:
        x_m, y_m = to_map(poses, points_m)
        return float((self._field.distance(x_m, y_m) <= NEAR_M).mean())


def crests(counts: NDArray[np.float32]) -> NDArray[np.bool_]:
    """Return the cells along which returns lie densest: of a blurred wall its middle line.

    A lidar whose ranges err by 0.03 m spreads a wall over four cells; from within such a band
    every edge is equally near, and nothing says where across it a scan belongs.

    Args:
        counts: returns in each cell, shape (rows, columns).
    """
    dense = np.asarray(cv2.GaussianBlur(counts, (0, 0), CREST_SIGMA_CELLS), np.float32)
    around = np.asarray(cv2.dilate(dense, np.ones((5, 5), np.uint8)), np.float32)
    wide = counts.shape[1]
    inner = np.zeros(counts.shape, np.bool_)
    inner[1:-1, 1:-1] = True
    index = np.flatnonzero((counts > 0.0) & (dense >= CREST_SHARE * around) & inner)
    flat = dense.ravel()
    here = flat[index]
    best, is_crest = np.zeros(len(index), np.float32), np.zeros(len(index), np.bool_)
    for step, length2 in ((1, 1.0), (wide, 1.0), (wide + 1, 2.0), (wide - 1, 2.0)):
        one, other = flat[index - step], flat[index + step]
        bend = (2.0 * here - one - other) / length2
        sharper = bend > best
        best[sharper] = bend[sharper]
        is_crest[sharper] = ((here >= one) & (here >= other))[sharper]
    lines = np.zeros(counts.size, np.bool_)
    lines[index[is_crest]] = True
    return lines.reshape(counts.shape)
