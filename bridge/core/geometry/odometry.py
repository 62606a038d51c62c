"""Integrate wheel angles into ``base`` in ``odom`` by exact arcs.

Owns the pose since the bridge started and the measured velocity. Knows no time: angles, not speeds,
are integrated, so a late reading loses nothing. Whether a reading may be trusted as the follow-up
of the last one (same drive boot) is the caller's knowledge and comes in as a flag.
"""

from __future__ import annotations

from math import cos, isfinite, sin
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import ConfigDict, Field

from bridge.core.geometry.kinematics import twist_of
from wire.bounded_types import Count, WheelAngle
from wire.geometry import IDENTITY, MAX_COORDINATE_M, STILL, Pose2, Twist2, wrap
from wire.value import value

if TYPE_CHECKING:
    from wire.robot import Base
    from wire.sensors import DriveState

MAX_STEP_M = 1.0
"""No wheel rolls further between two readings: the drive's own time-out stops it sooner."""

_MAX_ANGLE_RAD = 1e9  # of WheelAngle
_Path = Annotated[float, Field(ge=0.0, le=1e12)]


@value
class OdometryState:
    """Hold where the robot is in ``odom``, how fast, and the angles it was computed from."""

    base_in_odom: Pose2 = IDENTITY
    measured: Twist2 = STILL
    left_rad: WheelAngle | None = None
    right_rad: WheelAngle | None = None
    travelled_m: _Path = 0.0
    """Path length since start, backwards counted too; what a grant's metres are metered by."""
    turned_rad: _Path = 0.0
    jumps: Count = 0
    """Readings that no wheel can roll between: counted, never integrated."""
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)


def advance(
    state: OdometryState, drive: DriveState, base: Base, *, rezero: bool = False
) -> OdometryState:
    """Take one drive reading into account.

    Args:
        state: the odometry so far.
        drive: the reading.
        base: wheel geometry.
        rezero: the drive started anew (other boot id): the angles are a new zero, nothing moves.
    """
    measured = twist_of(drive.left_radps, drive.right_radps, base)
    left_m = right_m = 0.0
    jumped = False
    if state.left_rad is not None and state.right_rad is not None and not rezero:
        left_m = (drive.left_rad - state.left_rad) * base.wheel_radius_m
        right_m = (drive.right_rad - state.right_rad) * base.wheel_radius_m
        jumped = not (abs(left_m) <= MAX_STEP_M and abs(right_m) <= MAX_STEP_M)
    if jumped:
        left_m = right_m = 0.0
    pose = roll(state.base_in_odom, left_m, right_m, base.wheel_separation_m)
    return OdometryState(
        base_in_odom=pose,
        measured=measured,
        left_rad=_valid_angle(drive.left_rad),
        right_rad=_valid_angle(drive.right_rad),
        travelled_m=min(state.travelled_m + abs(left_m + right_m) / 2, 1e12),
        turned_rad=min(state.turned_rad + abs(right_m - left_m) / base.wheel_separation_m, 1e12),
        jumps=state.jumps + jumped,
    )


def _valid_angle(angle_rad: float) -> float | None:
    """Keep an angle that the wire may say; another is no zero to go on from."""
    return angle_rad if abs(angle_rad) <= _MAX_ANGLE_RAD else None


def roll(pose: Pose2, left_m: float, right_m: float, separation_m: float) -> Pose2:
    """Roll a pose along the exact arc of two wheel paths [m]; an impossible end moves nothing."""
    turn = (right_m - left_m) / separation_m
    return along_arc(pose, (left_m + right_m) / 2, turn)


def along_arc(pose: Pose2, length_m: float, turn_rad: float) -> Pose2:
    """Move a pose along an arc of signed length and turn; a step out of the world moves nothing."""
    if not isfinite(turn_rad):
        return pose
    x, y = arc_end(pose, length_m, turn_rad)
    if abs(x) <= MAX_COORDINATE_M and abs(y) <= MAX_COORDINATE_M:
        return Pose2(x, y, wrap(pose.yaw_rad + turn_rad))
    return pose


def arc_end(pose: Pose2, length_m: float, turn_rad: float) -> tuple[float, float]:
    """Return where an arc of signed length and turn ends; a turn that is no number moves nothing.

    The chord of an arc of length s and turn a is s sin(a/2) / (a/2), in the direction yaw + a/2.
    """
    half = turn_rad / 2
    if not isfinite(half):
        return pose.x_m, pose.y_m
    chord = length_m * (sin(half) / half if abs(half) > 1e-6 else 1.0)
    return pose.x_m + chord * cos(pose.yaw_rad + half), pose.y_m + chord * sin(pose.yaw_rad + half)
