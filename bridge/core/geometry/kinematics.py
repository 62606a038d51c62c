"""Turn body velocity into wheel speeds and back, and integrate wheel angles into a pose.

Owns the geometry of a differential base: saturation by one factor within the robot's limits, and
``base`` in ``odom`` by exact arcs with the measured velocity. Knows no time: angles are integrated,
not speeds, so a late reading loses nothing. Whether a reading may be trusted as the follow-up of
the last one (same drive boot) is the caller's knowledge and comes in as a flag. Every function is
total: what is not finite becomes standstill, never an exception.
"""

from __future__ import annotations

from math import cos, isfinite, sin, sqrt
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import ConfigDict, Field

from wire.bounded_types import Count, WheelAngle
from wire.geometry import (
    IDENTITY,
    MAX_COORDINATE_M,
    MAX_SPEED_MPS,
    MAX_TURN_RADPS,
    STILL,
    Pose2,
    Twist2,
    wrap,
)
from wire.value import value

if TYPE_CHECKING:
    from wire.robot import Base, Limits
    from wire.sensors import DriveState

_WHEEL = Field(ge=-1_000.0, le=1_000.0)


@value
class WheelSpeeds:
    """Give both wheel speeds [rad/s], positive forwards."""

    left_radps: Annotated[float, _WHEEL]
    right_radps: Annotated[float, _WHEEL]
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)


STOPPED = WheelSpeeds(0.0, 0.0)


def rim_speeds(twist: Twist2, separation_m: float) -> tuple[float, float]:
    """Return the ground speed of the left and of the right wheel [m/s]."""
    half = twist.w_radps * separation_m / 2
    return twist.v_mps - half, twist.v_mps + half


def fastest_rim(twist: Twist2, separation_m: float) -> float:
    """Return the ground speed of the faster wheel [m/s], never negative."""
    return abs(twist.v_mps) + abs(twist.w_radps) * separation_m / 2


def wheels_of(twist: Twist2, base: Base) -> WheelSpeeds:
    """Return the wheel speeds of a body velocity: (v -+ w L / 2) / r; standstill if not finite."""
    left, right = rim_speeds(twist, base.wheel_separation_m)
    left, right = left / base.wheel_radius_m, right / base.wheel_radius_m
    if isfinite(left) and isfinite(right):
        return WheelSpeeds(left, right)
    return STOPPED


def twist_of(left_radps: float, right_radps: float, base: Base) -> Twist2:
    """Return the body velocity of two wheel speeds, held within the wire's bounds.

    A measurement beyond it stays a very large speed of the same sign, so that whoever compares it
    with what was sent still sees a runaway. What is not finite is standstill: a drive that says so
    is refused before it gets here.
    """
    left, right = left_radps * base.wheel_radius_m, right_radps * base.wheel_radius_m
    v, w = (left + right) / 2, (right - left) / base.wheel_separation_m
    if not (isfinite(v) and isfinite(w)):
        return STILL
    return Twist2(_clamp(v, MAX_SPEED_MPS), _clamp(w, MAX_TURN_RADPS))


def saturate(twist: Twist2, base: Base, limits: Limits, cap: float = 1.0) -> Twist2:
    """Scale v and w by one factor into the limits, so that the curve stays.

    Args:
        twist: what is asked.
        base: wheel geometry.
        limits: robot.toml's bounds on speed, turn, wheel and lateral acceleration.
        cap: factor on the speed and turn limits; anything outside [0, 1] counts as 0.
    """
    v, w = abs(twist.v_mps), abs(twist.w_radps)
    if not (isfinite(v) and isfinite(w) and 0.0 <= cap <= 1.0):
        return STILL
    rim_mps = v + w * base.wheel_separation_m / 2
    if (
        v <= limits.max_speed_mps * cap
        and w <= limits.max_turn_radps * cap
        and rim_mps <= limits.max_wheel_radps * base.wheel_radius_m
        and v * w <= limits.max_lateral_mps2
    ):
        return twist  # nearly always, four times a tick: every factor below would be 1
    factor = min(
        _ratio(limits.max_speed_mps * cap, v),
        _ratio(limits.max_turn_radps * cap, w),
        _ratio(limits.max_wheel_radps * base.wheel_radius_m, rim_mps),
        sqrt(_ratio(limits.max_lateral_mps2, v * w)),
    )
    return scale_twist(twist, factor)


def scale_twist(twist: Twist2, factor: float) -> Twist2:
    """Scale a body velocity along its curve; 1 returns it unchanged, bit for bit."""
    if factor == 1.0:
        return twist
    return Twist2(twist.v_mps * factor, twist.w_radps * factor)


def _ratio(limit: float, value: float) -> float:
    """Return the factor in [0, 1] that brings a value >= 0 down to its limit."""
    return 1.0 if value <= limit else limit / value


def _clamp(value: float, most: float) -> float:
    return value if -most <= value <= most else (most if value > 0 else -most)


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
