"""Bound where the robot's centre may be, in ``map``.

Owns the meaning of a fence: inside at least one allowed outline and inside no keep-out. Plain
mathematics over edges that are prepared once; reads no file and knows no robot.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import inf, sqrt

Point = tuple[float, float]
Polygon = tuple[Point, ...]
Edge = tuple[float, float, float, float, float]
"""Start x, y [m], span x, y [m], and the span's squared length [m2]."""

_BESIDE_M = 1e-6
"""How far beside an edge one looks to see whether it parts inside from outside."""


@dataclass(frozen=True, slots=True)
class Zone:
    """Slow the robot while its centre is inside an outline."""

    polygon: Polygon
    max_speed_mps: float


@dataclass(frozen=True, slots=True)
class Fence:
    """Hold the outlines and their common boundary. Make it with :func:`build_fence`."""

    map_id: str
    allowed: tuple[Polygon, ...]
    keep_outs: tuple[Polygon, ...]
    zones: tuple[Zone, ...]
    boundary: tuple[Edge, ...]
    """The lines that part inside from outside: no line between two overlapping outlines is one."""

    def allows(self, x_m: float, y_m: float) -> bool:
        """Tell whether the centre may be at a point."""
        return _permits(self.allowed, self.keep_outs, x_m, y_m)

    def distance_m(self, x_m: float, y_m: float) -> float:
        """Return how far a point is from the boundary [m], on either side; NaN beside no number."""
        nearest = inf
        for x0, y0, dx, dy, length2 in self.boundary:
            px, py = x_m - x0, y_m - y0
            along = (px * dx + py * dy) / length2
            if along > 0.0:
                if along > 1.0:
                    along = 1.0
                px -= along * dx
                py -= along * dy
            square = px * px + py * py
            if not square >= nearest:
                nearest = square
        return sqrt(nearest) if nearest >= 0.0 else nearest

    def margin_m(self, x_m: float, y_m: float) -> float:
        """Return the distance to the boundary [m], negative outside."""
        distance = self.distance_m(x_m, y_m)
        return distance if self.allows(x_m, y_m) else -distance

    def crosses(self, x0_m: float, y0_m: float, x1_m: float, y1_m: float) -> bool:
        """Tell whether a segment touches the boundary or lies outside it.

        Accepts only what is proved: a coordinate that is not a number crosses.
        """
        if not (self.allows(x0_m, y0_m) and self.allows(x1_m, y1_m)):
            return True
        dx, dy = x1_m - x0_m, y1_m - y0_m
        return any(_meet(x0_m, y0_m, dx, dy, edge) for edge in self.boundary)

    def max_speed_mps(self, x_m: float, y_m: float) -> float | None:
        """Return the slowest zone's speed at a point; None where there is no zone."""
        slowest = None
        for zone in self.zones:
            if contains(zone.polygon, x_m, y_m) and not (
                slowest is not None and slowest <= zone.max_speed_mps
            ):
                slowest = zone.max_speed_mps
        return slowest


def build_fence(
    map_id: str,
    allowed: tuple[Polygon, ...],
    keep_outs: tuple[Polygon, ...] = (),
    zones: tuple[Zone, ...] = (),
) -> Fence:
    """Prepare a fence: cut every outline where others cross it and keep the parts that bound."""
    edges = [edge for outline in (*allowed, *keep_outs) for edge in _edges(outline)]
    boundary = tuple(
        part for edge in edges for part in _cut(edge, edges) if _bounds(part, allowed, keep_outs)
    )
    return Fence(map_id, allowed, keep_outs, zones, boundary)


def contains(polygon: Polygon, x_m: float, y_m: float) -> bool:
    """Tell whether a point is inside an outline (even-odd rule); not a number is outside."""
    inside = False
    xa, ya = polygon[-1]
    for xb, yb in polygon:
        if (ya > y_m) != (yb > y_m) and x_m < xa + (y_m - ya) * (xb - xa) / (yb - ya):
            inside = not inside
        xa, ya = xb, yb
    return inside


def _permits(
    allowed: tuple[Polygon, ...], keep_outs: tuple[Polygon, ...], x: float, y: float
) -> bool:
    return any(contains(outline, x, y) for outline in allowed) and not any(
        contains(outline, x, y) for outline in keep_outs
    )


def _edges(outline: Polygon) -> list[Edge]:
    return [
        _edge(xa, ya, xb, yb)
        for (xa, ya), (xb, yb) in zip(outline, outline[1:] + outline[:1], strict=True)
        if (xa, ya) != (xb, yb)
    ]


def _edge(xa: float, ya: float, xb: float, yb: float) -> Edge:
    dx, dy = xb - xa, yb - ya
    return xa, ya, dx, dy, max(dx * dx + dy * dy, 1e-300)


def _cut(edge: Edge, others: list[Edge]) -> list[Edge]:
    """Cut an edge wherever another one meets it, end points of others on it included."""
    x0, y0, dx, dy, length2 = edge
    cuts = {0.0, 1.0}
    for ox, oy, ux, uy, _ in others:
        for px, py in ((ox, oy), (ox + ux, oy + uy)):
            off = dx * (py - y0) - dy * (px - x0)
            if off * off <= length2 * _BESIDE_M * _BESIDE_M:
                cuts.add(((px - x0) * dx + (py - y0) * dy) / length2)
        cross = dx * uy - dy * ux
        if cross != 0.0:
            along = ((ox - x0) * uy - (oy - y0) * ux) / cross
            across = ((ox - x0) * dy - (oy - y0) * dx) / cross
            if 0.0 <= across <= 1.0:
                cuts.add(along)
    marks = sorted(cut for cut in cuts if 0.0 <= cut <= 1.0)
    return [
        _edge(x0 + a * dx, y0 + a * dy, x0 + b * dx, y0 + b * dy)
        for a, b in pairwise(marks)
        if (b - a) * (b - a) * length2 > _BESIDE_M * _BESIDE_M
    ]


def _bounds(part: Edge, allowed: tuple[Polygon, ...], keep_outs: tuple[Polygon, ...]) -> bool:
    """Tell whether a line has the permitted on one side only."""
    x0, y0, dx, dy, length2 = part
    step = 10 * _BESIDE_M / sqrt(length2)
    x, y = x0 + dx / 2, y0 + dy / 2
    left = _permits(allowed, keep_outs, x - dy * step, y + dx * step)
    right = _permits(allowed, keep_outs, x + dy * step, y - dx * step)
    return left != right


def _meet(x0: float, y0: float, dx: float, dy: float, edge: Edge) -> bool:
    """Tell whether a segment touches an edge, ends included."""
    ex, ey, ux, uy, _ = edge
    cross = dx * uy - dy * ux
    px, py = ex - x0, ey - y0
    if cross == 0.0:
        return px * dy == py * dx and _overlap(px, py, dx, dy, ux, uy)
    along = (px * uy - py * ux) / cross
    across = (px * dy - py * dx) / cross
    return 0.0 <= along <= 1.0 and 0.0 <= across <= 1.0


def _overlap(px: float, py: float, dx: float, dy: float, ux: float, uy: float) -> bool:
    """Tell whether two parallel segments on one line share a point; p leads to the second's start.

    A segment of no length is a point, and on the line if it is between the second's ends.
    """
    length2 = dx * dx + dy * dy
    if length2 == 0.0:
        along = -(px * ux + py * uy)
        return px * uy == py * ux and 0.0 <= along <= ux * ux + uy * uy
    start = px * dx + py * dy
    end = start + ux * dx + uy * dy
    return min(start, end) <= length2 and max(start, end) >= 0.0
