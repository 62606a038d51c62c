"""Check a home's objects and people: off their table, in a wall, in the way.

Names every finding; ``check`` decides once.
"""

from __future__ import annotations

from itertools import combinations
from math import hypot
from typing import TYPE_CHECKING

from sim.site.classes import SPARE_OBSTACLES
from sim.site.objects import object_outline, on_floor, uprights
from sim.site.plan import furniture_shape, room_rects, solids, walls
from sim.site.shapes import EPS_M, Disc, Rect, Shape, Solid
from sim.site.spec import LIDAR_SEES_FROM_M

if TYPE_CHECKING:
    from collections.abc import Iterator

    from sim.site.spec import Home, Object

Finding = tuple[str, str]
"""A stable code, and what came and what was expected."""
FLAT_M = 0.05
"""What is no higher than this a robot's wheels roll over, as over a door sill."""


def check_things(home: Home) -> Iterator[Finding]:
    """Yield the faults of a home's objects and people."""
    yield from _names(home)
    for object_id, item in home.objects.items():
        title = f"object {object_id!r} at {list(item.at)}"
        if item.class_id == "door":
            yield from _check_hung(home, title, item)
        elif isinstance(item.on, str):
            yield from _check_support(home, title, item)
        else:
            yield from _free_of_walls(home, title, object_outline(item))
            yield from _not_a_trap(title, item)
    yield from _standing(home)


def _names(home: Home) -> Iterator[Finding]:
    taken = [*home.furniture, *SPARE_OBSTACLES]
    for thing_id in [*home.objects, *home.people]:
        if thing_id in taken:
            yield "id_taken", f"{thing_id!r} is taken by furniture, another thing or the simulator"
        taken.append(thing_id)


def _check_support(home: Home, title: str, item: Object) -> Iterator[Finding]:
    under = home.furniture.get(str(item.on))
    if under is None:
        known = ", ".join(sorted(home.furniture))
        yield "object_on_unknown", f"{title} is on {item.on!r}, no furniture; there is: {known}"
    elif not _contains(furniture_shape(under), object_outline(item)):
        yield "object_off_furniture", f"{title} reaches over the edge of {item.on!r}"


def _contains(outer: Shape, inner: Shape) -> bool:
    if isinstance(outer, Rect):
        box, whole = inner.bounds, outer.expand(EPS_M)
        return whole.depth(box.x0, box.y0) >= 0.0 and whole.depth(box.x1, box.y1) >= 0.0
    if isinstance(inner, Disc):
        apart = hypot(inner.x - outer.x, inner.y - outer.y)
        return apart + inner.radius <= outer.radius + EPS_M
    corners = [(x, y) for x in (inner.x0, inner.x1) for y in (inner.y0, inner.y1)]
    return all(outer.distance(*corner) <= EPS_M for corner in corners)


def _check_hung(home: Home, title: str, item: Object) -> Iterator[Finding]:
    """Check that one wall holds a door in its whole breadth."""
    for wall in walls(home):
        area = wall.shape.bounds
        along = (area.x0, area.x1) if area.x1 - area.x0 > area.y1 - area.y0 else (area.y0, area.y1)
        at = item.at[0] if along == (area.x0, area.x1) else item.at[1]
        half_m = item.size_m[1] / 2
        fits = along[0] - EPS_M <= at - half_m and at + half_m <= along[1] + EPS_M
        if area.distance(*item.at) <= 0.0 and fits:
            return
    yield "object_off_wall", f"{title} is a door but does not lie within one wall"


def _free_of_walls(home: Home, title: str, shape: Shape) -> Iterator[Finding]:
    box = shape.bounds
    corners = ((box.x0, box.y0), (box.x1, box.y1))
    if not any(
        all(room.depth(*corner) >= 0.0 for corner in corners) for room in room_rects(home).values()
    ):
        yield "object_outside", f"{title} does not lie within one room"
        return
    for wall in walls(home):
        if isinstance(wall.shape, Rect) and shape.overlaps(wall.shape):
            yield "object_in_wall", f"{title} reaches into {wall.id}"


def _not_a_trap(title: str, item: Object) -> Iterator[Finding]:
    if on_floor(item) and not (item.size_m[2] <= FLAT_M or item.size_m[2] >= LIDAR_SEES_FROM_M):
        reason = (
            f"the lidar does not see what is lower than {LIDAR_SEES_FROM_M} m and a robot drives "
            f"over at most {FLAT_M} m; make it higher or lay it on furniture"
        )
        yield "object_trap", f"{title} stands {item.size_m[2]} m high on the floor: {reason}"


def _standing(home: Home) -> Iterator[Finding]:
    things = [upright.solid for upright in uprights(home)]
    for thing in things:
        if thing.id in home.people:
            title = f"person {thing.id!r} at {list(home.people[thing.id].at)}"
            yield from _free_of_walls(home, title, thing.shape)
        for solid in solids(home):
            if not solid.id.startswith("wall_") and _meet(thing, solid):
                yield "object_in_furniture", f"{thing.id!r} stands in {solid.id!r}"
    for a, b in combinations(things, 2):
        if _meet(a, b):
            yield "objects_overlap", f"{a.id!r} and {b.id!r} stand in each other"


def _meet(a: Solid, b: Solid) -> bool:
    if isinstance(b.shape, Rect):
        return a.shape.overlaps(b.shape)
    if isinstance(a.shape, Rect):
        return b.shape.overlaps(a.shape)
    return a.shape.distance(b.shape.x, b.shape.y) < b.shape.radius - EPS_M
