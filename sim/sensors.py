"""Model sensors: quantised, biased, noisy. Pure given a seeded generator."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy as np

from wire.geometry import MAX_TURN_RADPS
from wire.value import value

if TYPE_CHECKING:
    from numpy.random import Generator
    from numpy.typing import NDArray

    from sim.hardware import Hardware
    from wire import DriveState, Imu, Pose2, Scan, Twist2
    from wire.lidar_config import LidarConfig

Ranges = tuple[float | None, ...]

MOST_WHEEL_RADPS = 1_000.0
MOST_ACCEL_MPS2 = 1_000.0
"""Sensors end somewhere; these and the gyro's 20 rad/s are the wire's bounds. What is put down onto
the robot flings it away for an instant, and that must not end the simulator."""


def _saturate(reading: float, most: float) -> float:
    return max(-most, min(most, reading))


class Encoder:
    """Count a wheel's turn in whole steps, and give its speed as the drive sees it."""

    def __init__(self, counts_per_turn: int, period_s: float, angle_rad: float) -> None:
        self._step_rad = 2 * pi / counts_per_turn
        self._period_s = period_s
        self._zero_rad = angle_rad
        self._count = 0
        self.speed_radps = 0.0

    @property
    def angle_rad(self) -> float:
        """Return the angle of the last whole count [rad]."""
        return self._count * self._step_rad

    def sample(self, angle_rad: float) -> None:
        """Read the shaft; speed is the count's change over one period."""
        count = int((angle_rad - self._zero_rad) // self._step_rad)
        speed_radps = (count - self._count) * self._step_rad / self._period_s
        self.speed_radps = _saturate(speed_radps, MOST_WHEEL_RADPS)
        self._count = count


@value
class ImuSample:
    """Hold one reading in ``base``."""

    yaw_rate_radps: float
    accel_x_mps2: float
    accel_y_mps2: float


class ImuModel:
    """Measure turn and acceleration with a constant bias and white noise."""

    def __init__(self, hardware: Hardware, period_s: float, random: Generator) -> None:
        self._random = random
        self._period_s = period_s
        self._bias_radps = float(random.normal(0.0, hardware.gyro_bias_radps))
        self._sigmas = np.array(
            [hardware.gyro_noise_radps, hardware.accel_noise_mps2, hardware.accel_noise_mps2]
        )
        self._noise: list[list[float]] = []
        self._last_v_mps = 0.0

    def sample(self, twist: Twist2) -> ImuSample:
        """Read once per period."""
        if not self._noise:  # drawn by the block: one call per reading costs 10 us
            self._noise = (self._random.standard_normal((100, 3)) * self._sigmas).tolist()
        noise = self._noise.pop()
        forward_mps2 = (twist.v_mps - self._last_v_mps) / self._period_s
        self._last_v_mps = twist.v_mps
        return ImuSample(
            _saturate(twist.w_radps + self._bias_radps + noise[0], MAX_TURN_RADPS),
            _saturate(forward_mps2 + noise[1], MOST_ACCEL_MPS2),
            _saturate(twist.v_mps * twist.w_radps + noise[2], MOST_ACCEL_MPS2),
        )


class LidarModel:
    """Aim the lidar's beams and add noise and dropout to true distances.

    A scan is level, though a real one tilts with the robot. It is taken in one instant unless the
    hardware says that it sweeps, as a real one does for 0.1 s: at 0.5 m/s that is up to 0.05 m,
    which the bridge's margins must hold anyway.
    """

    def __init__(self, config: LidarConfig, hardware: Hardware, random: Generator) -> None:
        self._random = random
        self._hardware = hardware
        self.config = config
        self.angle_increment_rad = 2 * pi / hardware.lidar_beams
        self.angle_min_rad = -pi
        self.angles_rad = self.angle_min_rad + self.angle_increment_rad * np.arange(
            hardware.lidar_beams
        )

    def directions(self, lidar_in_map: Pose2) -> NDArray[np.float64]:
        """Return each beam's unit vector in ``map``, shape (beams, 3)."""
        angles = self.angles_rad + lidar_in_map.yaw_rad
        return np.stack((np.cos(angles), np.sin(angles), np.zeros_like(angles)), axis=1)

    def beams_due(self, ticks_left: int, tick_s: float) -> slice:
        """Return the beams that are taken in a tick, so many ticks before a scan is due."""
        beams, ticks = self._hardware.lidar_beams, self.sweep_ticks(tick_s)
        done = ticks - 1 - ticks_left
        return slice(max(0, beams * done // ticks), max(0, beams * (done + 1) // ticks))

    def sweep_ticks(self, tick_s: float) -> int:
        """Return in how many ticks a scan is taken; 1: in one instant."""
        return max(1, round(min(self._hardware.lidar_sweep_s, self.config.scan_s) / tick_s))

    def measure(self, true_m: NDArray[np.float64]) -> Ranges:
        """Turn true distances (-1: nothing there) into ranges; millimetres, None for no return."""
        count = len(true_m)
        noise = self._random.normal(0.0, self._hardware.lidar_noise_m, count)
        noisy = true_m * self._hardware.lidar_range_scale + noise
        lost = self._random.random(count) < self._hardware.lidar_dropout
        lost |= (true_m < 0.0) | (noisy > self.config.range_max_m)
        millimetres: list[float | None] = np.round(np.maximum(noisy, 0.0), 3).tolist()
        for beam in np.flatnonzero(lost).tolist():  # few are lost in a home
            millimetres[beam] = None
        return tuple(millimetres)

    def without_sector(self, ranges_m: Ranges, directions_rad: NDArray[np.floating]) -> Ranges:
        """Return a scan without the hardware's hidden sector; directions in the lidar's frame."""
        middle_rad = self._hardware.lidar_sector_at_rad - self.config.yaw_rad
        off_rad = np.abs((directions_rad - middle_rad + pi) % (2 * pi) - pi)
        hidden = off_rad <= self._hardware.lidar_sector_rad / 2
        return tuple(None if gone else r for r, gone in zip(ranges_m, hidden, strict=True))


class Garbage:
    """Make values that a broken sensor might send: anything that the wire can carry."""

    WHEELS = ("left_rad", "right_rad", "left_radps", "right_radps")
    TURN = ("yaw_rate_radps", "accel_x_mps2", "accel_y_mps2")
    RANGES = ("ranges_m",)

    def __init__(self, random: Generator) -> None:
        self._random = random

    def wheels(self, state: DriveState) -> dict[str, float]:
        """Turn the wheels to anywhere within ten turns, at any speed."""
        jumps, speeds = self._random.uniform(-60.0, 60.0, 2), self._random.uniform(-50.0, 50.0, 2)
        values = (state.left_rad + jumps[0], state.right_rad + jumps[1], *speeds)
        return dict(zip(self.WHEELS, map(float, values), strict=True))

    def turn(self, _reading: Imu) -> dict[str, float]:
        """Turn at any rate."""
        return dict(zip(self.TURN, self._random.uniform(-20.0, 20.0, 3).tolist(), strict=True))

    def beams(self, count: int, most_m: float) -> Ranges:
        """Return ranges that a broken lidar might measure."""
        return tuple(self._random.uniform(0.0, most_m, count).tolist())

    def ranges(self, scan: Scan) -> dict[str, Ranges]:
        """Return ranges of a broken lidar: random values."""
        values = self._random.uniform(0.0, scan.range_max_m, len(scan.ranges_m))
        return {"ranges_m": tuple(values.tolist())}
