"""Change a declared home as a domain says: furniture moved, leaves hung in doors, walkers placed.

Pure: the same home and domain give the same home, so that simulator and camera, which are two
processes, agree without a word. Map, places and fence stay as they were declared: that they are
wrong now is the point.
"""

from __future__ import annotations

from math import hypot
from random import Random
from typing import TYPE_CHECKING

import numpy as np

from sim.site.classes import PERSON_RADIUS_M
from sim.site.objects import LEAF
from sim.site.plan import door_edge, furniture_shape, room_rects, solids, walls
from sim.site.raster import draw, mark_near, reachable
from sim.site.shapes import Disc, Rect, Shape
from sim.site.spec import HomePerson, Object
from sim.walking_floor import WalkingFloor
from wire import ConfigError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from sim.domain import Domain
    from sim.site import Home
    from sim.site.spec import Furniture

MAPPED = "mapped"
"""The name of a home that was made of a map alone (sim.site.mapped)."""
MOVED_M = 0.5
MOVES_TRIED = 20
BESIDE_M = 0.05
DOOR_CLEAR_M = 0.6
"""Beyond half its width a doorway stays clear."""
PLACE_CLEAR_M = 0.45
ROBOT_CLEAR_M = 0.37
"""Radius of the default robot, its gate's 0.05 m, and half a cell's diagonal."""
WALKER_FROM_DOCK_M = 1.5
LEAF_M = 0.06
LEAF_HEIGHT_M = 2.0
MOST_THINGS = 64
"""As many as one scene on the wire holds."""


def staged_home(home: Home, domain: Domain) -> Home:
    """Return the home as it is in this domain; the home itself where nothing of it changes.

    Raises:
        ConfigError: ``domain_needs_home`` where a knob needs what a map alone does not say,
            ``domain_crowded``, or ``walkers_without_floor``.
    """
    if home.site == MAPPED and (domain.furniture_moved_share > 0.0 or domain.doors > 0):
        text = (
            "furniture_moved_share and doors need a site with a home.yaml: a map alone says "
            "neither what is furniture nor where doors are; all other knobs work"
        )
        raise ConfigError("domain_needs_home", text)
    if domain.furniture_moved_share > 0.0:
        home = _with_moved_furniture(home, domain)
    if domain.doors > 0:
        home = home.model_copy(update={"objects": {**home.objects, **_leaves(home, domain)}})
    if domain.polite_walkers + domain.blind_walkers > 0:
        home = home.model_copy(update={"people": {**home.people, **_walkers(home, domain)}})
    things = len(home.objects) + len(home.people) + 4
    if things > MOST_THINGS:
        text = f"{things} movable things; at most {MOST_THINGS}: take fewer doors or walkers"
        raise ConfigError("domain_crowded", text)
    return home


def walker_names(domain: Domain) -> tuple[str, ...]:
    """Return the names under which walkers are people of the home, the polite ones first."""
    polite = tuple(f"polite_{index}" for index in range(domain.polite_walkers))
    return polite + tuple(f"blind_{index}" for index in range(domain.blind_walkers))


def null_patches(home: Home, domain: Domain) -> NDArray[np.float64] | None:
    """Return discs (x, y, radius) on walls and furniture that return no beam; None for none."""
    if domain.lidar_null_patches == 0:
        return None
    random = Random(f"patches {domain.seed}")
    shapes: list[Shape] = [wall.shape for wall in walls(home)]
    shapes += [furniture_shape(item) for item in home.furniture.values()]
    rows = []
    for _ in range(domain.lidar_null_patches):
        box = random.choice(shapes).bounds
        along, side = random.random(), random.randrange(4)
        x_m = box.x0 + along * (box.x1 - box.x0) if side < 2 else (box.x0, box.x1)[side - 2]
        y_m = (box.y0, box.y1)[side] if side < 2 else box.y0 + along * (box.y1 - box.y0)
        rows.append((x_m, y_m, random.uniform(0.2, 0.5)))
    return np.array(rows)


def _walkers(home: Home, domain: Domain) -> dict[str, HomePerson]:
    floor = WalkingFloor(home)
    random = Random(f"walkers {domain.seed}")
    dock = home.places[home.dock].pose
    taken = [(dock[0], dock[1], WALKER_FROM_DOCK_M)]
    found = {}
    for name in walker_names(domain):
        x_m, y_m = floor.draw_spot(random, taken)
        taken.append((x_m, y_m, 3 * PERSON_RADIUS_M))
        found[name] = HomePerson(at=(round(x_m, 3), round(y_m, 3)), yaw=0.0)
    return found


def _leaves(home: Home, domain: Domain) -> dict[str, Object]:
    """Return a leaf for each door that has one, as it stands shut."""
    count = min(domain.doors, len(home.doors))
    numbers = sorted(Random(f"doors {domain.seed}").sample(range(len(home.doors)), count))
    leaves = {}
    for number in numbers:
        door = home.doors[number]
        edge = door_edge(home, door)
        if edge is None:
            continue
        across_x = edge[0][0] == "x"
        size = (LEAF_M, door.width_m, LEAF_HEIGHT_M)
        leaves[f"{LEAF}{number}"] = Object(
            **{"class": "door"}, color="brown", at=door.at, yaw=0.0 if across_x else 90.0, size=size
        )
    return leaves


def _with_moved_furniture(home: Home, domain: Domain) -> Home:
    """Shift some pieces, each by at most 0.5 m, wherever the robot's ways stay joined."""
    random = Random(f"furniture {domain.seed}")
    for item_id in list(home.furniture):
        moves = random.random() < domain.furniture_moved_share
        for _ in range(MOVES_TRIED if moves else 0):
            by = (random.uniform(-MOVED_M, MOVED_M), random.uniform(-MOVED_M, MOVED_M))
            moved = _shift(home, item_id, by)
            if _has_room(moved, item_id) and _is_joined(moved):
                home = moved
                break
    return home


def _shift(home: Home, item_id: str, by: tuple[float, float]) -> Home:
    """Return the home with one piece, and what lies on it, shifted."""
    dx, dy = round(by[0], 2), round(by[1], 2)
    item = home.furniture[item_id]
    if item.box is not None:
        x0, y0, x1, y1 = item.box
        told: dict[str, object] = {"box": (x0 + dx, y0 + dy, x1 + dx, y1 + dy)}
    elif item.cylinder is not None:
        x, y, radius = item.cylinder
        told = {"cylinder": (x + dx, y + dy, radius)}
    else:
        return home
    objects = {
        name: one.model_copy(update={"at": (one.at[0] + dx, one.at[1] + dy)})
        if one.on == item_id
        else one
        for name, one in home.objects.items()
    }
    furniture: dict[str, Furniture] = {**home.furniture, item_id: item.model_copy(update=told)}
    return home.model_copy(update={"furniture": furniture, "objects": objects})


def _has_room(home: Home, item_id: str) -> bool:
    """Return whether a piece stands in one room, beside all others, off doors, places, people."""
    shape = furniture_shape(home.furniture[item_id])
    box = shape.bounds.expand(BESIDE_M)
    half_m = home.wall.thickness_m / 2
    rooms = [room.expand(-half_m) for room in room_rects(home).values()]
    others = [furniture_shape(one) for name, one in home.furniture.items() if name != item_id]
    keep = [Disc(*door.at, door.width_m / 2 + DOOR_CLEAR_M) for door in home.doors]
    keep += [Disc(*place.pose[:2], PLACE_CLEAR_M) for place in home.places.values()]
    keep += [Disc(*room.pose[:2], PLACE_CLEAR_M) for room in home.rooms.values()]
    keep += [Disc(*person.at, PERSON_RADIUS_M) for person in home.people.values()]
    keep += [
        Disc(*one.at, hypot(one.size_m[0], one.size_m[1]) / 2)
        for one in home.objects.values()
        if one.on == 0.0
    ]
    return (
        any(_holds(room, box) for room in rooms)
        and not any(box.overlaps(other.bounds) for other in others)
        and not any(disc.overlaps(box) for disc in keep)
    )


def _holds(room: Rect, box: Rect) -> bool:
    return room.x0 <= box.x0 and room.y0 <= box.y0 and box.x1 <= room.x1 and box.y1 <= room.y1


def _is_joined(home: Home) -> bool:
    """Return whether a robot still gets from the dock to every place and room."""
    grid = draw(home)
    near = mark_near(solids(home), grid, ROBOT_CLEAR_M)
    dock = home.places[home.dock].pose
    seen = reachable(~near, grid.cell(dock[0], dock[1]))
    poses = [place.pose for place in home.places.values()]
    poses += [room.pose for room in home.rooms.values()]
    return all(seen[grid.cell(pose[0], pose[1])] for pose in poses)
