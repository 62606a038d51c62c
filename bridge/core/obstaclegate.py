"""Let pass what the lidar's free space allows of a motion: the OBSTACLE gate.

Owns the joint verdict on what is asked and on what the robot really does, since after a change of
mind it still follows the old curve for a while. Scales along the curve, down to nothing towards the
trouble; where nothing is left, the turn in place that loses no clearance still passes, slowly.
Knows no modes and no rows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from pydantic import ConfigDict

from bridge.core.braking import (
    CREEP_RADPS,
    STANDING_MPS,
    path_decel_mps2,
    reaction_s,
    speed_scale,
    speed_within,
)
from bridge.core.freespace import FreeLength, free_length
from bridge.core.kinematics import scaled
from wire.geometry import STILL, Pose2, Twist2
from wire.value import value

if TYPE_CHECKING:
    from bridge.core.scanpicture import ScanPicture
    from wire.robot import RobotDescription

_SAME_CURVE_PER_M = 0.05


@value
class ObstaclePass:
    """Tell what passes of a motion, and why."""

    twist: Twist2
    """What may be asked of the limiter; standstill if the gate is shut."""
    scale: float
    """Factor on the motion that was asked."""
    free_m: float
    """Free length of the arc asked for."""
    room_m: float
    """Path in which the robot must be able to stand, drive lag taken off; for the limiter."""
    known: bool
    """Enough beams came back on the way; otherwise the speed is to be capped."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    @property
    def shut(self) -> bool:
        """Tell whether nothing passes."""
        return self.twist == STILL


def obstacle_gate(
    picture: ScanPicture,
    base_in_odom_now: Pose2,
    asked: Twist2,
    measured: Twist2,
    scan_age_s: float,
    robot: RobotDescription,
) -> ObstaclePass:
    """Judge a motion by the newest scan.

    Args:
        picture: the newest scan's.
        base_in_odom_now: odometry's pose now.
        asked: the motion wanted, saturated.
        measured: what the wheels do.
        scan_age_s: how old the scan is.
        robot: limits, lag and size; none of them is assumed better than it says.
    """
    base, limits = robot.base, robot.limits
    reaction = reaction_s(scan_age_s, robot.lidar.scan_s, robot.drive.lag_s, limits)
    free = free_length(picture, base_in_odom_now, asked, base.radius_m)
    scale = speed_scale(free, asked, base, limits, reaction)
    room, known = free.s_m, free.known
    if abs(measured.v_mps) > STANDING_MPS and not _same_curve(asked, measured):
        really = free_length(picture, base_in_odom_now, measured, base.radius_m)
        room, known = min(room, really.s_m), known and really.known
        if asked.v_mps * measured.v_mps > 0.0:
            scale = min(scale, _carried_on(really, asked, measured, robot, reaction))
    return ObstaclePass(
        twist=_passes(asked, scale),
        scale=scale,
        free_m=free.s_m,
        room_m=max(0.0, room - abs(measured.v_mps) * robot.drive.lag_s),
        known=known,
    )


def _same_curve(a: Twist2, b: Twist2) -> bool:
    """Tell whether two motions go the same way within what free space can tell apart."""
    product = a.v_mps * b.v_mps
    bend = a.w_radps * abs(b.v_mps) - b.w_radps * abs(a.v_mps)
    return product > 0.0 and abs(bend) <= _SAME_CURVE_PER_M * product


def _carried_on(
    really: FreeLength, asked: Twist2, measured: Twist2, robot: RobotDescription, reaction: float
) -> float:
    """Return the factor on what is asked that the arc the robot is still on allows."""
    if really.touching:
        return 1.0  # it loses no clearance; what is asked has been judged by itself
    decel = path_decel_mps2(measured, robot.base, robot.limits)
    allowed = speed_within(really.s_m, decel, reaction)
    return min(1.0, allowed / abs(asked.v_mps))


def _passes(asked: Twist2, scale: float) -> Twist2:
    if scale > 0.0:
        return scaled(asked, scale)
    if abs(asked.w_radps) <= CREEP_RADPS:
        return Twist2(0.0, asked.w_radps)
    if asked.w_radps > 0.0:
        return Twist2(0.0, CREEP_RADPS)
    return Twist2(0.0, -CREEP_RADPS) if asked.w_radps < 0.0 else STILL
