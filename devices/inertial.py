"""Turn a gyro's readings into the robot's axes, and take away what it says at a standstill.

Knows numbers alone. A gyro of silicon says some hundredths of a radian a second while it stands,
and that creeps with its temperature: it is learnt whenever nothing turns.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from math import isfinite
from typing import Final

Vector = tuple[float, float, float]

WINDOW_S: Final = 1.0
FEWEST: Final = 10
"""Readings of a window; a base that reports 20 times a second gives 20."""
GAP_S: Final = 0.25
"""Between two readings; after a longer one a window begins anew."""
SPREAD_RADPS: Final = 0.05
"""Largest less smallest of a window: noise of 0.005 rad/s stays within, a hand does not."""
MOST_RADPS: Final = 0.4
"""What a gyro may say standing: an MPU-6050's data sheet allows 20 degrees a second."""
CREEP_RADPS: Final = 0.03
"""From one standstill to the next; an MPU-6050 creeps by 0.3 rad/s from -40 to 85 degrees."""
UNSURE_CREEP_RADPS: Final = 0.005
"""The same where a standstill is guessed: an even turn could pass for one."""
AGREE_RADPS: Final = 0.01
SURE_WINDOWS: Final = 4
"""So many windows in a row that agree outweigh a bias that was learnt otherwise: a robot that was
turned evenly while it started."""

_G_MPS2: Final = 9.80665


def mps2_of(g: float) -> float:
    """Return an acceleration told in g [m/s2]."""
    return g * _G_MPS2


@dataclass(frozen=True, slots=True)
class InertialReading:
    """Hold one reading, in the sensor's axes."""

    gyro_radps: Vector
    accel_mps2: Vector


class Mounting:
    """Turn vectors from the sensor's axes into the robot's: x forward, y left, z up."""

    def __init__(self, up: str, forward: str) -> None:
        """Set which axes of the sensor (``x``, ``-y``) point up and forward.

        Raises:
            ValueError: both lie along one axis.
        """
        self._up, self._forward = _unit(up), _unit(forward)
        self._left = _cross(self._up, self._forward)
        if self._left == (0.0, 0.0, 0.0):
            raise ValueError(f"up {up!r} and forward {forward!r} lie along one axis")

    def turn(self, vector: Vector) -> Vector:
        """Return a vector in the robot's axes."""
        return _dot(self._forward, vector), _dot(self._left, vector), _dot(self._up, vector)


class StandingBias:
    """Learn what a gyro says while nothing turns, and take it away."""

    def __init__(self, *, is_sure_of_standing: bool) -> None:
        """Begin to learn.

        Args:
            is_sure_of_standing: whoever says "standing" has seen the wheels; else it was guessed
                from the gyro itself, and an even turn could be taken for a standstill: then what
                was learnt first is never thrown away.
        """
        self._is_sure = is_sure_of_standing
        self._creep_radps = CREEP_RADPS if is_sure_of_standing else UNSURE_CREEP_RADPS
        self._window: deque[tuple[float, float]] = deque()
        self._others: deque[float] = deque(maxlen=SURE_WINDOWS)
        self.bias_radps: float | None = None

    def correct(self, rate_radps: float, at_s: float, *, stands: bool) -> float | None:
        """Take a reading; return it without the bias, None until that is known or if it is NaN."""
        if not isfinite(rate_radps):
            self._window.clear()
            return None
        if not stands or (self._window and not 0.0 < at_s - self._window[-1][0] <= GAP_S):
            self._window.clear()
        if stands:
            self._window.append((at_s, rate_radps))
            if at_s - self._window[0][0] >= WINDOW_S:
                self._learn([rate for _, rate in self._window])
                self._window.clear()
        return None if self.bias_radps is None else rate_radps - self.bias_radps

    def _learn(self, rates: list[float]) -> None:
        mean = sum(rates) / len(rates)
        is_steady = len(rates) >= FEWEST and max(rates) - min(rates) <= SPREAD_RADPS
        if not (is_steady and abs(mean) <= MOST_RADPS):
            self._others.clear()
            return
        if self.bias_radps is None:
            self.bias_radps = mean
        elif abs(mean - self.bias_radps) <= self._creep_radps:
            self.bias_radps += (mean - self.bias_radps) / 2.0
            self._others.clear()
        elif self._is_sure:
            self._others.append(mean)
            agree = max(self._others) - min(self._others) <= AGREE_RADPS
            if len(self._others) == SURE_WINDOWS and agree:
                self.bias_radps = mean
                self._others.clear()


def _unit(axis: str) -> Vector:
    sign = -1.0 if axis.startswith("-") else 1.0
    x, y, z = (sign if axis.strip("-") == name else 0.0 for name in "xyz")
    return x, y, z


def _dot(a: Vector, b: Vector) -> float:
    # By hand: a sum over a generator takes three times as long, and a zero times NaN is NaN.
    return sum(x * y for x, y in zip(a, b, strict=True) if x)


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
