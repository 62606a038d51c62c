"""Define home.yaml: the one declaration from which world, map, places and fence follow.

Owns the shape of home.yaml (names, units, bounds). Knows no file, no raster and no physics; what
needs several parts at once (overlaps, reach, clearance) is judged in check.py.

Frame: ``map``, metres; the plan is axis-aligned, since walls of a home mostly are. A box is
[x0, y0, x1, y1], a cylinder [x, y, radius], a pose [x, y, heading in degrees].
"""

from __future__ import annotations

from math import radians
from typing import Annotated, Literal

from pydantic import ConfigDict, Field, model_validator

from sim.site.classes import SIZES_M, Color, FurnitureClass, ObjectClass, Size
from wire.base import Record
from wire.geometry import Pose2, wrap

LIDAR_SEES_FROM_M = 0.30
"""Lowest furniture allowed [m]. The lidar looks at 0.20 m; what is lower would be a trap."""

MAX_OBJECTS, MAX_PEOPLE = 48, 8
"""All of them, and the spare obstacles, fit into one sim/scene."""

Id = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,31}$")]
Words = Annotated[str, Field(min_length=1, max_length=40)]
Coordinate = Annotated[float, Field(ge=-500.0, le=500.0)]
Box = tuple[Coordinate, Coordinate, Coordinate, Coordinate]
Cylinder = tuple[Coordinate, Coordinate, Annotated[float, Field(ge=0.02, le=5.0)]]
Point = tuple[Coordinate, Coordinate]
Extent = Annotated[float, Field(ge=0.01, le=3.0)]
Degrees = Annotated[float, Field(ge=-180.0, le=180.0)]
PoseDeg = tuple[Coordinate, Coordinate, Annotated[float, Field(ge=-180.0, le=180.0)]]


class Name(Record):
    """Name a thing in both languages."""

    en: Words
    zh: Words


class HomeAliases(Record):
    """List the other names that people use for a room or place."""

    en: tuple[Words, ...] = ()
    zh: tuple[Words, ...] = ()


def _check_order(box: Box, what: str) -> Box:
    if not (box[0] < box[2] and box[1] < box[3]):
        raise ValueError(f"{what} {list(box)} is not [x0, y0, x1, y1] with x0 < x1 and y0 < y1")
    return box


class Room(Record):
    """Give a room between the centre lines of its walls, and where a robot sent there stops."""

    name: Name
    aliases: HomeAliases = HomeAliases()
    box: Box
    pose: PoseDeg

    @model_validator(mode="after")
    def _has_area(self) -> Room:
        _check_order(self.box, "box")
        return self


class HomeDoor(Record):
    """Cut an opening, centred on the wall that two rooms share."""

    between: tuple[Id, Id]
    at: tuple[Coordinate, Coordinate]
    width_m: float = Field(gt=0.0, le=20.0)


class Furniture(Record):
    """Put a solid on the floor. It is solid down to the floor, because a planar lidar sees no top.

    A real table shows the lidar four legs; here it shows its outline, so that map, lidar and
    physics agree. What a table top does to a real robot is a limit stated in docs/safety.md.
    """

    model_config = ConfigDict(populate_by_name=True)
    box: Box | None = None
    cylinder: Cylinder | None = None
    height_m: float = Field(ge=LIDAR_SEES_FROM_M, le=3.0)
    class_id: FurnitureClass | None = Field(default=None, alias="class")
    """What a camera sees in it; left out, the words of its id say so, and ``none`` says nothing."""
    color: Color | None = None
    yaw: Degrees | None = None
    """Where its front looks; left out, away from the nearest wall, and a chair's to its table."""

    @model_validator(mode="after")
    def _one_shape(self) -> Furniture:
        if (self.box is None) == (self.cylinder is None):
            raise ValueError("furniture has either a box or a cylinder")
        if self.box is not None:
            _check_order(self.box, "box")
        return self


class Object(Record):
    """Lay a small thing down, or stand one on the floor. No map shows it: people move it about."""

    model_config = ConfigDict(populate_by_name=True)
    class_id: ObjectClass = Field(alias="class")
    color: Color | None = None
    at: Point
    on: Id | Annotated[float, Field(ge=0.0, le=3.0)] = 0.0
    """The furniture that it lies on, or its height above the floor. A door hangs in its wall."""
    yaw: Degrees = 0.0
    size: tuple[Extent, Extent, Extent] | None = None
    """Depth along its front, breadth, height; left out, what its class usually measures."""

    @property
    def size_m(self) -> Size:
        """Return depth, breadth and height [m]."""
        return self.size or SIZES_M[self.class_id]


class HomePerson(Record):
    """Place a person in the home. No map shows people: they walk about."""

    at: Point
    yaw: Degrees = 0.0
    color: Color | None = None
    """Of the clothes."""


class HomePlace(Record):
    """Name a pose that people ask for."""

    name: Name
    aliases: HomeAliases = HomeAliases()
    pose: PoseDeg


class HomeWall(Record):
    """Build every wall alike, centred on the rooms' edges."""

    thickness_m: float = Field(default=0.10, ge=0.05, le=0.5)
    height_m: float = Field(default=2.4, ge=LIDAR_SEES_FROM_M, le=5.0)


class KeepOut(Record):
    """Close an area to the robot's centre."""

    id: Id
    box: Box


class HomeSpeedZone(Record):
    """Slow the robot in an area."""

    id: Id
    box: Box
    max_speed_mps: float = Field(ge=0.05, le=2.0)


class HomeFence(Record):
    """Bound the robot's centre.

    The inset is measured from the walls' faces. 0.15 m follows from the two distances that places
    keep (0.40 m to an obstacle, 0.25 m to the fence), and with the 0.15 m at which the fence's gate
    closes it holds the centre 0.30 m off every wall, which is the robot's radius.
    """

    inset_m: float = Field(default=0.15, ge=0.05, le=0.40)
    keep_outs: tuple[KeepOut, ...] = ()
    speed_zones: tuple[HomeSpeedZone, ...] = ()


class Home(Record):
    """Hold one whole declaration."""

    version: Literal[1]
    site: Id
    name: Name
    wall: HomeWall = HomeWall()
    fence: HomeFence = HomeFence()
    dock: Id
    """The place where a run starts and where return_home leads."""
    rooms: dict[Id, Room] = Field(min_length=1)
    doors: tuple[HomeDoor, ...] = ()
    furniture: dict[Id, Furniture] = Field(default_factory=dict)
    objects: dict[Id, Object] = Field(default_factory=dict, max_length=MAX_OBJECTS)
    people: dict[Id, HomePerson] = Field(default_factory=dict, max_length=MAX_PEOPLE)
    places: dict[Id, HomePlace] = Field(min_length=1)


def pose2(pose: PoseDeg) -> Pose2:
    """Return a declared pose with its heading in radians."""
    return Pose2(pose[0], pose[1], wrap(radians(pose[2])))
