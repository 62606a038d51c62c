"""Carry the robot's pose between scans by wheels and gyro, and know where it was at any instant.

Wheels give the way, the gyro the turn, once its bias has been seen at a standstill: wheels that
slip turn the robot in odometry alone. Where there is no gyro, or an implausible one, wheels count
for both. The frame is this process's own; the bridge's ``odom`` is kept beside it.
"""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wire import IDENTITY, Pose2, between, compose, wrap

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from wire import Odometry

    Floats = NDArray[np.float64]

KEPT = 256
"""Readings kept: 5 s at 50 Hz, far more than a scan is ever late."""
GAP_S = 0.25
"""Between readings farther apart nobody knows how the robot turned; wheels are believed."""
STILL_MPS, STILL_RADPS = 0.005, 0.01
SETTLED_S = 0.3
"""A robot has stopped rocking after so long without a turn of its wheels."""
BIAS_READINGS = 20
"""Of a standstill, 0.4 s at 50 Hz, before a bias counts; noise of 0.003 rad/s is 0.0007 then."""
BIAS_MEMORY = 200
MAX_BIAS_RADPS = 0.05
"""A standing gyro that says more is turned by hand, or broken."""


class MotionSample(NamedTuple):
    """Hold one reading."""

    stamp_s: float
    base_in_odom: Pose2
    carried: Pose2
    """``base`` in this process's frame, by wheels and gyro."""
    travelled_m: float
    """Path length of the wheels since start."""
    slip_rad: float
    """Sum of the differences between the turns of wheels and gyro, without sign."""


class GyroBias:
    """Learn what the gyro says when the robot stands."""

    def __init__(self) -> None:
        self._bias_radps = 0.0
        self._readings = 0
        self._still_since_s: float | None = None

    def correct(self, odometry: Odometry) -> float | None:
        """Take a reading; return the rate of turn without bias, None while that is unknown."""
        rate_radps = odometry.yaw_rate_radps
        if rate_radps is None:
            return None
        twist = odometry.twist
        if abs(twist.v_mps) > STILL_MPS or abs(twist.w_radps) > STILL_RADPS:
            self._still_since_s = None
        elif self._still_since_s is None:
            self._still_since_s = odometry.stamp_s
        elif odometry.stamp_s - self._still_since_s >= SETTLED_S:
            self._learn(rate_radps)
        return rate_radps - self._bias_radps if self._readings >= BIAS_READINGS else None

    def _learn(self, rate_radps: float) -> None:
        if abs(rate_radps) <= MAX_BIAS_RADPS:
            self._readings += 1
            weight = 1.0 / min(self._readings, BIAS_MEMORY)
            self._bias_radps += weight * (rate_radps - self._bias_radps)


class OdometryTrail:
    """Keep the last readings of one odometry."""

    def __init__(self) -> None:
        self._samples: deque[MotionSample] = deque(maxlen=KEPT)
        self._bias = GyroBias()
        self._arrays: tuple[Floats, Floats] | None = None

    @property
    def newest(self) -> MotionSample | None:
        """Return the newest reading; None while there is none."""
        return self._samples[-1] if self._samples else None

    def clear(self) -> None:
        """Forget all readings: another odometry's frame does not join on. The bias stays."""
        self._samples.clear()
        self._arrays = None

    def add(self, odometry: Odometry) -> None:
        """Take a reading; one that is not newer than the last is ignored."""
        rate_radps = self._bias.correct(odometry)
        last = self.newest
        if last is None:
            sample = MotionSample(odometry.stamp_s, odometry.base_in_odom, IDENTITY, 0.0, 0.0)
        elif odometry.stamp_s > last.stamp_s:
            sample = _follow(last, odometry, rate_radps)
        else:
            return
        self._samples.append(sample)
        self._arrays = None

    def covers(self, from_s: float, to_s: float) -> bool:
        """Return whether readings exist from before one instant to after another."""
        return bool(self._samples) and (
            self._samples[0].stamp_s <= from_s and to_s <= self._samples[-1].stamp_s
        )

    def carried_at(self, stamps_s: Floats) -> Floats:
        """Return the interpolated poses at instants that :meth:`covers`, shape (n, 3)."""
        if self._arrays is None:
            stamps = np.array([sample.stamp_s for sample in self._samples])
            poses = np.array(
                [(at.carried.x_m, at.carried.y_m, at.carried.yaw_rad) for at in self._samples]
            )
            poses[:, 2] = np.unwrap(poses[:, 2])
            self._arrays = stamps, poses
        stamps, poses = self._arrays
        return np.column_stack([np.interp(stamps_s, stamps, poses[:, i]) for i in range(3)])

    def at(self, stamp_s: float) -> Pose2:
        """Return the interpolated pose at an instant that :meth:`covers`."""
        x_m, y_m, yaw = self.carried_at(np.array([stamp_s]))[0].tolist()
        return Pose2(x_m, y_m, wrap(yaw))

    def counters_at(self, stamp_s: float) -> tuple[float, float]:
        """Return metres of wheels and sum of slip at the first reading from an instant on."""
        for sample in reversed(self._samples):
            if sample.stamp_s <= stamp_s:
                return sample.travelled_m, sample.slip_rad
        return self._samples[0].travelled_m, self._samples[0].slip_rad


def _follow(last: MotionSample, odometry: Odometry, rate_radps: float | None) -> MotionSample:
    step = between(last.base_in_odom, odometry.base_in_odom)
    elapsed_s = odometry.stamp_s - last.stamp_s
    turn_rad = step.yaw_rad
    if rate_radps is not None and elapsed_s <= GAP_S:
        turn_rad = rate_radps * elapsed_s
    carried = compose(last.carried, Pose2(step.x_m, step.y_m, wrap(turn_rad)))
    return MotionSample(
        odometry.stamp_s,
        odometry.base_in_odom,
        carried,
        last.travelled_m + float(np.hypot(step.x_m, step.y_m)),
        last.slip_rad + abs(wrap(turn_rad - step.yaw_rad)),
    )
