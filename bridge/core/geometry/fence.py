"""Bound where the robot's centre may be, in ``map``, and do the plane geometry of its outlines.

Owns the meaning of a fence: inside at least one allowed outline and inside no keep-out. Everything
that a tick asks is prepared once, cell by cell. Reads no file and knows no robot.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from math import floor, inf, sqrt

from wire.fence import MarksFile

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


SIGHT_M = 1.0
"""Distances to the boundary are told up to here; nobody acts on a fence that is further off."""
_CELLS = 48  # at most so many along either side
_MIN_CELL_M = 0.25
_MARKED_KEPT = 8


@dataclass(frozen=True, slots=True)
class Zone:
    """Slow the robot while its centre is inside an outline."""

    polygon: Polygon
    max_speed_mps: float


@dataclass(frozen=True, slots=True)
class ZoneShape:
    """Hold what every tick asks of a zone."""

    zone: Zone
    edges: tuple[Edge, ...]
    box: tuple[float, float, float, float]
    """Least x, y and most x, y [m] from which it can be seen."""


@dataclass(frozen=True, slots=True)
class FenceCell:
    """Hold the fence's edges near one square of the floor."""

    edges: tuple[Edge, ...]
    """All of the boundary within sight of any point of the square."""
    inside: bool | None
    """The square is wholly inside, or wholly outside; None where the boundary runs through."""


@dataclass(frozen=True, slots=True)
class FenceGrid:
    """Hold the outlines and their common boundary. Make it with :func:`build_fence`."""

    map_id: str
    allowed: tuple[Polygon, ...]
    keep_outs: tuple[Polygon, ...]
    zones: tuple[Zone, ...]
    boundary: tuple[Edge, ...]
    """The lines that part inside from outside: no line between two overlapping outlines is one."""
    shapes: tuple[ZoneShape, ...]
    cell_m: float
    cells: dict[tuple[int, int], FenceCell]
    """Every square from which the boundary, or its inside, can be seen."""
    marked: dict[str, FenceGrid] = field(default_factory=dict, compare=False, repr=False)
    """This fence less marks, by their text, as far as it was asked for."""

    def allows(self, x_m: float, y_m: float) -> bool:
        """Return whether the robot's centre may be at a point; NaN is nowhere allowed."""
        cell = self._cell(x_m, y_m)
        if cell is None:
            return False
        if cell.inside is not None:
            return cell.inside
        return permits(self.allowed, self.keep_outs, x_m, y_m)

    def margin_m(self, x_m: float, y_m: float) -> float:
        """Return the distance to the boundary [m], negative outside; beyond sight, sight."""
        cell = self._cell(x_m, y_m)
        if cell is None:
            return -SIGHT_M
        distance = min(SIGHT_M, nearest_m(cell.edges, x_m, y_m))
        inside = cell.inside
        if inside is None:
            inside = permits(self.allowed, self.keep_outs, x_m, y_m)
        return distance if inside else -distance

    def crosses(self, x0_m: float, y0_m: float, x1_m: float, y1_m: float) -> bool:
        """Tell whether a segment touches the boundary or lies outside it.

        Accepts only what is proved: a coordinate that is not a number crosses.
        """
        if not (self.allows(x0_m, y0_m) and self.allows(x1_m, y1_m)):
            return True
        dx, dy = x1_m - x0_m, y1_m - y0_m
        cell = self._cell(x0_m, y0_m)
        short = cell is not None and dx * dx + dy * dy <= SIGHT_M * SIGHT_M
        edges = cell.edges if cell is not None and short else self.boundary
        return any(meet(x0_m, y0_m, dx, dy, edge) for edge in edges)

    def zones_near(self, x_m: float, y_m: float) -> list[tuple[float, float]]:
        """Return how far each zone within sight is [m], 0 inside it, with its speed."""
        found = []
        for shape in self.shapes:
            low_x, low_y, high_x, high_y = shape.box
            if not (low_x <= x_m <= high_x and low_y <= y_m <= high_y):
                continue
            inside = contains(shape.zone.polygon, x_m, y_m)
            gap_m = 0.0 if inside else nearest_m(shape.edges, x_m, y_m)
            found.append((gap_m, shape.zone.max_speed_mps))
        return found

    def with_marks(self, text: str, kept: str = "") -> FenceGrid:
        """Return this fence less what people drew on the map, by its text; no text, no change.

        Prepared once: the thread that reads marks asks first, so that no tick waits for it.

        Args:
            text: the marks.
            kept: the marks in force, which stay prepared however many others are asked for.
        """
        found = self.marked.get(text)
        if found is None:
            marks = MarksFile.model_validate_json(text)
            drawn = tuple(Zone(each.polygon, each.max_speed_mps) for each in marks.speed_zones)
            keep_outs = (*self.keep_outs, *marks.keep_outs)
            found = build_fence(self.map_id, self.allowed, keep_outs, (*self.zones, *drawn))
            while len(self.marked) >= _MARKED_KEPT:
                self.marked.pop(next(each for each in self.marked if each != kept))
            self.marked[text] = found
        return found

    def _cell(self, x_m: float, y_m: float) -> FenceCell | None:
        if abs(x_m) < 1e6 and abs(y_m) < 1e6:
            return self.cells.get((floor(x_m / self.cell_m), floor(y_m / self.cell_m)))
        return None


def build_fence(
    map_id: str,
    allowed: tuple[Polygon, ...],
    keep_outs: tuple[Polygon, ...] = (),
    zones: tuple[Zone, ...] = (),
) -> FenceGrid:
    """Prepare a fence: cut every outline where others cross it and keep the parts that bound."""
    edges = [edge for outline in (*allowed, *keep_outs) for edge in edges_of(outline)]
    boundary = tuple(
        part for edge in edges for part in cut(edge, edges) if bounds(part, allowed, keep_outs)
    )
    xs = [x for outline in allowed for x, _ in outline]
    ys = [y for outline in allowed for _, y in outline]
    wide = max(
        max(xs, default=0.0) - min(xs, default=0.0), max(ys, default=0.0) - min(ys, default=0.0)
    )
    cell_m = max(_MIN_CELL_M, wide / _CELLS)
    cells = {
        (i, j): _cell_at(
            (i + 0.5) * cell_m, (j + 0.5) * cell_m, cell_m, boundary, allowed, keep_outs
        )
        for i in _range(xs, cell_m)
        for j in _range(ys, cell_m)
    }
    shapes = tuple(map(_shape_of, zones))
    return FenceGrid(map_id, allowed, keep_outs, zones, boundary, shapes, cell_m, cells)


def _shape_of(zone: Zone) -> ZoneShape:
    xs, ys = [x for x, _ in zone.polygon], [y for _, y in zone.polygon]
    box = (min(xs) - SIGHT_M, min(ys) - SIGHT_M, max(xs) + SIGHT_M, max(ys) + SIGHT_M)
    return ZoneShape(zone, tuple(edges_of(zone.polygon)), box)


def _range(values: list[float], cell_m: float) -> range:
    if not values:
        return range(0)
    return range(
        floor((min(values) - SIGHT_M) / cell_m), floor((max(values) + SIGHT_M) / cell_m) + 1
    )


def _cell_at(
    x_m: float,
    y_m: float,
    cell_m: float,
    boundary: tuple[Edge, ...],
    allowed: tuple[Polygon, ...],
    keep_outs: tuple[Polygon, ...],
) -> FenceCell:
    """Gather the edges near the square around a point."""
    half = cell_m / sqrt(2) + 1e-6
    near = tuple(e for e in boundary if nearest_m((e,), x_m, y_m) <= SIGHT_M + half)
    inside = None
    if min((nearest_m((e,), x_m, y_m) for e in near), default=inf) > half:
        inside = permits(allowed, keep_outs, x_m, y_m)
    return FenceCell(near, inside)
