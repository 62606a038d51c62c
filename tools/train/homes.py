"""Draw whole homes by seed, as declarations of the simulator's own kind.

Homes to learn from and homes that are never shown draw from seeds of different words, so that none
can be in both. What a home may be is the simulator's to judge; one that it refuses is drawn again.
"""

from __future__ import annotations

import json
from random import Random
from typing import Any, Literal

from sim.site import Home, Rect, parse_home
from tools.train.furnish import CLEAR_M, ROOMS, Floor, furnish
from tools.train.scatter import color, door, on_floor, on_furniture, people
from wire import ConfigError

Kind = Literal["train", "unseen", "bare"]
"""``bare``: never shown either, and without anything of our classes."""
BARE_SHARE = {"train": 0.1, "unseen": 0.04}
"""How many homes hold nothing of our classes: there it is learnt what only looks like them."""
TRIES = 60
HALF_WALL_M = 0.05
DOORWAY_M = 0.7
"""How far from an opening the floor stays free."""
MAX_OBJECTS = 40


def drawn_home(kind: Kind, seed: int) -> Home:
    """Return the home of a seed.

    Raises:
        ConfigError: none of many drawn homes was allowed.
    """
    random = Random(f"{kind} home {seed}")
    refused: ConfigError | None = None
    for _ in range(TRIES):
        home = _declare_home(
            random, seed, bare=kind == "bare" or random.random() < BARE_SHARE[kind]
        )
        try:
            return parse_home(json.dumps(home), f"a drawn home ({kind} {seed})")
        except ConfigError as error:
            refused = error
    raise refused or ConfigError("no_home", "nothing was drawn")


def _declare_home(random: Random, seed: int, *, bare: bool) -> dict[str, Any]:
    rooms, doors, floors = _plan(random)
    furniture: dict[str, Any] = {}
    objects: list[dict[str, Any]] = []
    folk: list[dict[str, Any]] = []
    for name, floor in floors.items():
        kind = str(rooms[name].pop("kind"))
        for words, item in furnish(random, kind, floor, bare=bare):
            furniture[f"{words}_{len(furniture)}"] = item | color(random, 0.6)
        if not bare:
            objects += on_floor(random, floor, random.choice((0, 1, 1, 2, 2, 3)))
            folk += people(random, floor, random.choice((0, 0, 1, 1, 2)))
    if not bare:
        objects += on_furniture(random, furniture, random.randint(8, 30))
        objects += _hang_doors(random, rooms)
    first = next(iter(rooms.values()))
    return {
        "version": 1,
        "site": f"drawn_{seed}",
        "name": {"en": f"drawn {seed}", "zh": f"画出的家{seed}"},
        "wall": {"thickness_m": 2 * HALF_WALL_M, "height_m": round(random.uniform(2.3, 2.8), 2)},
        "dock": "charging_dock",
        "rooms": rooms,
        "doors": doors,
        "furniture": furniture,
        "objects": {f"thing_{i}": item for i, item in enumerate(objects[:MAX_OBJECTS])},
        "people": {f"human_{i}": item for i, item in enumerate(folk[:6])},
        "places": {
            "charging_dock": {"name": {"en": "dock", "zh": "充电桩"}, "pose": first["pose"]}
        },
    }


def _plan(
    random: Random,
) -> tuple[dict[str, dict[str, Any]], list[dict[str, Any]], dict[str, Floor]]:
    """Draw one to four rooms in a row, joined by openings."""
    rooms: dict[str, dict[str, Any]] = {}
    doors: list[dict[str, Any]] = []
    floors: dict[str, Floor] = {}
    x, deep = 0.0, round(random.uniform(2.8, 5.2), 2)
    for index in range(random.choice((1, 2, 2, 3, 3, 4))):
        wide = round(random.uniform(2.6, 5.0), 2)
        name = f"room_{index}"
        box = [round(x, 2), 0.0, round(x + wide, 2), deep]
        pose = [round(x + wide / 2, 2), round(deep / 2, 2), float(random.choice((0, 90, -90)))]
        words = f"room {index}"
        rooms[name] = {"name": {"en": words, "zh": words}, "box": box, "pose": pose}
        rooms[name]["kind"] = random.choice(tuple(ROOMS))
        middle = Rect(pose[0], pose[1], pose[0], pose[1]).expand(CLEAR_M)
        floors[name] = Floor(Rect(*box).expand(-HALF_WALL_M), [middle])
        if index:
            at = [box[0], round(random.uniform(1.0, deep - 1.0), 2)]
            width = round(random.uniform(0.9, 1.4), 2)
            doors.append({"between": [f"room_{index - 1}", name], "at": at, "width_m": width})
            way = Rect(at[0] - DOORWAY_M, at[1] - width / 2, at[0] + DOORWAY_M, at[1] + width / 2)
            floors[f"room_{index - 1}"].taken.append(way)
            floors[name].taken.append(way)
        x += wide
    return rooms, doors, floors


def _hang_doors(random: Random, rooms: dict[str, dict[str, Any]]) -> list[dict[str, Any]]:
    """Hang closed doors into the outer walls."""
    hung: list[dict[str, Any]] = []
    for room in rooms.values():
        x0, y0, x1, y1 = room["box"]
        for y, yaw in ((y0, 90.0), (y1, -90.0)):
            if random.random() < 0.3:
                hung.append(door(random, (random.uniform(x0 + 0.7, x1 - 0.7), y), yaw))
    x0, y0, _, y1 = next(iter(rooms.values()))["box"]
    if random.random() < 0.4:
        hung.append(door(random, (x0, random.uniform(y0 + 0.7, y1 - 0.7)), 0.0))
    return hung
