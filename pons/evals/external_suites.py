"""Read the orders that others wrote, with a site made of their own rooms; nothing of it ships.

``gpsr`` (RoboCup@Home, English) and ``zh`` (three Chinese robots), from a folder on this machine.
"""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree as ET

from planner.language.motion_guard.mentioned_names import places_named, plain
from planner.plan import Bilingual, Entry, Vocabulary
from pons.evals.cases import Case, MissingSuite, Suite
from pons.evals.category_rules import LAWS
from pons.evals.matchers import read_expectation
from pons.evals.world import EvalWorld

ROUTES = frozenset({"navigate", "multi", "mixed"})
_ZH_ROOMS = {
    "kitchen": ("厨房", "Kitchen"),
    "living_room": ("客厅", "livingRoom"),
    "bedroom": ("卧室",),
    "bathroom": ("卫生间",),
    "kitchen_area": ("厨房工作区",),
    "bench_area": ("实验台工作区",),
    "loading_bay": ("装卸区", "loading bay"),
    "trash_can": ("垃圾桶", "trashCan"),
    "entrance": ("入口",),
    "kitchen_table": ("厨房桌子", "kitchenTable"),
    "serving_table": ("服务桌", "servingTable"),
    "custom_table": ("自定义桌子", "customTable"),
    "coffee_table": ("茶几",),
}


def gpsr(folder: Path) -> Suite:
    """Return the English suite.

    Raises:
        MissingSuite: the files are not there.
    """
    rows = _rows(folder / "gpsr_dev.tsv")
    world = EvalWorld(_gpsr_names(folder / "gpsr_lists" / "kyordhel_Locations.xml"))
    cases = tuple(
        Case(text, category, law=LAWS[category]) for category, _source, _rule, text in rows
    )
    return Suite("gpsr", world, cases)


def chinese(folder: Path) -> Suite:
    """Return the Chinese suite.

    Raises:
        MissingSuite: the file is not there.
    """
    world = EvalWorld(_zh_names())
    rows = _rows(folder / "zh_dev.tsv")
    return Suite("zh", world, tuple(_zh_case(kind, want, text) for kind, _from, want, text in rows))


def _zh_case(kind: str, expected: str, text: str) -> Case:
    if kind not in ROUTES:
        return Case(text, kind, law=LAWS[kind])
    rooms = places_named(text if "rooms" in expected else expected, _zh_names())
    route = " > ".join(f"go {room} > look?" for room in rooms)
    return Case(text, kind, wanted=read_expectation(route))


def _rows(path: Path) -> list[list[str]]:
    if not path.is_file():
        raise MissingSuite(f"{path.name} is not in {path.parent}; give its folder with --data")
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.split("\t") for line in lines if line and not re.match(r"#|category\t", line)]


def _gpsr_names(path: Path) -> Vocabulary:
    if not path.is_file():
        raise MissingSuite(f"{path.name} is not in {path.parent}")
    entries = []
    for area in ET.parse(path).getroot():
        room = area.get("name", "")
        entries.append(_entry(room, room, "room"))
        entries += [_entry(place.get("name", ""), room, "place") for place in area]
    return Vocabulary(entries=tuple(entries))


def _entry(name: str, room: str, kind: str) -> Entry:
    inside = _id(room) if kind == "place" else None
    fields = {"id": _id(name), "kind": kind, "name": Bilingual(en=name, zh=name), "room": inside}
    return Entry.model_validate(fields)


def _id(name: str) -> str:
    return re.sub(r"\W+", "_", plain(name))


def _zh_names() -> Vocabulary:
    rooms = [
        Entry(
            id=id_, kind="room", name=Bilingual(en=id_.replace("_", " "), zh=names[0]),
            aliases=names[1:],
        )
        for id_, names in _ZH_ROOMS.items()
    ]  # fmt: skip
    bed = Entry(id="bed", kind="place", name=Bilingual(en="bed", zh="床"), room="bedroom")
    return Vocabulary(entries=(*rooms, bed))
