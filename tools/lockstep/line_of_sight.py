"""Tell whether a line from the camera to a point is free of what stands in the home. Geometry only.

Walls, furniture, people and what stands on the floor hide what is behind and below them; a table
hides nothing that lies on it.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import hypot, sqrt

from sim.site.shapes import Disc, Rect, Solid

Point = tuple[float, float, float]


def is_hidden(eye: Point, point: Point, solids: Iterable[Solid]) -> bool:
    """Tell whether any solid stands in the line from the eye to a point."""
    return any(_crosses(eye, point, solid) for solid in solids)


def _crosses(eye: Point, point: Point, solid: Solid) -> bool:
    """Tell whether the line passes through a solid below its top."""
    span = _span(eye, point, solid.shape)
    if span is None:
        return False
    lowest_m = min(eye[2] + share * (point[2] - eye[2]) for share in span)
    return lowest_m < solid.height_m - 1e-6


def _span(eye: Point, point: Point, shape: Rect | Disc) -> tuple[float, float] | None:
    """Return between which shares of the way a line lies over a shape, or None."""
    if isinstance(shape, Disc):
        return _over_disc(eye, point, shape)
    low, high = 0.0, 1.0
    sides = ((eye[0], point[0], shape.x0, shape.x1), (eye[1], point[1], shape.y0, shape.y1))
    for start, end, first, last in sides:
        length = end - start
        if abs(length) < 1e-9:
            if not first <= start <= last:
                return None
            continue
        one, other = (first - start) / length, (last - start) / length
        low, high = max(low, min(one, other)), min(high, max(one, other))
    return (low, high) if low < high else None


def _over_disc(eye: Point, point: Point, disc: Disc) -> tuple[float, float] | None:
    dx, dy = point[0] - eye[0], point[1] - eye[1]
    length = hypot(dx, dy)
    if length < 1e-9:
        return None
    along = ((disc.x - eye[0]) * dx + (disc.y - eye[1]) * dy) / length
    aside2 = (disc.x - eye[0]) ** 2 + (disc.y - eye[1]) ** 2 - along * along
    if aside2 >= disc.radius**2:
        return None
    half = sqrt(disc.radius**2 - aside2)
    low, high = max(0.0, (along - half) / length), min(1.0, (along + half) / length)
    return (low, high) if low < high else None
