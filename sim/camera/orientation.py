"""Choose a thing's heading where its home declares none: into the room, or to its table."""

from __future__ import annotations

from math import atan2, degrees, pi, radians
from typing import TYPE_CHECKING

from sim.site.objects import furniture_class
from sim.site.plan import furniture_shape, room_rects, walls
from sim.site.shapes import Disc, Rect
from wire.geometry import wrap

if TYPE_CHECKING:
    from sim.site import Home

_EAST, _NORTH, _WEST, _SOUTH = 0.0, pi / 2, pi, -pi / 2
AT_TABLE_M = 0.8
"""A chair nearer to a table than this looks at it."""
_LONG_BACK = frozenset({"sofa", "tv"})
"""These have their back along a long side; a bed has its head at a short one."""


def front_rad(home: Home, thing_id: str) -> float:
    """Return where the front of a piece of furniture or a door looks [rad]."""
    if thing_id not in home.furniture:
        return _of_door(home, *home.objects[thing_id].at)
    item = home.furniture[thing_id]
    shape = furniture_shape(item)
    if item.yaw is not None:
        # A box keeps its outline: it looks along an axis.
        return radians(90 * round(item.yaw / 90) if isinstance(shape, Rect) else item.yaw)
    class_id = furniture_class(thing_id, item)
    if class_id == "chair":
        at_table = _to_table(home, shape)
        if at_table is not None:
            return (
                at_table if isinstance(shape, Disc) else radians(90 * round(degrees(at_table) / 90))
            )
    return _from_wall(home, shape.bounds, class_id)


def _to_table(home: Home, chair: Rect | Disc) -> float | None:
    box = chair.bounds
    x, y = (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2
    found: tuple[float, float] | None = None
    for other_id, other in home.furniture.items():
        if furniture_class(other_id, other) != "table":
            continue
        table = furniture_shape(other)
        if table.distance(x, y) <= AT_TABLE_M and (
            found is None or table.distance(x, y) < found[0]
        ):
            area = table.bounds
            # To the nearest point of the table's inside, so that chairs along a side stand square.
            near_x = min(max(x, area.x0 + 0.1), area.x1 - 0.1)
            near_y = min(max(y, area.y0 + 0.1), area.y1 - 0.1)
            found = (table.distance(x, y), atan2(near_y - y, near_x - x))
    return found[1] if found else None


def _from_wall(home: Home, box: Rect, class_id: str) -> float:
    x, y = (box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2
    room = next((r for r in room_rects(home).values() if r.depth(x, y) >= 0.0), box)
    gaps = {
        _EAST: box.x0 - room.x0, _WEST: room.x1 - box.x1,
        _NORTH: box.y0 - room.y0, _SOUTH: room.y1 - box.y1,
    }  # fmt: skip
    long_x = box.x1 - box.x0 > box.y1 - box.y0
    if class_id == "bed" or class_id in _LONG_BACK:
        along_x = long_x if class_id == "bed" else not long_x
        gaps = {f: gap for f, gap in gaps.items() if (f in (_EAST, _WEST)) == along_x}
    # Of two walls equally near, the one along a long side: cupboards open on theirs.
    return min(gaps, key=lambda front: (round(gaps[front], 2), (front in (_EAST, _WEST)) == long_x))


def _of_door(home: Home, x_m: float, y_m: float) -> float:
    for wall in walls(home):
        area = wall.shape.bounds
        if area.distance(x_m, y_m) <= 0.0:
            return wrap(_NORTH if area.x1 - area.x0 > area.y1 - area.y0 else _EAST)
    return _NORTH
