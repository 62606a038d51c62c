"""Find who comes towards the robot. Pure: points of its way and discs that move."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import hypot
from typing import TYPE_CHECKING

from planner.navigation.route import Mover, is_wide

if TYPE_CHECKING:
    from collections.abc import Sequence


Point = tuple[float, float]

BESIDE_M = 0.9
"""Farther from the way than this somebody walks past in a lane of their own."""
NEAREST_M = 0.9
"""From the robot's middle along the way: who is nearer is met already, and the bridge judges it."""
TOWARDS_MPS, WIDE_TOWARDS_MPS = 0.25, 0.1
"""The second of one as wide as a robot: it slows down in a door."""
MOSTLY = 0.7
"""Of a mover's speed, the share that leads towards the robot: the rest is crossing."""

AHEAD_S, CLEAR_M = 1.5, 0.15
"""Another robot is met where both, as they go on, come nearer to each other than this by then."""


@dataclass(frozen=True, slots=True)
class Encounter:
    """Say where on the way somebody is who comes."""

    far_m: float
    """Along the way."""
    at_m: Point
    """In ``map``."""
    who: Mover


def find_oncoming(way: Sequence[Point], movers: Sequence[Mover]) -> Encounter | None:
    """Return where the nearest who comes towards the robot is on its way; None: nobody does.

    Args:
        way: points of the way ahead, from the robot on [m].
        movers: what moves, in ``map``.
    """
    met = [found for mover in movers if (found := _meeting(way, mover)) is not None]
    return min(met, key=lambda one: one.far_m) if met else None


def is_closing_in(at: Point, velocity_mps: Point, radius_m: float, movers: Sequence[Mover]) -> bool:
    """Tell whether the robot and another one, as both go on, are about to touch.

    By the closest point of approach of two discs that move straight on.

    Args:
        at: where the robot is, in ``map`` [m].
        velocity_mps: of the robot, in ``map``.
        radius_m: the disc that holds the robot.
        movers: what moves, in ``map``; only one as wide as a robot counts.
    """
    for mover in movers:
        x_m, y_m = mover.x_m - at[0], mover.y_m - at[1]
        vx_mps, vy_mps = mover.vx_mps - velocity_mps[0], mover.vy_mps - velocity_mps[1]
        squared = vx_mps**2 + vy_mps**2
        if not (is_wide(mover.radius_m) and squared > 0.0):
            continue
        nearest_s = min(-(x_m * vx_mps + y_m * vy_mps) / squared, AHEAD_S)
        left_m = hypot(x_m + nearest_s * vx_mps, y_m + nearest_s * vy_mps)
        if nearest_s > 0.0 and left_m <= radius_m + mover.radius_m + CLEAR_M:
            return True
    return False


def _meeting(way: Sequence[Point], mover: Mover) -> Encounter | None:
    """Return where a mover is on the way, if it comes along it."""
    best: tuple[float, float, Point, Point] | None = None
    gone_m = 0.0
    for (ax, ay), (bx, by) in pairwise(way):
        long_m = hypot(bx - ax, by - ay)
        away_m = hypot(mover.x_m - ax, mover.y_m - ay)
        if long_m > 0.0 and (best is None or away_m < best[0]):
            best = (away_m, gone_m, (ax, ay), ((bx - ax) / long_m, (by - ay) / long_m))
        gone_m += long_m
    if best is None:
        return None
    away_m, along_m, point, (ex, ey) = best
    against_mps = -(mover.vx_mps * ex + mover.vy_mps * ey)
    speed_mps = hypot(mover.vx_mps, mover.vy_mps)
    least_mps = WIDE_TOWARDS_MPS if is_wide(mover.radius_m) else TOWARDS_MPS
    comes = against_mps >= least_mps and against_mps >= MOSTLY * speed_mps
    on_way = away_m <= BESIDE_M and along_m >= NEAREST_M
    return Encounter(along_m, point, mover) if comes and on_way else None
