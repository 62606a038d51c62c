"""Refuse a home that a robot can't drive: overlaps, narrow doors, cramped or cut-off places.

Judges what needs several parts of a declaration at once. Every refusal names what came, what was
expected and, where names are concerned, what exists.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from itertools import combinations
from typing import TYPE_CHECKING

from sim.site.object_checks import Finding, check_things
from sim.site.objects import uprights
from sim.site.outline import allowed_rects, area_m2, edge_distance_m, trace
from sim.site.plan import door_edge, furniture, rect, room_rects, solids, walls
from sim.site.raster import draw, mark_inside, mark_near, reachable
from sim.site.shapes import EPS_M, Rect, Solid
from wire import ConfigError

if TYPE_CHECKING:
    from sim.site.spec import Home, HomePlace, PoseDeg, Room

DOOR_M = 0.90
PLACE_TO_OBSTACLE_M = 0.40
PLACE_TO_FENCE_M = 0.25
ROBOT_RADIUS_M = 0.30
SPARE_M = 0.05
"""What a route keeps beyond the robot's radius; a place counts as reachable only with it."""


def check(home: Home, where: str) -> None:
    """Judge a whole home, cheap things first.

    Raises:
        ConfigError: with the first finding's code; all findings of that stage stand in the text.
    """
    for stage in (_names, _plan, check_things, _places, _reach):
        findings = list(stage(home))
        if findings:
            text = "; ".join(detail for _, detail in findings)
            raise ConfigError(findings[0][0], f"{where}: {text}")


def spots(home: Home) -> dict[str, PoseDeg]:
    """Return every pose that a robot may be sent to, of rooms and of places."""
    rooms = {room_id: room.pose for room_id, room in home.rooms.items()}
    return rooms | {place_id: place.pose for place_id, place in home.places.items()}


def _names(home: Home) -> Iterator[Finding]:
    if home.dock not in home.places:
        known = ", ".join(sorted(home.places))
        yield "dock_unknown", f"dock {home.dock!r} is no place; places: {known}"
    for both in sorted(home.rooms.keys() & home.places.keys()):
        yield "id_taken", f"{both!r} is a room and a place"
    owner: dict[str, str] = {}
    named: list[tuple[str, Room | HomePlace]] = [*home.rooms.items(), *home.places.items()]
    for item_id, item in named:
        plain = item_id.replace("_", " ")
        for word in (plain, item.name.en, item.name.zh, *item.aliases.en, *item.aliases.zh):
            first = owner.setdefault(_fold(word), item_id)
            if first != item_id:
                yield "name_taken", f"{word!r} names both {first!r} and {item_id!r}"


def _fold(word: str) -> str:
    return " ".join(unicodedata.normalize("NFKC", word).casefold().split())


def _plan(home: Home) -> Iterator[Finding]:
    for (a, room_a), (b, room_b) in combinations(room_rects(home).items(), 2):
        if room_a.overlaps(room_b):
            yield "rooms_overlap", f"rooms {a!r} and {b!r} overlap"
    yield from _doors(home)
    for item in furniture(home):
        if not any(_holds(room, item.shape.bounds) for room in room_rects(home).values()):
            yield "furniture_outside", f"furniture {item.id!r} does not lie within one room"
    for wall in walls(home):
        for item in furniture(home):
            if isinstance(wall.shape, Rect) and item.shape.overlaps(wall.shape):
                yield "furniture_in_wall", f"furniture {item.id!r} stands in {wall.id}"
    loops = [loop for loop in trace(allowed_rects(home)) if area_m2(loop) > 0]
    if len(loops) != 1:
        yield "fence_apart", f"doors join the rooms into {len(loops)} areas, expected 1"


def _doors(home: Home) -> Iterator[Finding]:
    rooms = ", ".join(sorted(home.rooms))
    for door in home.doors:
        title = f"door {' - '.join(door.between)} at {list(door.at)}"
        unknown = [room_id for room_id in door.between if room_id not in home.rooms]
        if unknown:
            yield "room_unknown", f"{title}: no room {unknown[0]!r}; rooms: {rooms}"
        elif not door.width_m >= DOOR_M - EPS_M:
            yield "door_narrow", f"{title} is {door.width_m} m wide, at least {DOOR_M} m expected"
        elif door_edge(home, door) is None:
            yield "door_off_wall", f"{title} does not lie within a wall that its rooms share"


def _holds(outer: Rect, inner: Rect) -> bool:
    return outer.expand(EPS_M).depth(inner.x0, inner.y0) >= 0 and (
        outer.expand(EPS_M).depth(inner.x1, inner.y1) >= 0
    )


def _places(home: Home) -> Iterator[Finding]:
    rooms = room_rects(home)
    for spot_id, (x_m, y_m, _) in spots(home).items():
        title = f"{spot_id!r} at ({x_m}, {y_m})"
        if not any(area.depth(x_m, y_m) > 0 for area in rooms.values()):
            yield "place_outside", f"{title} lies in no room"
        elif spot_id in rooms and not rooms[spot_id].depth(x_m, y_m) > 0:
            yield "pose_outside_room", f"the pose of {title} lies outside the room"
        else:
            yield from _check_spare_room(home, title, (x_m, y_m))
            yield from _check_fence(home, title, (x_m, y_m))


def _standing(home: Home) -> list[Solid]:
    """Return all that a robot could touch, people and crates where they are declared."""
    return solids(home) + [upright.solid for upright in uprights(home)]


def _check_spare_room(home: Home, title: str, at: tuple[float, float]) -> Iterator[Finding]:
    nearest = min(_standing(home), key=lambda solid: solid.shape.distance(*at))
    found_m = nearest.shape.distance(*at)
    if not found_m >= PLACE_TO_OBSTACLE_M - EPS_M:
        found = f"{found_m:.3f} m from {nearest.id!r}"
        yield "place_near_obstacle", f"{title} is {found}, {PLACE_TO_OBSTACLE_M} m expected"


def _check_fence(home: Home, title: str, at: tuple[float, float]) -> Iterator[Finding]:
    closed = [rect(area.box) for area in home.fence.keep_outs]
    fence = trace(allowed_rects(home)) + [trace([area])[0] for area in closed]
    found_m = edge_distance_m(fence, *at)
    inside_allowed = any(area.depth(*at) > 0 for area in allowed_rects(home))
    if not inside_allowed or any(area.depth(*at) >= 0 for area in closed):
        yield "place_outside_fence", f"{title} lies outside the fence"
    elif not found_m >= PLACE_TO_FENCE_M - EPS_M:
        found = f"{found_m:.3f} m from the fence"
        yield "place_near_fence", f"{title} is {found}, at least {PLACE_TO_FENCE_M} m expected"


def _reach(home: Home) -> Iterator[Finding]:
    grid = draw(home)
    open_cells = ~mark_near(_standing(home), grid, ROBOT_RADIUS_M + SPARE_M)
    open_cells &= mark_inside(allowed_rects(home), grid)
    open_cells &= ~mark_inside([rect(area.box) for area in home.fence.keep_outs], grid)
    dock = home.places[home.dock].pose
    reached = reachable(open_cells, grid.cell(dock[0], dock[1]))
    for spot_id, (x_m, y_m, _) in spots(home).items():
        if not reached[grid.cell(x_m, y_m)]:
            title = f"{spot_id!r} at ({x_m}, {y_m})"
            yield "place_unreachable", f"{title} cannot be reached from {home.dock!r}"
