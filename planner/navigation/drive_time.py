"""Predict how long the bridge takes to drive a way. Pure: points with speeds, and robot.toml.

The bridge turns on the spot towards a way that begins over a radian aside, speeds up by its limit,
passes each point no faster than asked, stops at the end, and there turns to the goal's heading.
The constants were fitted to drives in lockstep (docs/adr/0080).
"""

from __future__ import annotations

from itertools import pairwise
from math import atan2, hypot, pi, sqrt

from planner.navigation.route import MIN_SPEED_MPS, RoutePoint
from wire.geometry import wrap
from wire.robot import Limits

TURN_ABOVE_RAD = 1.05
"""As bridge.core.motion.pursuit."""
LOOK_M = 0.4
SETTLING_S = 0.1
"""From the last centimetres to the bridge's word that the leg was reached."""
STARTING_S = 0.2
"""To search the way, stream it and begin."""
SLOWING_MPS2 = 0.5
"""As planner.navigation.waypoints slows down ahead of a slow point, which reads numpy."""
TURN_SETTLES_S = 0.1


def spin_s(angle_rad: float, limits: Limits) -> float:
    """Return the time for a leg that is a turn on the spot."""
    return STARTING_S + turn_s(angle_rad, limits)


def turn_s(angle_rad: float, limits: Limits) -> float:
    """Return the time for a turn on the spot: up to the limit and down again."""
    angle = abs(angle_rad)
    if angle < 0.02:
        return 0.0
    # At the rim the wheels speed up as they do ahead; a quarter metre is half a track.
    ramp_radps2 = limits.max_accel_mps2 / 0.25
    top = min(limits.max_turn_radps, sqrt(angle * ramp_radps2))
    return angle / top + top / ramp_radps2 + TURN_SETTLES_S


def leg_s(
    points: tuple[RoutePoint, ...],
    start_rad: float,
    end_rad: float | None,
    limits: Limits,
) -> tuple[float, float]:
    """Return a leg's time [s] and the heading in which it ends.

    Args:
        points: the way, from where the robot stands.
        start_rad: its heading there.
        end_rad: the heading asked for at the end, None where it doesn't matter.
        limits: the robot's.
    """
    took_s, heading = STARTING_S + SETTLING_S, start_rad
    if len(points) > 1:
        backwards = points[0].speed_mps < 0.0
        begin = wrap(_bearing(points, 0) + (pi if backwards else 0.0))
        if abs(wrap(begin - start_rad)) > TURN_ABOVE_RAD:
            took_s += turn_s(wrap(begin - start_rad), limits)
        took_s += _drive_s(points, limits)
        before = max(0, len(points) - 4)
        last, end = points[before], points[-1]
        heading = atan2(end.y_m - last.y_m, end.x_m - last.x_m) + (pi if backwards else 0.0)
    if end_rad is not None:
        took_s += turn_s(wrap(end_rad - heading), limits)
        heading = end_rad
    return took_s, wrap(heading)


def _bearing(points: tuple[RoutePoint, ...], index: int) -> float:
    here = points[index]
    for ahead in points[index + 1 :]:
        if hypot(ahead.x_m - here.x_m, ahead.y_m - here.y_m) >= LOOK_M:
            break
    else:
        ahead = points[-1]
    return atan2(ahead.y_m - here.y_m, ahead.x_m - here.x_m)


def _drive_s(points: tuple[RoutePoint, ...], limits: Limits) -> float:
    gaps_m = [hypot(b.x_m - a.x_m, b.y_m - a.y_m) for a, b in pairwise(points)]
    speeds = [abs(point.speed_mps) for point in points]
    speeds[0] = speeds[-1] = 0.0
    up_mps2, down_mps2 = limits.max_accel_mps2, min(SLOWING_MPS2, limits.max_decel_mps2)
    for index, gap_m in enumerate(gaps_m):
        reached = sqrt(speeds[index] ** 2 + 2.0 * up_mps2 * gap_m)
        speeds[index + 1] = min(speeds[index + 1], reached)
    for index in range(len(gaps_m) - 1, -1, -1):
        reached = sqrt(speeds[index + 1] ** 2 + 2.0 * down_mps2 * gaps_m[index])
        speeds[index] = min(speeds[index], reached)
    pairs = zip(gaps_m, speeds, speeds[1:], strict=False)
    return sum(_gap_s(gap_m, a, b, up_mps2 if b > a else down_mps2) for gap_m, a, b in pairs)


def _gap_s(gap_m: float, before_mps: float, after_mps: float, rate_mps2: float) -> float:
    """Return the time between two points: the speed changes at its rate, then it is kept."""
    slow, fast = sorted((before_mps, after_mps))
    ramp_m = min(gap_m, (fast * fast - slow * slow) / (2.0 * rate_mps2))
    return (fast - slow) / rate_mps2 + (gap_m - ramp_m) / max(fast, MIN_SPEED_MPS)
