"""Turn body velocity into wheel speeds and back, and hold it inside the robot's limits.

Owns the geometry of a differential base and saturation by one factor. Knows no history and no time.
Every function is total: what is not finite becomes standstill, never an exception.
"""

from __future__ import annotations

from math import isfinite, sqrt
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import ConfigDict, Field

from wire.geometry import MAX_SPEED_MPS, MAX_TURN_RADPS, STILL, Twist2
from wire.value import value

if TYPE_CHECKING:
    from wire.robot import Base, Limits

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
