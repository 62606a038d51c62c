"""Join rectangles into one area and trace its edge as polygons.

Owns the fence's shape: rooms drawn in by the inset, and a passage through every door. Pure.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sim.site.plan import Line, door_edge, room_rects
from sim.site.shapes import Rect

if TYPE_CHECKING:
    from sim.site.spec import Home

Point = tuple[float, float]
Polygon = list[Point]


def allowed_rects(home: Home) -> list[Rect]:
    """Return the rectangles whose union is open to the robot's centre."""
    inset_m = home.wall.thickness_m / 2 + home.fence.inset_m
    areas = [room.expand(-inset_m) for room in room_rects(home).values()]
    for door in home.doors:
        edge = door_edge(home, door)
        if edge is not None:
            areas.append(_passage(edge[0], edge[1], inset_m, home.fence.inset_m))
    return areas


def _passage(line: Line, span: tuple[float, float], reach_m: float, inset_m: float) -> Rect:
    low, high = span[0] + inset_m, span[1] - inset_m
    if line[0] == "x":
        return Rect(line[1] - reach_m, low, line[1] + reach_m, high)
    return Rect(low, line[1] - reach_m, high, line[1] + reach_m)


def trace(areas: list[Rect]) -> list[Polygon]:
    """Trace the union of rectangles: outer edges counter-clockwise, holes clockwise.

    The coordinates that occur cut the plane into cells that are wholly in or out; the edges
    between in and out, walked with the inside on the left, are the polygons.
    """
    xs = sorted({round(v, 4) for area in areas for v in (area.x0, area.x1)})
    ys = sorted({round(v, 4) for area in areas for v in (area.y0, area.y1)})
    full = {
        (i, j)
        for i in range(len(xs) - 1)
        for j in range(len(ys) - 1)
        if any(a.depth((xs[i] + xs[i + 1]) / 2, (ys[j] + ys[j + 1]) / 2) > 0 for a in areas)
    }
    return [_straighten([(xs[i], ys[j]) for i, j in loop]) for loop in _loops(_edges(full))]


Corner = tuple[int, int]


def _edges(full: set[Corner]) -> dict[Corner, list[Corner]]:
    """Map each corner to the next ones along an edge that has the inside on its left."""
    out: dict[Corner, list[Corner]] = {}
    for i, j in sorted(full):
        for neighbour, start, end in (
            ((i, j - 1), (i, j), (i + 1, j)),
            ((i + 1, j), (i + 1, j), (i + 1, j + 1)),
            ((i, j + 1), (i + 1, j + 1), (i, j + 1)),
            ((i - 1, j), (i, j + 1), (i, j)),
        ):
            if neighbour not in full:
                out.setdefault(start, []).append(end)
    return out


def _loops(out: dict[Corner, list[Corner]]) -> list[list[Corner]]:
    loops: list[list[Corner]] = []
    while out:
        start = min(out)
        loop, here, back = [start], start, start
        while True:
            ahead = _turn(back, here, out[here])
            out[here].remove(ahead)
            if not out[here]:
                del out[here]
            back, here = here, ahead
            if here == start:
                break
            loop.append(here)
        loops.append(loop)
    return loops


def _turn(back: Corner, here: Corner, choices: list[Corner]) -> Corner:
    """Where two areas meet at a corner only, turn left: each keeps its own loop."""
    dx, dy = here[0] - back[0], here[1] - back[1]
    return max(choices, key=lambda to: dx * (to[1] - here[1]) - dy * (to[0] - here[0]))


def _straighten(loop: Polygon) -> Polygon:
    """Leave out the points in the middle of a straight edge."""
    kept = []
    for index, (x, y) in enumerate(loop):
        (xa, ya), (xb, yb) = loop[index - 1], loop[(index + 1) % len(loop)]
        if not (xa == x == xb or ya == y == yb):
            kept.append((x, y))
    return kept


def area_m2(polygon: Polygon) -> float:
    """Return the signed area; positive when counter-clockwise (shoelace formula)."""
    following = polygon[1:] + polygon[:1]
    return sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(polygon, following, strict=True)) / 2


def edge_distance_m(polygons: list[Polygon], x_m: float, y_m: float) -> float:
    """Return a point's distance to the nearest edge of any polygon [m]; edges are axis-aligned."""
    distances = []
    for polygon in polygons:
        for (xa, ya), (xb, yb) in zip(polygon, polygon[1:] + polygon[:1], strict=True):
            side = Rect(min(xa, xb), min(ya, yb), max(xa, xb), max(ya, yb))
            distances.append(side.distance(x_m, y_m))
    return min(distances)
