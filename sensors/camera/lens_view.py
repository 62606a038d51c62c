"""Compare what a camera sees at two moments: what came in and where, how much a cover takes.

Works on small grey grids of some pictures each, whose median has no passing noise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import cv2
import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from sensors.camera.shot import CameraShot

    Floats = NDArray[np.float64]

_GRID = (64, 48)
"""Columns and rows."""
_CHANGED, _TIMES_NOISE = 20.0, 4.0
"""A cell changed by so many greys of 255, and by so many times its own noise."""


@dataclass(frozen=True, slots=True)
class LensView:
    """Hold what a camera sees at a moment."""

    size: tuple[int, int]
    """Width and height of its pictures."""
    _grey: Floats
    _noise: Floats

    @classmethod
    def of_shots(cls, shots: Sequence[CameraShot]) -> LensView:
        """Return the view of some pictures, at least one, taken one after the other."""
        grids = np.stack([_grid_of(shot) for shot in shots])
        height, width = shots[0].color.shape[:2]
        return cls((width, height), np.median(grids, axis=0), grids.std(axis=0))

    @property
    def light(self) -> float:
        """Return the mean grey, of 255."""
        return float(self._grey.mean())

    def find_change(self, now: LensView) -> tuple[float, float]:
        """Return the share of a later view that changed, and where: -1 left, 1 right.

        By how much the camera has changed its exposure meanwhile, most of the picture tells.
        """
        gain = float(np.median(now._grey / np.maximum(self._grey, 1.0)))
        off = np.abs(now._grey - gain * self._grey)
        changed = off > np.maximum(_CHANGED, _TIMES_NOISE * self._noise)
        if not changed.any():
            return 0.0, 0.0
        column = float(np.median(np.nonzero(changed)[1]))
        return float(changed.mean()), column / (_GRID[0] - 1) * 2.0 - 1.0

    def let_through(self, now: LensView) -> tuple[float, float]:
        """Return the shares of light and of detail that a later view has left."""
        light, detail = max(self.light, 1.0), max(_detail(self._grey), 1e-9)
        return now.light / light, _detail(now._grey) / detail


def _grid_of(shot: CameraShot) -> Floats:
    grey = cv2.cvtColor(shot.color, cv2.COLOR_BGR2GRAY)
    return np.asarray(cv2.resize(grey, _GRID, interpolation=cv2.INTER_AREA), np.float64)


def _detail(grid: Floats) -> float:
    smooth = cv2.GaussianBlur(grid, (5, 5), 0.0)
    return float(np.abs(np.diff(smooth, axis=0)).mean() + np.abs(np.diff(smooth, axis=1)).mean())
