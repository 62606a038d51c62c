"""Prepare a horizon for following: lengths along it, and the speed allowed at each point.

Owns what is computed once when a horizon is accepted. The end of any horizon is a stop for the
follower, so the speeds are those of a robot that brakes towards it. Knows no robot pose.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate, pairwise
from math import atan2, hypot, sqrt
from typing import TYPE_CHECKING, ClassVar

from pydantic import ConfigDict

from wire.geometry import Pose2, wrap

if TYPE_CHECKING:
    from collections.abc import Sequence

    from wire.commands import Waypoint
    from wire.robot import Limits

PLANNED_DECEL = 0.7
"""Share of the ordinary deceleration that a path is planned with; the rest corrects errors."""
TURN_RADIUS_M = 0.6
"""Arcs tighter than this are taken slower, in proportion (regulated pure pursuit)."""
SLOWEST_SHARE = 0.25
SLOWEST_MPS = 0.05
_ROUNDING = 1e-9
_CORNER_M = 0.15  # a corner's turn is spread over this length on either side of it


@dataclass(frozen=True, slots=True)
class Path:
    """Hold a horizon point by point: place, length from its start, and speed [m/s], unsigned."""

    xs_m: tuple[float, ...]
    ys_m: tuple[float, ...]
    along_m: tuple[float, ...]
    speeds_mps: tuple[float, ...]
    """What the sender allows at each point."""
    exits_mps: tuple[float, ...]
    """How fast the robot may pass each point for the sake of curves and stops after it."""
    backwards: bool
    heading_rad: float | None
    __pydantic_config__: ClassVar[ConfigDict] = ConfigDict(extra="forbid", allow_inf_nan=False)

    @property
    def length_m(self) -> float:
        """Return the length of the whole horizon."""
        return self.along_m[-1] if self.along_m else 0.0


def regulate(speed_mps: float, curve_per_m: float, radius_m: float, slowest_mps: float) -> float:
    """Slow down on a curve tighter than ``radius_m``, in proportion, never below ``slowest_mps``.

    Source: regulated pure pursuit (Macenski and others, 2023).
    """
    tight = abs(curve_per_m) * radius_m
    if tight <= 1.0:
        return speed_mps
    return min(speed_mps, max(speed_mps / tight, slowest_mps))


def prepare(points: Sequence[Waypoint], limits: Limits) -> Path:
    """Make the path of an accepted horizon (see :mod:`bridge.core.authority.leg_tracking`)."""
    xs = tuple([p.x_m for p in points])
    ys = tuple([p.y_m for p in points])
    dxs = [b - a for a, b in pairwise(xs)]
    dys = [b - a for a, b in pairwise(ys)]
    gaps = list(map(hypot, dxs, dys))
    along = list(accumulate(gaps, initial=0.0))
    speeds = tuple([abs(p.speed_mps) for p in points])
    turns = _turns(dxs, dys)
    exits = list(speeds)
    if not sum(turns) * TURN_RADIUS_M <= (1.0 - _ROUNDING) * 2 * _CORNER_M:  # or no curve is tight
        exits = [
            regulate(speed, curve, TURN_RADIUS_M, max(SLOWEST_MPS, SLOWEST_SHARE * speed))
            for speed, curve in zip(speeds, _curves(turns, along), strict=True)
        ]
    _brake(exits, gaps, PLANNED_DECEL * limits.max_decel_mps2)
    return Path(
        xs_m=xs,
        ys_m=ys,
        along_m=tuple(along[: len(xs)]),
        speeds_mps=speeds,
        exits_mps=tuple(exits),
        backwards=bool(points) and points[0].speed_mps < 0.0,
        heading_rad=points[-1].heading_rad if points else None,
    )


def _brake(exits: list[float], gaps: list[float], decel: float) -> None:
    """Lower the speeds so that the robot stands at the end and brakes in time for each point."""
    if not exits:
        return
    even = exits.count(exits[0]) == len(exits)
    exits[-1] = 0.0
    for i in range(len(gaps) - 1, -1, -1):
        fastest = sqrt(exits[i + 1] * exits[i + 1] + 2 * decel * gaps[i])
        if fastest < exits[i]:
            exits[i] = fastest
        elif even:
            return  # from here back all are as fast: nobody brakes for anybody


def _turns(dxs: list[float], dys: list[float]) -> list[float]:
    """Return how far the path turns at each point [rad], unsigned; nothing at both ends."""
    headings = list(map(atan2, dys, dxs))
    turns = [abs(wrap(b - a)) for a, b in pairwise(headings)]
    return [0.0, *turns, 0.0] if dxs else [0.0]


def _curves(turns: list[float], along: list[float]) -> list[float]:
    """Return the curve at each point [rad/m]: all turning within a corner's length, over it."""
    count = len(turns)
    curves = []
    low = high = 0
    turned = 0.0
    for i in range(count):
        while high < count and along[high] <= along[i] + _CORNER_M:
            turned += turns[high]
            high += 1
        while along[low] < along[i] - _CORNER_M:
            turned -= turns[low]
            low += 1
        curves.append(max(0.0, turned) / (2 * _CORNER_M))
    return curves


def residuals(
    x_m: float, y_m: float, heading_rad: float | None, robot_in_map: Pose2
) -> tuple[float, float]:
    """Return distance [m] and turn [rad] from a robot to an end point; no heading, no turn."""
    away = hypot(x_m - robot_in_map.x_m, y_m - robot_in_map.y_m)
    if heading_rad is None:
        return away, 0.0
    return away, abs(wrap(heading_rad - robot_in_map.yaw_rad))
