"""Turn a declaration into solids: walls from the rooms' edges less the doors, then furniture.

Owns the rule that a wall is where a room ends. Nothing else in the project knows where walls are.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from sim.site.shapes import EPS_M, Disc, Rect, Solid

if TYPE_CHECKING:
    from sim.site.spec import Furniture, Home, HomeDoor

Axis = Literal["x", "y"]
Line = tuple[Axis, float]
"""A wall's centre line: ("x", 3.0) is the line x = 3 m."""
Span = tuple[float, float]


def rect(box: tuple[float, float, float, float]) -> Rect:
    """Return a declared box as a rectangle."""
    return Rect(*box)


def room_rects(home: Home) -> dict[str, Rect]:
    """Return each room between its walls' centre lines."""
    return {room_id: rect(room.box) for room_id, room in home.rooms.items()}


def edges(room: Rect) -> tuple[tuple[Line, Span], ...]:
    """Return a room's four sides, each as its line and the span along it."""
    across, along = (room.x0, room.x1), (room.y0, room.y1)
    return (
        (("x", room.x0), along),
        (("x", room.x1), along),
        (("y", room.y0), across),
        (("y", room.y1), across),
    )


def door_edge(home: Home, door: HomeDoor) -> tuple[Line, Span] | None:
    """Return the line and the span that a door opens; None where its rooms share no such wall."""
    rooms = room_rects(home)
    if not all(room_id in rooms for room_id in door.between):
        return None
    here, there = (rooms[room_id] for room_id in door.between)
    for line, ours in edges(here):
        across, along = door.at if line[0] == "x" else door.at[::-1]
        span = (along - door.width_m / 2, along + door.width_m / 2)
        for other_line, theirs in edges(there):
            low, high = max(ours[0], theirs[0]), min(ours[1], theirs[1])
            on_line = _is_same_line(line, other_line) and abs(across - line[1]) <= EPS_M
            if on_line and low - EPS_M <= span[0] and span[1] <= high + EPS_M:
                return line, span
    return None


def _is_same_line(a: Line, b: Line) -> bool:
    return a[0] == b[0] and abs(a[1] - b[1]) <= EPS_M


def _merge(spans: list[Span]) -> list[Span]:
    joined: list[Span] = []
    for low, high in sorted(spans):
        if joined and low <= joined[-1][1] + EPS_M:
            joined[-1] = (joined[-1][0], max(high, joined[-1][1]))
        else:
            joined.append((low, high))
    return joined


def _cut(span: Span, holes: list[Span], half_m: float) -> list[Span]:
    """Cut holes from a wall's span; outer ends reach half a thickness further, to close corners."""
    pieces: list[Span] = []
    start = span[0] - half_m
    for low, high in sorted(holes):
        if low - start > EPS_M:
            pieces.append((start, low))
        start = high
    if span[1] + half_m - start > EPS_M:
        pieces.append((start, span[1] + half_m))
    return pieces


def _lines(home: Home) -> dict[Line, list[Span]]:
    lines: dict[Line, list[Span]] = {}
    for room in room_rects(home).values():
        for line, span in edges(room):
            lines.setdefault((line[0], round(line[1], 6)), []).append(span)
    return lines


def walls(home: Home) -> list[Solid]:
    """Return every wall as a solid, in a fixed order."""
    half_m = home.wall.thickness_m / 2
    doors = [edge for door in home.doors if (edge := door_edge(home, door)) is not None]
    found: list[Solid] = []
    for line, spans in sorted(_lines(home).items()):
        for span in _merge(spans):
            holes = [
                hole
                for door_line, hole in doors
                if _is_same_line(line, door_line) and span[0] - EPS_M <= hole[0] <= span[1]
            ]
            for low, high in _cut(span, holes, half_m):
                shape = _slab(line, low, high, half_m)
                found.append(Solid(f"wall_{len(found)}", shape, home.wall.height_m))
    return found


def _slab(line: Line, low: float, high: float, half_m: float) -> Rect:
    if line[0] == "x":
        return Rect(line[1] - half_m, low, line[1] + half_m, high)
    return Rect(low, line[1] - half_m, high, line[1] + half_m)


def furniture_shape(item: Furniture) -> Rect | Disc:
    """Return the outline of a piece of furniture."""
    if item.box is not None:
        return rect(item.box)
    if item.cylinder is not None:
        return Disc(*item.cylinder)
    raise ValueError("furniture without a shape")  # the spec refuses this earlier


def furniture(home: Home) -> list[Solid]:
    """Return the furniture as solids, in declared order."""
    return [
        Solid(item_id, furniture_shape(item), item.height_m)
        for item_id, item in home.furniture.items()
    ]


def solids(home: Home) -> list[Solid]:
    """Return all that stands on the floor."""
    return walls(home) + furniture(home)
