"""Scatter what people leave about: cups on tables, balls on the floor, doors in walls, people.

Sizes follow the classes' usual ones with some play. Whether a home allows the result is the
simulator's to judge; this tries to obey its rules.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from sim.site import Rect
from sim.site.classes import COLORS, SIZES_M

if TYPE_CHECKING:
    from collections.abc import Mapping
    from random import Random

    from tools.train.furnish import Floor

ON_TOP = ("cup", "cup", "cup", "bottle", "bottle", "book", "book", "ball", "ball", "box", "plant")
ON_FLOOR = ("ball", "ball", "book", "box", "box", "plant", "chair", "table")
PLAY = 0.25
"""Sizes differ by so much of the usual, either way."""
TRAP_M, FLAT_M = 0.32, 0.045
"""On the floor a thing is higher or flatter than these: the lidar must see it, or wheels pass."""
EDGE_M = 0.01
TOP_M = 1.35
"""Nothing lies where the camera looks from below."""
PERSON_M = 0.28


def color(random: Random, chance: float) -> dict[str, str]:
    """Return a colour now and then."""
    return {"color": random.choice(COLORS)} if random.random() < chance else {}


def size(random: Random, class_id: str, at_least_m: float = 0.0) -> list[float]:
    """Return depth, breadth and height, with play; round things stay round."""
    stretch = random.uniform(1 - PLAY, 1 + PLAY)
    sides = [side * stretch * random.uniform(0.9, 1.1) for side in SIZES_M[class_id]]
    if class_id == "ball":
        sides = [sides[0] * random.choice((0.5, 0.75, 1.0, 1.2))] * 3
    if class_id in {"cup", "bottle", "plant"}:
        sides[1] = sides[0]
    grow = max(1.0, at_least_m / sides[2])
    return [round(side * grow, 3) for side in sides]


def on_furniture(
    random: Random, furniture: Mapping[str, Mapping[str, Any]], count: int
) -> list[dict[str, Any]]:
    """Lay things on what is low enough to look upon; nothing lies in another."""
    tops = [name for name, item in furniture.items() if _is_top(item)]
    laid: list[dict[str, Any]] = []
    taken: dict[str, list[Rect]] = {}
    for _ in range(count if tops else 0):
        name = random.choice(tops)
        class_id = random.choice(ON_TOP)
        if furniture[name]["class"] == "none" and random.random() < 0.08:
            class_id = "tv"
        thing = _lay(random, class_id, name, furniture[name], taken.setdefault(name, []))
        if thing is not None:
            laid.append(thing)
    return laid


def _is_top(item: Mapping[str, Any]) -> bool:
    return item["class"] in {"table", "none", "sofa", "bed"} and item["height_m"] <= TOP_M


def _lay(
    random: Random, class_id: str, name: str, under: Mapping[str, Any], taken: list[Rect]
) -> dict[str, Any] | None:
    sides = size(random, class_id)
    yaw = float(
        random.choice((-180, -90, 0, 90)) if class_id == "tv" else random.randint(-179, 180)
    )
    half = (sides[0] ** 2 + sides[1] ** 2) ** 0.5 / 2 + EDGE_M
    if class_id in {"cup", "ball", "bottle", "plant"}:
        half = max(sides[:2]) / 2 + EDGE_M
    box = _top(under)
    if not (box.x1 - box.x0 > 2 * half and box.y1 - box.y0 > 2 * half):
        return None
    x, y = (
        random.uniform(box.x0 + half, box.x1 - half),
        random.uniform(box.y0 + half, box.y1 - half),
    )
    area = Rect(x - half, y - half, x + half, y + half)
    if any(area.overlaps(other) for other in taken):
        return None
    taken.append(area)
    return _thing(random, class_id, (x, y), yaw, sides) | {"on": name}


def _top(item: Mapping[str, Any]) -> Rect:
    if "box" in item:
        return Rect(*item["box"])
    x, y, radius = item["cylinder"]
    inner = radius * 0.7  # the square within the disc
    return Rect(x - inner, y - inner, x + inner, y + inner)


def on_floor(random: Random, floor: Floor, count: int) -> list[dict[str, Any]]:
    """Stand things on a room's floor, where nothing stands yet."""
    placed: list[dict[str, Any]] = []
    for _ in range(count):
        class_id = random.choice(ON_FLOOR)
        sides = size(random, class_id, TRAP_M if class_id != "book" else 0.0)
        if class_id == "book":
            sides[2] = min(sides[2], FLAT_M)
        half = (sides[0] ** 2 + sides[1] ** 2) ** 0.5 / 2 + EDGE_M
        spot = _free(random, floor, half)
        if spot is not None:
            placed.append(_thing(random, class_id, spot, float(random.randint(-179, 180)), sides))
    return placed


def people(random: Random, floor: Floor, count: int) -> list[dict[str, Any]]:
    """Let people stand about."""
    placed: list[dict[str, Any]] = []
    for _ in range(count):
        spot = _free(random, floor, PERSON_M)
        if spot is not None:
            yaw = float(random.randint(-179, 180))
            at = [round(value, 3) for value in spot]
            placed.append({"at": at, "yaw": yaw} | color(random, 0.9))
    return placed


def _free(random: Random, floor: Floor, half: float) -> tuple[float, float] | None:
    room = floor.inside.expand(-half - EDGE_M)
    x, y = random.uniform(room.x0, room.x1), random.uniform(room.y0, room.y1)
    return (x, y) if floor.take(Rect(x - half, y - half, x + half, y + half)) else None


def door(random: Random, at: tuple[float, float], yaw: float) -> dict[str, Any]:
    """Hang a closed door into a wall."""
    sides = [0.02, round(random.uniform(0.8, 1.0), 3), round(random.uniform(1.9, 2.1), 3)]
    return _thing(random, "door", at, yaw, sides)


def _thing(
    random: Random, class_id: str, at: tuple[float, float], yaw: float, sides: list[float]
) -> dict[str, Any]:
    return {
        "class": class_id,
        "at": [round(value, 3) for value in at],
        "yaw": yaw,
        "size": sides,
    } | color(random, 0.7)
