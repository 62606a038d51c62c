"""Place the movable things of a home: people, and objects large and small.

Owns the rule what of them physics and lidar meet: people, and what stands on the floor higher than
a lidar may be trusted to see. A small thing on a table is for the camera alone.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, hypot, radians, sin
from typing import TYPE_CHECKING

from sim.site.classes import PERSON_HEIGHT_M, PERSON_RADIUS_M, ROUND, class_of, surface_m
from sim.site.plan import furniture_shape
from sim.site.shapes import Disc, Rect, Shape, Solid
from sim.site.spec import LIDAR_SEES_FROM_M
from wire.geometry import Pose2, wrap

if TYPE_CHECKING:
    from sim.site.spec import Furniture, Home, Object

LEAF = "leaf_"
"""A door of such an id opens and closes: lidar and physics meet it, and it may be taken away."""


@dataclass(frozen=True, slots=True)
class Upright:
    """Stand something movable on the floor: half a depth, half a breadth, or a radius."""

    id: str
    pose: Pose2
    half_m: tuple[float, float]
    height_m: float
    round: bool

    @property
    def solid(self) -> Solid:
        """Return the solid's outline: the box or disc itself, or the disc around a turned box."""
        return Solid(self.id, outline(self.pose, self.half_m, round_=self.round), self.height_m)


def outline(pose: Pose2, half_m: tuple[float, float], *, round_: bool) -> Shape:
    """Return a thing's outline on the floor, never less: a turned box becomes a disc."""
    c, s = abs(cos(pose.yaw_rad)), abs(sin(pose.yaw_rad))
    if round_:
        return Disc(pose.x_m, pose.y_m, max(half_m))
    if min(c, s) > 1e-6:
        return Disc(pose.x_m, pose.y_m, hypot(*half_m))
    x, y = c * half_m[0] + s * half_m[1], s * half_m[0] + c * half_m[1]
    return Rect(pose.x_m - x, pose.y_m - y, pose.x_m + x, pose.y_m + y)


def furniture_class(item_id: str, item: Furniture) -> str:
    """Return the detector class of a piece of furniture; ``none`` where it has none."""
    return item.class_id or class_of(item_id)


def pose_of(at: tuple[float, float], yaw_deg: float) -> Pose2:
    """Return a declared point and heading [degrees] as a pose."""
    return Pose2(at[0], at[1], wrap(radians(yaw_deg)))


def object_outline(item: Object) -> Shape:
    """Return an object's outline on the floor or table."""
    depth_m, breadth_m, _ = item.size_m
    pose = pose_of(item.at, item.yaw)
    return outline(pose, (depth_m / 2, breadth_m / 2), round_=item.class_id in ROUND)


def rest_m(home: Home, item: Object) -> float:
    """Return how high an object stands as declared [m]."""
    if isinstance(item.on, str):
        under = home.furniture[item.on]
        return surface_m(furniture_class(item.on, under), under.height_m)
    return item.on


def ground_m(home: Home, x_m: float, y_m: float) -> float:
    """Return how high a thing comes to lie that is put down here: on furniture, or the floor."""
    tops = [
        surface_m(furniture_class(item_id, item), item.height_m)
        for item_id, item in home.furniture.items()
        if furniture_shape(item).distance(x_m, y_m) <= 0.0
    ]
    return max(tops, default=0.0)


def on_floor(item: Object) -> bool:
    """Return whether an object stands on the floor. A door does not: it is part of its wall."""
    return item.on == 0.0 and item.class_id != "door"


def is_movable(object_id: str, item: Object) -> bool:
    """Return whether an object may be carried: all but doors, and of these the leaves that move."""
    return item.class_id != "door" or object_id.startswith(LEAF)


def uprights(home: Home) -> list[Upright]:
    """Return the movable things that physics and lidar meet, at their declared places."""
    people = [
        Upright(
            person_id, pose_of(person.at, person.yaw), (PERSON_RADIUS_M,) * 2, PERSON_HEIGHT_M, True
        )
        for person_id, person in home.people.items()
    ]
    standing = [
        Upright(
            object_id,
            pose_of(item.at, item.yaw),
            (item.size_m[0] / 2, item.size_m[1] / 2),
            item.size_m[2],
            item.class_id in ROUND,
        )
        for object_id, item in home.objects.items()
        if (on_floor(item) or object_id.startswith(LEAF)) and item.size_m[2] >= LIDAR_SEES_FROM_M
    ]
    return people + standing
