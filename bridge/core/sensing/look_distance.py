"""Compute how far the bridge looks for obstacles; both the scan's points and the gate need it.

Points beyond are left out of a scan once, so that ten ticks after it need not look at them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.core.config import PERIOD_S
from bridge.core.state_motion import AS_CONFIGURED, Braking
from wire import margins

if TYPE_CHECKING:
    from wire.robot import RobotDescription


MARGIN_M = margins.OBSTACLE_MARGIN_M
REACH_M = 2.0
"""Nobody looks further: at the fastest and weakest that robot.toml may say, caps hold before."""
FREE_M = 0.3
"""So much free way ends a block."""


_FRESH_S = 0.15
"""No scan is older where each comes in time and is on its way for half a period."""


ROUNDING_M = 1e-3


def look_m(robot: RobotDescription, braking: Braking = AS_CONFIGURED) -> float:
    """Return how far along an arc one looks as a rule: all that a robot in its limits can need [m].

    That is the path in which it stands still from its fastest, by the gate's law and by the
    limiter's, which wants it besides what the drive's lag takes (see :func:`stopping_m`).
    """
    base, limits = robot.base, robot.limits
    v, d, j = limits.max_speed_mps, limits.max_decel_mps2, limits.stop_jerk_mps3
    lag_s = robot.drive.lag_s + braking.lag_more_s
    turning = limits.max_turn_radps * base.wheel_separation_m / 2
    rim = min(v + turning, limits.max_wheel_radps * base.wheel_radius_m)
    gate_s = _FRESH_S + robot.lidar.scan_s + lag_s
    limiter_m = 2 * v * (PERIOD_S + lag_s) + d * d * d / (24 * j * j)
    stop = v * d / (2 * j) + v * rim / (2 * d * braking.decel_share) + max(v * gate_s, limiter_m)
    return min(REACH_M, max(stop, FREE_M) + ROUNDING_M)


def sight_m(robot: RobotDescription, braking: Braking = AS_CONFIGURED) -> float:
    """Return how far from the robot at the scan a point may be that a tick will need [m]."""
    moved_m = robot.limits.max_speed_mps * _FRESH_S
    return look_m(robot, braking) + robot.base.radius_m + MARGIN_M + moved_m + 2 * ROUNDING_M
