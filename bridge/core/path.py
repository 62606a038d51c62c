"""Prepare a horizon for following: lengths along it, and the speed allowed at each point.

Owns what is computed once when a horizon is accepted. The end of any horizon is a stop for the
follower, so the speeds are those of a robot that brakes towards it. Knows no robot pose.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate
from math import atan2, hypot, sqrt
from typing import TYPE_CHECKING, ClassVar

from pydantic import ConfigDict

from wire.geometry import wrap

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


def regulated(speed_mps: float, curve_per_m: float, radius_m: float, slowest_mps: float) -> float:
    """Slow down on a curve tighter than ``radius_m``, in proportion, never below ``slowest_mps``.

    Source: regulated pure pursuit (Macenski and others, 2023).
    """
    tight = abs(curve_per_m) * radius_m
    if tight <= 1.0:
        return speed_mps
    return min(speed_mps, max(speed_mps / tight, slowest_mps))


def prepare(points: Sequence[Waypoint], limits: Limits) -> Path:
    """Make the path of an accepted horizon (see :mod:`bridge.core.horizon`)."""
    xs = tuple([p.x_m for p in points])
    ys = tuple([p.y_m for p in points])
    gaps = [hypot(xs[i + 1] - xs[i], ys[i + 1] - ys[i]) for i in range(len(xs) - 1)]
    along = list(accumulate(gaps, initial=0.0))
    speeds = tuple([abs(p.speed_mps) for p in points])
    curves = _curves(xs, ys, along)
    exits = [
        speed  # nearly always: spares the call
        if curve * TURN_RADIUS_M <= 1.0
        else regulated(speed, curve, TURN_RADIUS_M, max(SLOWEST_MPS, SLOWEST_SHARE * speed))
        for speed, curve in zip(speeds, curves, strict=True)
    ]
    if exits:
        exits[-1] = 0.0
    decel = PLANNED_DECEL * limits.max_decel_mps2
    for i in range(len(gaps) - 1, -1, -1):
        exits[i] = min(exits[i], sqrt(exits[i + 1] * exits[i + 1] + 2 * decel * gaps[i]))
    return Path(
        xs_m=xs,
        ys_m=ys,
        along_m=tuple(along[: len(xs)]),
        speeds_mps=speeds,
        exits_mps=tuple(exits),
        backwards=bool(points) and points[0].speed_mps < 0.0,
        heading_rad=points[-1].heading_rad if points else None,
    )


def _curves(xs: tuple[float, ...], ys: tuple[float, ...], along: list[float]) -> list[float]:
    """Return the curve at each point [rad/m]: all turning within a corner's length, over it."""
    count = len(xs)
    turns = [0.0] * count
    headings = [atan2(ys[i + 1] - ys[i], xs[i + 1] - xs[i]) for i in range(count - 1)]
    for i in range(1, count - 1):
        turns[i] = abs(wrap(headings[i] - headings[i - 1]))
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
