"""Furnish a room by its kind: what stands in it, how large, against a wall or in the middle.

Sizes are those that furniture shops state. Knows rectangles on the floor and nothing of pictures.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from sim.site import Rect

if TYPE_CHECKING:
    from random import Random

Span = tuple[float, float]
Side = Literal["west", "east", "south", "north"]
SIDES: tuple[Side, ...] = ("west", "east", "south", "north")
WALL_GAP_M = 0.02
CLEAR_M = 0.45
"""Half of the square that stays free where a robot is sent to in a room."""
TRIES = 12


@dataclass(frozen=True, slots=True)
class Piece:
    """Say how large pieces of one kind are: from the wall, along it, and high [m]."""

    name: str
    class_id: str
    depth_m: Span
    breadth_m: Span
    height_m: Span
    round: bool = False


def _piece(
    name: str,
    class_id: str,
    depth_m: Span,
    breadth_m: Span,
    height_m: Span,
    *,
    round_: bool = False,
) -> Piece:
    return Piece(name, class_id, depth_m, breadth_m, height_m, round_)


PIECES = {
    piece.name: piece
    for piece in (
        _piece("sofa", "sofa", (0.75, 1.0), (1.4, 2.4), (0.65, 0.95)),
        _piece("armchair", "chair", (0.65, 0.85), (0.65, 0.85), (0.75, 1.0)),
        _piece("chair", "chair", (0.4, 0.52), (0.4, 0.52), (0.78, 1.05)),
        _piece("stool", "chair", (0.4, 0.55), (0.4, 0.55), (0.8, 1.0), round_=True),
        _piece("low_table", "table", (0.45, 0.75), (0.7, 1.3), (0.36, 0.52)),
        _piece("dining_table", "table", (0.75, 1.0), (1.1, 1.8), (0.7, 0.8)),
        _piece("round_table", "table", (0.6, 1.1), (0.6, 1.1), (0.5, 0.8), round_=True),
        _piece("desk", "table", (0.55, 0.8), (1.0, 1.7), (0.7, 0.8)),
        _piece("bed", "bed", (1.85, 2.1), (0.9, 1.9), (0.38, 0.65)),
        _piece("tv", "tv", (0.35, 0.5), (0.9, 1.7), (0.45, 1.3)),
        _piece("fridge", "fridge", (0.58, 0.75), (0.55, 0.9), (1.3, 1.95)),
        _piece("plant", "plant", (0.26, 0.5), (0.26, 0.5), (0.5, 1.6), round_=True),
        _piece("crate", "box", (0.3, 0.6), (0.3, 0.7), (0.3, 0.65)),
        _piece("wardrobe", "none", (0.5, 0.65), (0.8, 1.9), (1.7, 2.2)),
        _piece("shelf", "none", (0.25, 0.4), (0.7, 1.8), (0.9, 2.1)),
        _piece("counter", "none", (0.55, 0.65), (1.0, 2.8), (0.85, 0.95)),
        _piece("cabinet", "none", (0.35, 0.5), (0.35, 1.4), (0.4, 1.1)),
        _piece("bathtub", "none", (0.65, 0.8), (1.4, 1.8), (0.5, 0.65)),
        _piece("bench", "none", (0.35, 0.45), (0.8, 1.4), (0.4, 0.5)),
        _piece("coat_rack", "none", (0.3, 0.45), (0.3, 0.45), (1.4, 1.9), round_=True),
        _piece("washbasin", "none", (0.4, 0.5), (0.5, 0.8), (0.8, 0.9)),
        _piece("toilet", "none", (0.6, 0.7), (0.4, 0.5), (0.4, 0.48)),
        _piece("station", "none", (0.12, 0.2), (0.3, 0.5), (0.32, 0.45)),
    )
}

ROOMS: dict[str, tuple[tuple[str, float], ...]] = {
    "living": (
        ("sofa", 0.95), ("tv", 0.85), ("low_table", 0.7), ("armchair", 0.5), ("armchair", 0.3),
        ("plant", 0.5), ("cabinet", 0.5), ("shelf", 0.4), ("sofa", 0.2), ("crate", 0.15),
    ),
    "kitchen": (
        ("fridge", 0.9), ("counter", 0.8), ("dining_table", 0.7), ("round_table", 0.3),
        ("cabinet", 0.4), ("plant", 0.3), ("crate", 0.2), ("chair", 0.4),
    ),
    "bedroom": (
        ("bed", 0.97), ("wardrobe", 0.7), ("cabinet", 0.6), ("chair", 0.35), ("plant", 0.3),
        ("tv", 0.4), ("desk", 0.3), ("crate", 0.2), ("bench", 0.3),
    ),
    "study": (
        ("desk", 0.9), ("chair", 0.6), ("shelf", 0.8), ("crate", 0.4), ("plant", 0.4),
        ("armchair", 0.3), ("cabinet", 0.4), ("tv", 0.15), ("stool", 0.3), ("bed", 0.1),
    ),
    "hall": (
        ("cabinet", 0.6), ("coat_rack", 0.5), ("station", 0.4), ("bench", 0.5), ("plant", 0.3),
        ("crate", 0.3),
    ),
    "bath": (
        ("bathtub", 0.7), ("washbasin", 0.6), ("toilet", 0.6), ("cabinet", 0.8), ("stool", 0.2),
        ("plant", 0.2), ("shelf", 0.2),
    ),
}  # fmt: skip
"""What a room of each kind may hold, and how likely."""

SEATED = {"dining_table": 4, "round_table": 3, "desk": 1}
"""At how many sides of it a chair may stand."""


@dataclass
class Floor:
    """Keep what of a room's floor is taken."""

    inside: Rect
    taken: list[Rect] = field(default_factory=list)

    def take(self, area: Rect, gap_m: float = 0.03) -> bool:
        """Take an area if it lies inside and is free; say whether."""
        box = self.inside
        holds = box.x0 <= area.x0 and box.y0 <= area.y0 and area.x1 <= box.x1 and area.y1 <= box.y1
        if not holds or any(area.expand(gap_m).overlaps(other) for other in self.taken):
            return False
        self.taken.append(area)
        return True


Named = tuple[str, dict[str, Any]]
"""The piece's name, whose words say how it is drawn, and what a home declares of it."""


def furnish(random: Random, kind: str, floor: Floor, *, bare: bool) -> list[Named]:
    """Return a room's furniture.

    Args:
        random: draws everything.
        kind: of the room, a key of ROOMS.
        floor: the room's; what is placed is taken from it.
        bare: leave out all that has a class.
    """
    placed: list[Named] = []
    for name, chance in ROOMS[kind]:
        piece = PIECES[name]
        if random.random() < chance and not (bare and piece.class_id != "none"):
            placed += _place(random, piece, floor)
    return placed


def _place(random: Random, piece: Piece, floor: Floor) -> list[Named]:
    depth, breadth, height = (
        random.uniform(*span) for span in (piece.depth_m, piece.breadth_m, piece.height_m)
    )
    if piece.round:
        breadth = depth
    middle = piece.class_id in {"table", "chair", "plant", "box"} and random.random() < 0.4
    for _ in range(TRIES):
        side = random.choice(SIDES)
        area = _anywhere(random, floor.inside, side, depth, breadth)
        if not middle:
            area = _at_wall(area, floor.inside, side)
        if floor.take(area):
            chairs = _chairs(random, SEATED.get(piece.name, 0), area, floor)
            return [declare_piece(random, piece, area, height), *chairs]
    return []


def _anywhere(random: Random, room: Rect, side: Side, depth: float, breadth: float) -> Rect:
    wide, deep = (depth, breadth) if side in {"west", "east"} else (breadth, depth)
    x = random.uniform(room.x0 + WALL_GAP_M, max(room.x0 + WALL_GAP_M, room.x1 - wide))
    y = random.uniform(room.y0 + WALL_GAP_M, max(room.y0 + WALL_GAP_M, room.y1 - deep))
    return Rect(x, y, x + wide, y + deep)


def _at_wall(area: Rect, room: Rect, side: Side) -> Rect:
    right = {
        "west": room.x0 + WALL_GAP_M - area.x0,
        "east": room.x1 - WALL_GAP_M - area.x1,
    }.get(side, 0.0)
    up = {
        "south": room.y0 + WALL_GAP_M - area.y0,
        "north": room.y1 - WALL_GAP_M - area.y1,
    }.get(side, 0.0)
    return Rect(area.x0 + right, area.y0 + up, area.x1 + right, area.y1 + up)


def _chairs(random: Random, at_most: int, table: Rect, floor: Floor) -> list[Named]:
    """Put chairs at a table's sides, drawn up to it or a little off."""
    placed: list[Named] = []
    piece = PIECES[random.choice(("chair", "chair", "stool"))]
    size, height = random.uniform(*piece.depth_m), random.uniform(*piece.height_m)
    sides = random.sample(SIDES, k=random.randint(0, at_most))
    for side in sides:
        off = random.uniform(0.04, 0.3)
        x, y = (table.x0 + table.x1 - size) / 2, (table.y0 + table.y1 - size) / 2
        x = {"west": table.x0 - off - size, "east": table.x1 + off}.get(side, x)
        y = {"south": table.y0 - off - size, "north": table.y1 + off}.get(side, y)
        area = Rect(x, y, x + size, y + size)
        if floor.take(area, gap_m=0.0):
            placed.append(declare_piece(random, piece, area, height))
    return placed


def declare_piece(random: Random, piece: Piece, area: Rect, height_m: float) -> Named:
    """Return a piece as a home declares it."""
    numbers = [round(value, 3) for value in (area.x0, area.y0, area.x1, area.y1)]
    item: dict[str, Any] = {"class": piece.class_id, "height_m": round(height_m, 3)}
    if piece.round:
        x, y = (numbers[0] + numbers[2]) / 2, (numbers[1] + numbers[3]) / 2
        radius = round((numbers[2] - numbers[0]) / 2 - 0.001, 3)
        item["cylinder"] = [round(x, 3), round(y, 3), radius]
    else:
        item["box"] = numbers
    if piece.class_id != "none" and random.random() < 0.1:
        item["yaw"] = float(random.choice((-90, 0, 90, 180)))
    return piece.name, item
