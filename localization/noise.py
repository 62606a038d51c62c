"""Simulate a localizer's error: correlated in time, never jumping. Pure; seeded.

An Ornstein-Uhlenbeck process, stepped exactly: x' = x e^(-dt/T) + s sqrt(1 - e^(-2 dt/T)) n.
Its law is continuity: time that passed unseen counts for at most ``LONGEST_STEP_S``, so that a gap
cannot turn into a jump that the bridge would have to take for a kidnapping.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, radians, sqrt

import numpy as np

from wire import Pose2, wrap

LONGEST_STEP_S = 0.1
"""At 0.02 m and 5 s this moves one axis by 4 mm (one standard deviation)."""

BLOCK = 100


@dataclass(frozen=True, slots=True)
class NoiseParams:
    """State the error's size (one standard deviation per axis) and how long it lasts."""

    position_m: float = 0.02
    yaw_rad: float = radians(0.5)
    time_constant_s: float = 5.0


class PoseNoise:
    """Hold one wandering error in x, y and yaw of ``map``."""

    def __init__(self, seed: int, params: NoiseParams | None = None) -> None:
        self._params = params or NoiseParams()
        self._random = np.random.default_rng(seed)
        self._sigmas = (self._params.position_m, self._params.position_m, self._params.yaw_rad)
        self._drawn: list[list[float]] = []
        # Begin as it will go on: drawn from the process's own spread.
        dx, dy, turn = self._draw()
        x, y, yaw = self._sigmas
        self._error = (x * dx, y * dy, yaw * turn)

    def advance(self, elapsed_s: float) -> None:
        """Advance the error by a time, bounded so that the error stays continuous."""
        step_s = min(max(elapsed_s, 0.0), LONGEST_STEP_S)
        kept = exp(-step_s / self._params.time_constant_s)
        fresh = sqrt(1.0 - kept * kept)
        dx, dy, turn = self._draw()
        (x, y, yaw), (x_m, y_m, yaw_rad) = self._sigmas, self._error
        self._error = (
            kept * x_m + fresh * x * dx,
            kept * y_m + fresh * y * dy,
            kept * yaw_rad + fresh * yaw * turn,
        )

    def _draw(self) -> list[float]:
        """Return three normal numbers, drawn by the block: one call costs 10 us."""
        if not self._drawn:
            self._drawn = self._random.standard_normal((BLOCK, 3))[::-1].tolist()
        return self._drawn.pop()

    def disturb(self, truth: Pose2) -> Pose2:
        """Return the pose as a localizer with this error would give it."""
        x_m, y_m, yaw_rad = self._error
        return Pose2(truth.x_m + x_m, truth.y_m + y_m, wrap(truth.yaw_rad + yaw_rad))
