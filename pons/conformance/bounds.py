"""Bound a bridge under test: its limits, and how soon it must have noticed. No IO."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire import RobotDescription

PERIOD_S = 0.01
TRIM_MPS = 0.12
"""At most 0.10 m/s of correction, and the lag fed forward."""
SLACK_TICKS = 8
"""Two for the way there and back, and what a judge that shares the machine sees late."""


@dataclass(frozen=True, slots=True)
class MotionBounds:
    """Give one robot's bounds, as its owner set them."""

    wheel_radius_m: float
    wheel_separation_m: float
    dead_zone_radps: float
    """What the bridge adds to each wheel that is to turn, for the motor swallows it."""
    speed_mps: float
    turn_radps: float
    wheel_radps: float
    accel_mps2: float
    decel_mps2: float
    """An ordinary stop, at the wheels."""
    hardest_mps2: float
    jerk_mps3: float
    trim_mps: float
    """What wheel control may add to a wheel's command, at the rim, to make it turn as meant."""
    period_s: float = PERIOD_S

    @classmethod
    def of(cls, robot: RobotDescription) -> MotionBounds:
        """Read them from robot.toml's record."""
        base, limits = robot.base, robot.limits
        return cls(
            base.wheel_radius_m, base.wheel_separation_m, robot.drive.dead_zone_radps,
            limits.max_speed_mps, limits.max_turn_radps, limits.max_wheel_radps,
            limits.max_accel_mps2, limits.max_decel_mps2, limits.hardest_decel_mps2,
            limits.stop_jerk_mps3, TRIM_MPS,
        )  # fmt: skip

    def rim_mps(self, wheel_radps: float) -> float:
        """Return a wheel's meant speed at its rim [m/s], without what is added for the motor."""
        size = max(0.0, abs(wheel_radps) - self.dead_zone_radps) * self.wheel_radius_m
        return size if wheel_radps >= 0.0 else -size

    def stand_ticks(self, noticed_s: float, rim_mps: float) -> int:
        """Return in how many ticks a robot must stand that moves so fast when it goes wrong.

        Args:
            noticed_s: within which the bridge must have begun to stop.
            rim_mps: the faster wheel's speed then.
        """
        ramp_s = rim_mps / self.decel_mps2 + self.decel_mps2 / self.jerk_mps3
        return ceil((noticed_s + ramp_s) / self.period_s) + SLACK_TICKS
