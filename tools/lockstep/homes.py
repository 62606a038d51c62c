"""Make homes by seed, as sites on disk: rows of rooms with doors and furniture, and one bare hall.

What a home may be is the simulator's to judge; one that it refuses is drawn again.
"""

from __future__ import annotations

import json
from pathlib import Path
from random import Random

from sim.site import Home
from sim.site.files import site_files
from sim.site.load import load_home, parse_home
from wire import ConfigError

HALL_M = 14.0
TRIES = 200


def made_home(parent: Path, seed: int) -> Path:
    """Write a home of two to four rooms in a row into a folder of its own; return that.

    Raises:
        ConfigError: none of many drawn homes was allowed.
    """
    random = Random(f"home {seed}")
    refused: ConfigError | None = None
    for _ in range(TRIES):
        try:
            return _write(parent, _row(random, seed))
        except ConfigError as error:
            refused = error
    raise refused or ConfigError("no_home", "nothing was drawn")


def stock_home(
    parent: Path, site: Path, objects: dict[str, object], people: dict[str, object] | None = None
) -> Path:
    """Write a site's home into a folder of its own, with these things and people in it.

    Raises:
        ConfigError: they can't be there.
    """
    home = load_home(site).model_dump(mode="json", by_alias=True, exclude_none=True)
    return _write(parent, {**home, "objects": objects, "people": people or {}})


def site_of(parent: Path, home: Home) -> Path:
    """Write a home that was drawn elsewhere into a folder of its own; return that."""
    return _write(parent, home.model_dump(mode="json", by_alias=True, exclude_none=True))


def hall(parent: Path) -> Path:
    """Write one bare room, large enough to drive any arc in."""
    middle = HALL_M / 2
    rooms: dict[str, object] = {
        "hall": _room("hall", (0.0, 0.0, HALL_M, HALL_M), (middle, middle, 0))
    }
    return _write(parent, _home("hall", rooms, [], {}, (2.0, middle, 0)))


def _row(random: Random, seed: int) -> dict[str, object]:
    rooms: dict[str, object] = {}
    doors: list[dict[str, object]] = []
    furniture: dict[str, object] = {}
    x = 0.0
    deep = random.uniform(3.0, 5.0)
    count = random.randint(2, 4)
    for index in range(count):
        wide = random.uniform(2.8, 4.5)
        name = f"room_{index}"
        box = (round(x, 2), 0.0, round(x + wide, 2), round(deep, 2))
        rooms[name] = _room(f"room {index}", box, (x + wide / 2, deep / 2, 0))
        if index:
            at = (round(x, 2), round(random.uniform(1.0, deep - 1.0), 2))
            width = round(random.uniform(0.9, 1.2), 2)
            doors.append({"between": [f"room_{index - 1}", name], "at": list(at), "width_m": width})
        for piece in range(random.randint(0, 2)):
            fx, fy = x + random.uniform(0.3, wide - 0.8), random.choice((0.1, deep - 0.7))
            size = (random.uniform(0.3, 0.8), random.uniform(0.3, 0.6))
            corners = (fx, fy, fx + size[0], fy + size[1])
            furniture[f"thing_{index}_{piece}"] = {
                "box": [round(c, 2) for c in corners],
                "height_m": 0.8,
            }
        x += wide
    dock = (round(1.2 + random.random() * 0.4, 2), round(deep / 2, 2), random.choice((0, 90, -90)))
    return _home(f"made_{seed}", rooms, doors, furniture, dock)


def _room(words: str, box: tuple[float, ...], pose: tuple[float, ...]) -> dict[str, object]:
    return {"name": {"en": words, "zh": words}, "box": list(box), "pose": [*pose]}


def _home(
    site: str,
    rooms: dict[str, object],
    doors: list[dict[str, object]],
    furniture: dict[str, object],
    dock: tuple[float, ...],
) -> dict[str, object]:
    place = {"name": {"en": "charging dock", "zh": "充电桩"}, "pose": list(dock)}
    return {
        "version": 1,
        "site": site,
        "name": {"en": site.replace("_", " "), "zh": site},
        "dock": "charging_dock",
        "rooms": rooms,
        "doors": doors,
        "furniture": furniture,
        "places": {"charging_dock": place},
    }


def _write(parent: Path, home: dict[str, object]) -> Path:
    text = json.dumps(home, ensure_ascii=False, indent=1)  # which is YAML too
    files = site_files(parse_home(text, "a made home"))
    folder = parent / str(home["site"])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "home.yaml").write_text(text, "utf-8")
    for name, data in files.items():
        (folder / name).write_bytes(data)
    return folder
