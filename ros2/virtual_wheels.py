"""Turn wheel speeds into a twist, and poses of a base into angles of wheels that it may not have.

Left and right are (v -/+ w * separation / 2) / radius, as of any differential base; what a base
with four, six or three wheels does underneath is its own affair. Pure.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, sin
from typing import TYPE_CHECKING

from wire import wrap

if TYPE_CHECKING:
    from ros2.robot_words import OdometryWords
    from wire.robot import Base

JUMP_M = 0.1
JUMP_RAD = 0.2
"""Beyond what the limits allow in the time between two poses: its wheels begin at 0."""
FASTEST_RADPS = 1000.0
_STRAIGHT_RAD = 1e-6


@dataclass(frozen=True, slots=True)
class WheelReading:
    """Hold both wheels' angles since the first pose, and their speeds."""

    left_rad: float
    right_rad: float
    left_radps: float
    right_radps: float


class VirtualWheels:
    """Remember how far the wheels have turned."""

    def __init__(self, base: Base, top_mps: float, top_radps: float) -> None:
        """Set the geometry, and the speeds beyond which a pose has jumped."""
        self._base, self._top_mps, self._top_radps = base, top_mps, top_radps
        self._last: OdometryWords | None = None
        self._left_rad = self._right_rad = 0.0

    def twist(self, left_radps: float, right_radps: float) -> tuple[float, float]:
        """Return forward speed [m/s] and turning speed [rad/s] of two wheel speeds."""
        half = self._base.wheel_radius_m / 2.0
        v_mps = half * (left_radps + right_radps)
        w_radps = 2.0 * half * (right_radps - left_radps) / self._base.wheel_separation_m
        return v_mps, w_radps

    def forget(self) -> None:
        """Let the next pose be the first."""
        self._last = None

    def jumps(self, pose: OdometryWords) -> bool:
        """Return whether no motion leads from the last pose to this one."""
        last = self._last
        if last is None:
            return False
        passed_s = pose.stamp_s - last.stamp_s
        moved_m = hypot(pose.x_m - last.x_m, pose.y_m - last.y_m)
        turned_rad = abs(wrap(pose.yaw_rad - last.yaw_rad))
        return not (
            passed_s >= 0.0
            and moved_m <= JUMP_M + 2.0 * self._top_mps * passed_s
            and turned_rad <= JUMP_RAD + 2.0 * self._top_radps * passed_s
        )

    def turn(self, pose: OdometryWords) -> WheelReading:
        """Take the next pose; return the wheels.

        Two poses are the ends of an arc, and its chord points along the mean heading.
        """
        last, self._last = self._last, pose
        if last is not None:
            turned_rad = wrap(pose.yaw_rad - last.yaw_rad)
            heading_rad = last.yaw_rad + turned_rad / 2.0
            dx_m, dy_m = pose.x_m - last.x_m, pose.y_m - last.y_m
            chord_m = dx_m * cos(heading_rad) + dy_m * sin(heading_rad)
            ahead_m = chord_m * _arc_over_chord(turned_rad / 2.0)
            left_rad, right_rad = self._wheels(ahead_m, turned_rad)
            self._left_rad += left_rad
            self._right_rad += right_rad
        left_radps, right_radps = self._wheels(pose.v_mps, pose.w_radps)
        return WheelReading(
            self._left_rad, self._right_rad, _possible(left_radps), _possible(right_radps)
        )

    def _wheels(self, ahead: float, turning: float) -> tuple[float, float]:
        across = turning * self._base.wheel_separation_m / 2.0
        radius_m = self._base.wheel_radius_m
        return (ahead - across) / radius_m, (ahead + across) / radius_m


def _arc_over_chord(half_rad: float) -> float:
    return half_rad / sin(half_rad) if abs(half_rad) > _STRAIGHT_RAD else 1.0


def _possible(radps: float) -> float:
    """Return a speed held to what the wire carries; beyond, "far too fast" is all."""
    return min(max(radps, -FASTEST_RADPS), FASTEST_RADPS)
