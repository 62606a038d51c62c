"""List the instances of a home that a camera could see, with their parts and places.

Owns where fronts look and what a class looks like. The walls are the home's own; no instance
reaches beyond the outline that physics and lidar know.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import radians, sqrt
from typing import TYPE_CHECKING

from sim.camera.fixtures import form_of
from sim.camera.furniture import bed, chair, fridge, plant, round_table, screen, sofa, table, tv
from sim.camera.materials import coat
from sim.camera.orientation import front_rad
from sim.camera.primitives import GeomPart, tube
from sim.camera.small_objects import book, bottle, carton, cup, door, person, toy_ball
from sim.site.classes import (
    CRATE_M,
    NO_CLASS,
    PERSON_HEIGHT_M,
    PERSON_RADIUS_M,
    SPARE_OBSTACLES,
)
from sim.site.objects import furniture_class, ground_m, is_movable, on_floor, pose_of, rest_m
from sim.site.plan import furniture_shape
from sim.site.shapes import Disc
from wire import Pose2

if TYPE_CHECKING:
    from collections.abc import Callable

    from sim.camera.materials import Coat
    from sim.camera.surfaces import Appearance
    from sim.site import Home
    from sim.site.classes import Size
    from sim.site.spec import Furniture, Object

    Draw = Callable[[Size, Coat], list[GeomPart]]

_DRAW: dict[str, Draw] = {
    "person": person, "chair": chair, "sofa": sofa, "table": table, "bed": bed, "fridge": fridge,
    "plant": plant, "box": carton, "cup": cup, "ball": toy_ball, "bottle": bottle, "book": book,
    "door": door,
}  # fmt: skip
_INSCRIBED = sqrt(0.5)
"""Side of a square in a circle, over the diameter: a square seat stays in a round outline."""


@dataclass(frozen=True, slots=True)
class Instance:
    """Hold one thing to draw: its identity, its parts, and where they stand."""

    id: str
    class_id: str
    parts: tuple[GeomPart, ...]
    pose: Pose2
    z_m: float = 0.0
    movable: bool = False
    stays_on_floor: bool = False
    """Carried elsewhere it is put on the floor, as people and crates are; else on what is there."""
    absent: bool = False
    """It is nowhere until somebody places it."""


def instances(home: Home, look: Appearance) -> list[Instance]:
    """Return everything in a home but floor, walls and ceiling."""
    return [
        *(_furniture(home, look, item_id, item) for item_id, item in home.furniture.items()),
        *(_object(home, look, object_id, item) for object_id, item in home.objects.items()),
        *(
            _person(look, who, pose_of(somebody.at, somebody.yaw), somebody.color)
            for who, somebody in home.people.items()
        ),
        *(_spare(look, name) for name in SPARE_OBSTACLES),
    ]


def height_m(home: Home, instance: Instance, pose: Pose2) -> float:
    """Return the height of a thing that was carried to a pose [m]."""
    if pose == instance.pose:
        return instance.z_m
    return 0.0 if instance.stays_on_floor else ground_m(home, pose.x_m, pose.y_m)


def _furniture(home: Home, look: Appearance, item_id: str, item: Furniture) -> Instance:
    class_id, shape = furniture_class(item_id, item), furniture_shape(item)
    front = front_rad(home, item_id)
    if isinstance(shape, Disc):
        pose, side = Pose2(shape.x, shape.y, front), 2 * shape.radius
        square = _INSCRIBED * side if class_id in ("chair", "box", "fridge", "tv") else side
        size = (square, square, item.height_m)
    else:
        pose = Pose2((shape.x0 + shape.x1) / 2, (shape.y0 + shape.y1) / 2, front)
        along, across = shape.x1 - shape.x0, shape.y1 - shape.y0
        turned = abs(abs(front) - radians(90)) < 0.1
        size = (across, along, item.height_m) if turned else (along, across, item.height_m)
    draw = _choose_draw(item_id, class_id, round_=isinstance(shape, Disc))
    colours = coat(look, item_id, _wears(class_id, size), item.color)
    return Instance(item_id, class_id, tuple(draw(size, colours)), pose)


def _wears(class_id: str, size: Size) -> str:
    return "armchair" if class_id == "chair" and size[0] > 0.5 else class_id


def _choose_draw(item_id: str, class_id: str, *, round_: bool) -> Draw:
    if class_id == "tv":
        return tv
    if class_id == "table" and round_:
        return round_table
    if class_id != NO_CLASS:
        return _DRAW[class_id]
    form = form_of(item_id)
    return _column if round_ and form is form_of("") else form


def _column(size: Size, colours: Coat) -> list[GeomPart]:
    return [tube((0.0, 0.0), (0.0, size[2]), size[0] / 2, colours.main)]


def _object(home: Home, look: Appearance, object_id: str, item: Object) -> Instance:
    size, pose = item.size_m, pose_of(item.at, item.yaw)
    if item.class_id == "door":
        size = (home.wall.thickness_m + 0.04, size[1], size[2])
        if not is_movable(object_id, item):
            pose = Pose2(pose.x_m, pose.y_m, front_rad(home, object_id))
    draw = screen if item.class_id == "tv" else _DRAW[item.class_id]
    return Instance(
        object_id,
        item.class_id,
        tuple(draw(size, coat(look, object_id, item.class_id, item.color))),
        pose,
        0.0 if item.class_id == "door" else rest_m(home, item),
        movable=is_movable(object_id, item),
        stays_on_floor=(on_floor(item) or item.class_id == "door") and size[2] >= 0.3,
    )


def _person(look: Appearance, who: str, pose: Pose2, color: str | None) -> Instance:
    size = (2 * PERSON_RADIUS_M, 2 * PERSON_RADIUS_M, PERSON_HEIGHT_M)
    parts = tuple(person(size, coat(look, who, "person", color)))
    return Instance(who, "person", parts, pose, movable=True, stays_on_floor=True)


def _spare(look: Appearance, name: str) -> Instance:
    nowhere = Pose2(0.0, 0.0, 0.0)
    if name.startswith("person"):
        drawn = _person(look, name, nowhere, None)
    else:
        parts = tuple(carton((CRATE_M,) * 3, coat(look, name, "box", None)))
        drawn = Instance(name, "box", parts, nowhere)
    return Instance(
        name, drawn.class_id, drawn.parts, nowhere, movable=True, stays_on_floor=True, absent=True
    )
