"""Pass the part of a motion that the lidar's free space allows: the OBSTACLE gate.

Owns the joint verdict on what is asked and on what the robot really does, since after a change of
mind it still follows the old curve for a while. Scales along the curve, down to nothing towards the
trouble; where nothing is left, the turn in place that loses no clearance still passes, slowly.
Knows no modes and no rows.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from pydantic import ConfigDict

from bridge.core.geometry.kinematics import scale_twist
from bridge.core.geometry.stopping import path_decel_mps2, reaction_s, speed_within
from bridge.core.motion.braking import CREEP_RADPS, speed_scale
from bridge.core.motion.free_distance import FreeLength, free_length
from bridge.core.sensing.sensor_update import REACH_M, ROUNDING_M, look_m
from bridge.core.state_motion import AS_CONFIGURED, Braking
from bridge.core.tick_context import STANDING_MPS
from wire.geometry import STILL, Pose2, Twist2
from wire.value import value

if TYPE_CHECKING:
    from bridge.core.geometry.lidar_scan import ScanPicture
    from wire.robot import RobotDescription

_SAME_CURVE_PER_M = 0.05


@value
class ObstaclePass:
    """Hold the part of a motion that passes the obstacle gate, and why."""

    twist: Twist2
    """What may be asked of the limiter; standstill if the gate is shut."""
    scale: float
    """Factor on the motion that was asked."""
    free_m: float
    """Free length of the arc asked for, as far as anybody looked: that is not always 2 m."""
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
    braking: Braking = AS_CONFIGURED,
) -> ObstaclePass:
    """Judge a motion by the newest scan.

    Args:
        picture: the newest scan's.
        base_in_odom_now: odometry's pose now.
        asked: the motion wanted, saturated.
        measured: what the wheels do.
        scan_age_s: how old the scan is.
        robot: limits, lag and size; none of them is assumed better than it says.
        braking: how much worse than that it has shown to brake.
    """
    base, limits, share = robot.base, robot.limits, braking.decel_share
    lag_s = robot.drive.late_s + braking.lag_more_s
    reaction = reaction_s(scan_age_s, robot.lidar.scan_s, lag_s, limits)
    usual, speed = look_m(robot, braking), abs(asked.v_mps)
    reach = _reach_m(usual, speed, asked, robot, reaction, share)
    free = free_length(picture, base_in_odom_now, asked, base.radius_m, reach)
    scale = speed_scale(free.s_m, asked, base, limits, reaction, share, touching=free.touching)
    room, known = free.s_m, free.known
    if abs(measured.v_mps) > STANDING_MPS and not _same_curve(asked, measured):
        reach = _reach_m(usual, speed, measured, robot, reaction, share)
        really = free_length(picture, base_in_odom_now, measured, base.radius_m, reach)
        room, known = min(room, really.s_m), known and really.known
        if asked.v_mps * measured.v_mps > 0.0:
            scale = min(scale, _carried_on(really, asked, measured, robot, reaction, share))
    return ObstaclePass(
        twist=_passes(asked, scale),
        scale=scale,
        free_m=free.s_m,
        room_m=max(0.0, room - abs(measured.v_mps) * lag_s - weak_m(measured, robot, share)),
        known=known,
    )


def weak_m(measured: Twist2, robot: RobotDescription, share: float) -> float:
    """Return how much longer weak brakes make the path until standstill [m]."""
    if not share < 1.0:
        return 0.0
    decel = path_decel_mps2(measured, robot.base, robot.limits, share)
    return measured.v_mps * measured.v_mps * (1.0 - share) / (2 * decel) if decel > 0.0 else 0.0


def _reach_m(
    usual: float,
    speed: float,
    along: Twist2,
    robot: RobotDescription,
    reaction: float,
    share: float,
) -> float:
    """Return how far to look along a motion so that more could not change what passes.

    Free for longer than it takes to stop, a speed passes whole. Old scans, tight curves just left
    and robots faster than they may be look as far as anybody does.
    """
    decel = path_decel_mps2(along, robot.base, robot.limits, share)
    if not (decel > 0.0 and abs(along.v_mps) <= 2 * robot.limits.max_speed_mps):
        return REACH_M
    stop = speed * reaction + speed * speed / (2 * decel)
    return usual if stop + ROUNDING_M <= usual else REACH_M


def _same_curve(a: Twist2, b: Twist2) -> bool:
    """Tell whether two motions go the same way within what free space can tell apart."""
    product = a.v_mps * b.v_mps
    bend = a.w_radps * abs(b.v_mps) - b.w_radps * abs(a.v_mps)
    return product > 0.0 and abs(bend) <= _SAME_CURVE_PER_M * product


def _carried_on(
    really: FreeLength,
    asked: Twist2,
    measured: Twist2,
    robot: RobotDescription,
    reaction: float,
    share: float,
) -> float:
    """Return the factor on the request that the arc still being driven allows."""
    if really.touching:
        return 1.0  # it loses no clearance; what is asked has been judged by itself
    decel = path_decel_mps2(measured, robot.base, robot.limits, share)
    allowed = speed_within(really.s_m, decel, reaction)
    return min(1.0, allowed / abs(asked.v_mps))


def _passes(asked: Twist2, scale: float) -> Twist2:
    if scale > 0.0:
        return scale_twist(asked, scale)
    if abs(asked.w_radps) <= CREEP_RADPS:
        return Twist2(0.0, asked.w_radps)
    if asked.w_radps > 0.0:
        return Twist2(0.0, CREEP_RADPS)
    return Twist2(0.0, -CREEP_RADPS) if asked.w_radps < 0.0 else STILL
