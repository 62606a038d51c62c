"""Do the plane geometry of outlines: inside, cut, touch, distance. Knows no fence."""

from __future__ import annotations

from itertools import pairwise
from math import inf, sqrt

Point = tuple[float, float]
Polygon = tuple[Point, ...]
Edge = tuple[float, float, float, float, float]
"""Start x, y [m], span x, y [m], and the span's squared length [m2]."""

_BESIDE_M = 1e-6
"""How far beside an edge one looks to see whether it parts inside from outside."""


def contains(polygon: Polygon, x_m: float, y_m: float) -> bool:
    """Tell whether a point is inside an outline (even-odd rule); not a number is outside."""
    inside = False
    xa, ya = polygon[-1]
    for xb, yb in polygon:
        if (ya > y_m) != (yb > y_m) and x_m < xa + (y_m - ya) * (xb - xa) / (yb - ya):
            inside = not inside
        xa, ya = xb, yb
    return inside


def permits(
    allowed: tuple[Polygon, ...], keep_outs: tuple[Polygon, ...], x: float, y: float
) -> bool:
    """Tell whether a point is inside an allowed outline and inside no keep-out."""
    return any(contains(outline, x, y) for outline in allowed) and not any(
        contains(outline, x, y) for outline in keep_outs
    )


def edges_of(outline: Polygon) -> list[Edge]:
    """Return an outline's edges, closing one included."""
    return [
        _edge(xa, ya, xb, yb)
        for (xa, ya), (xb, yb) in zip(outline, outline[1:] + outline[:1], strict=True)
        if (xa, ya) != (xb, yb)
    ]


def _edge(xa: float, ya: float, xb: float, yb: float) -> Edge:
    dx, dy = xb - xa, yb - ya
    return xa, ya, dx, dy, max(dx * dx + dy * dy, 1e-300)


def cut(edge: Edge, others: list[Edge]) -> list[Edge]:
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


def bounds(part: Edge, allowed: tuple[Polygon, ...], keep_outs: tuple[Polygon, ...]) -> bool:
    """Tell whether a line has the permitted on one side only."""
    x0, y0, dx, dy, length2 = part
    step = 10 * _BESIDE_M / sqrt(length2)
    x, y = x0 + dx / 2, y0 + dy / 2
    left = permits(allowed, keep_outs, x - dy * step, y + dx * step)
    right = permits(allowed, keep_outs, x + dy * step, y - dx * step)
    return left != right


def meet(x0: float, y0: float, dx: float, dy: float, edge: Edge) -> bool:
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


def nearest_m(edges: tuple[Edge, ...], x_m: float, y_m: float) -> float:
    """Return the distance to the nearest edge [m]; infinite without any, NaN beside no number."""
    nearest = inf
    for x0, y0, dx, dy, length2 in edges:
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
