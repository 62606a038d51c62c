"""Answer questions about simple polygons in ``map``. Mathematics only: metres in, metres out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]
Polygon: TypeAlias = Sequence[Point]


def edges(polygon: Polygon) -> Iterator[tuple[Point, Point]]:
    """Yield each side, the closing one included."""
    for index, corner in enumerate(polygon):
        yield polygon[index - 1], corner


def area_m2(polygon: Polygon) -> float:
    """Return the area enclosed (shoelace formula), of either winding."""
    return abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in edges(polygon))) / 2


def contains(polygon: Polygon, x_m: float, y_m: float) -> bool:
    """Tell whether a point lies inside: a ray towards +x crosses an odd number of sides."""
    inside = False
    for (ax, ay), (bx, by) in edges(polygon):
        if (ay > y_m) != (by > y_m) and x_m < (bx - ax) * (y_m - ay) / (by - ay) + ax:
            inside = not inside
    return inside


def border_distance_m(polygon: Polygon, x_m: float, y_m: float) -> float:
    """Return the distance from a point to the nearest side [m]."""
    return min(_to_segment_m(a, b, x_m, y_m) for a, b in edges(polygon))


def _to_segment_m(a: Point, b: Point, x_m: float, y_m: float) -> float:
    dx, dy = b[0] - a[0], b[1] - a[1]
    length2 = dx * dx + dy * dy
    along = ((x_m - a[0]) * dx + (y_m - a[1]) * dy) / length2 if length2 > 0 else 0.0
    along = min(1.0, max(0.0, along))
    return hypot(x_m - a[0] - along * dx, y_m - a[1] - along * dy)
