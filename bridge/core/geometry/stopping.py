"""Say how fast a free length lets a motion be: the one law that all gates share. Pure.

Obstacles, the fence, marks, slow areas and the end of a path ask v t + v^2 / 2a = s, each for its
own length. Knows robot.toml's numbers and what the robot has shown; no state and no gate.
"""

from __future__ import annotations

from math import sqrt
from typing import TYPE_CHECKING

from bridge.core.geometry.kinematics import fastest_rim

if TYPE_CHECKING:
    from wire.geometry import Twist2
    from wire.robot import Base, Limits


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


def speed_before(gap_m: float, slow_mps: float, decel_mps2: float, reaction: float) -> float:
    """Return the speed that is down to a slower one within a gap: v t + (v^2 - u^2) / 2a = s."""
    if not gap_m > 0.0:
        return slow_mps
    at = decel_mps2 * reaction
    return max(slow_mps, sqrt(at * at + slow_mps * slow_mps + 2 * decel_mps2 * gap_m) - at)


def stop_length_m(
    twist: Twist2, base: Base, limits: Limits, reaction: float, share: float = 1.0
) -> float:
    """Return the path until standstill [m]: v t + v^2 / 2a."""
    speed = abs(twist.v_mps)
    decel = path_decel_mps2(twist, base, limits, share)
    return speed * reaction + (speed * speed / (2 * decel) if decel > 0.0 else 0.0)
