"""Say how fast a free length lets a motion be, and how long a motion takes to stop.

Owns the one law that obstacles, the fence and the end of a path share: v t + v^2 / 2a = s. Knows no
geometry and no time but what it is told.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import fastest_rim

if TYPE_CHECKING:
    from wire.geometry import Twist2
    from wire.robot import Base, Limits

CREEP_MPS, CREEP_RADPS = 0.1, 0.3
"""What loses no clearance may move this fast beside or inside the margin."""
STANDING_MPS = 0.02
TURNING_MPS = 1e-4
"""Slower than this is turning in place, which sweeps nothing but the disc itself."""


def reaction_s(scan_age_s: float, scan_s: float, lag_s: float, limits: Limits) -> float:
    """Return how long the robot goes on before it slows as planned [s].

    Age of the scan, one more scan (what appears just after a beam passed is seen by the next),
    the drive's lag, and what the jerk limit takes to build the deceleration up: d / 2j.
    """
    build_s = limits.max_decel_mps2 / (2 * limits.stop_jerk_mps3)
    return scan_age_s + scan_s + lag_s + build_s


def path_decel_mps2(twist: Twist2, base: Base, limits: Limits, share: float = 1.0) -> float:
    """Return the deceleration along the path of a twist: d holds at the faster wheel.

    Args:
        twist: the motion.
        base: wheel geometry.
        limits: robot.toml's bounds.
        share: of its deceleration, what the robot has shown to reach.
    """
    rim = fastest_rim(twist, base.wheel_separation_m)
    decel = limits.max_decel_mps2 * share
    return decel * abs(twist.v_mps) / rim if rim > 0.0 else decel


def speed_within(s_m: float, decel_mps2: float, reaction: float) -> float:
    """Return the speed that still stops within a length: v t + v^2 / 2a = s, solved for v.

    Written as 2s / (t + sqrt(t^2 + 2s/a)), which does not cancel. Accepts only s > 0 and a > 0.
    """
    if not (s_m > 0.0 and decel_mps2 > 0.0 and reaction >= 0.0):
        return 0.0
    return 2 * s_m / (reaction + sqrt(reaction * reaction + 2 * s_m / decel_mps2))


def speed_scale(
    free_m: float,
    twist: Twist2,
    base: Base,
    limits: Limits,
    reaction: float,
    share: float = 1.0,
    *,
    touching: bool = False,
) -> float:
    """Return the factor in [0, 1] that lets a motion stop within its free length.

    Where something touches the margin already and the motion loses no clearance to it, it creeps.
    A speed below what counts as standing is none: the gate is then shut, not creeping.
    """
    v, w = abs(twist.v_mps), abs(twist.w_radps)
    creep = min(_ratio(CREEP_MPS, v), _ratio(CREEP_RADPS, w))
    if v < TURNING_MPS:
        return creep if touching else 1.0
    allowed = speed_within(free_m, path_decel_mps2(twist, base, limits, share), reaction)
    scale = _ratio(allowed, v)
    if touching:
        return min(creep, scale)
    return 0.0 if scale < 1.0 and allowed < STANDING_MPS else scale


def stop_length_m(
    twist: Twist2, base: Base, limits: Limits, reaction: float, share: float = 1.0
) -> float:
    """Return the path until standstill [m]: v t + v^2 / 2a."""
    speed = abs(twist.v_mps)
    decel = path_decel_mps2(twist, base, limits, share)
    return speed * reaction + (speed * speed / (2 * decel) if decel > 0.0 else 0.0)


def _ratio(limit: float, value: float) -> float:
    """Return the factor in [0, 1] that brings a value >= 0 down to its limit; no number, none."""
    if value <= limit:
        return 1.0
    return limit / value if value > limit else 0.0
