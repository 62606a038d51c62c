"""State the frames once, and do plane geometry in them. Knows mathematics only.

Frames (REP-103, REP-105): ``map`` (fixed, may jump) -> ``odom`` (continuous, drifts) -> ``base``
(the robot's centre of rotation on the floor). x forward, y left, z up; metres, radians,
counter-clockwise positive. A value ``robot_in_map`` is the pose of the robot's base written in map
coordinates, which is also the transform that takes base coordinates to map coordinates.
"""

from __future__ import annotations

from math import atan2, cos, hypot, isfinite, pi, sin
from typing import Annotated, ClassVar

from pydantic import ConfigDict, Field

from wire.value import value

MAX_COORDINATE_M = 10_000.0
"""No site is larger; a coordinate beyond it is a fault, not a place."""
MAX_SPEED_MPS = 10.0
MAX_TURN_RADPS = 20.0

Metres = Annotated[float, Field(ge=-MAX_COORDINATE_M, le=MAX_COORDINATE_M)]
Yaw = Annotated[float, Field(ge=-2 * pi, le=2 * pi)]
Mps = Annotated[float, Field(ge=-MAX_SPEED_MPS, le=MAX_SPEED_MPS)]
Radps = Annotated[float, Field(ge=-MAX_TURN_RADPS, le=MAX_TURN_RADPS)]

_STRICT = ConfigDict(extra="forbid", allow_inf_nan=False)


@value
class Pose2:
    """Place an origin and a heading in a plane frame; equally the transform from it."""

    x_m: Metres
    y_m: Metres
    yaw_rad: Yaw
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


@value
class Twist2:
    """Give a body velocity in ``base``: forward [m/s] and counter-clockwise [rad/s]."""

    v_mps: Mps
    w_radps: Radps
    __pydantic_config__: ClassVar[ConfigDict] = _STRICT


IDENTITY = Pose2(0.0, 0.0, 0.0)
STILL = Twist2(0.0, 0.0)


def wrap(angle_rad: float) -> float:
    """Bring an angle into [-pi, pi]; infinity becomes NaN, never an exception."""
    if -pi <= angle_rad <= pi:
        return angle_rad  # nearly always
    return atan2(sin(angle_rad), cos(angle_rad)) if isfinite(angle_rad) else float("nan")


def compose(b_in_a: Pose2, c_in_b: Pose2) -> Pose2:
    """Return c_in_a: follow one transform by the next."""
    c, s = cos(b_in_a.yaw_rad), sin(b_in_a.yaw_rad)
    return Pose2(
        b_in_a.x_m + c * c_in_b.x_m - s * c_in_b.y_m,
        b_in_a.y_m + s * c_in_b.x_m + c * c_in_b.y_m,
        wrap(b_in_a.yaw_rad + c_in_b.yaw_rad),
    )


def inverse(b_in_a: Pose2) -> Pose2:
    """Return a_in_b."""
    c, s = cos(b_in_a.yaw_rad), sin(b_in_a.yaw_rad)
    return Pose2(
        -c * b_in_a.x_m - s * b_in_a.y_m,
        s * b_in_a.x_m - c * b_in_a.y_m,
        wrap(-b_in_a.yaw_rad),
    )


def between(from_in_a: Pose2, to_in_a: Pose2) -> Pose2:
    """Return the pose of ``to`` seen from ``from``, both given in one frame."""
    c, s = cos(from_in_a.yaw_rad), sin(from_in_a.yaw_rad)
    dx, dy = to_in_a.x_m - from_in_a.x_m, to_in_a.y_m - from_in_a.y_m
    return Pose2(c * dx + s * dy, c * dy - s * dx, wrap(to_in_a.yaw_rad - from_in_a.yaw_rad))


def transform(b_in_a: Pose2, x_in_b_m: float, y_in_b_m: float) -> tuple[float, float]:
    """Move a point [m] from frame b to frame a."""
    c, s = cos(b_in_a.yaw_rad), sin(b_in_a.yaw_rad)
    return (
        b_in_a.x_m + c * x_in_b_m - s * y_in_b_m,
        b_in_a.y_m + s * x_in_b_m + c * y_in_b_m,
    )


def distance(a: Pose2, b: Pose2) -> float:
    """Return the distance between two origins [m], both given in one frame."""
    return hypot(b.x_m - a.x_m, b.y_m - a.y_m)
