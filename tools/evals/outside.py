"""Read the orders that others wrote, with a site made of their own rooms; nothing of it ships.

``gpsr`` (RoboCup@Home, English) and ``zh`` (three Chinese robots), from a folder on this machine.
"""

from __future__ import annotations

import random
import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

from planner.language.motion_guard.mentioned_names import places_named, plain
from planner.plan import Bilingual, Entry, Vocabulary
from pons.evals.matchers import read_expectation
from pons.evals.suites import HELD_OUT, TUNED, Case, MissingSuite, Suite, load
from pons.evals.world import EvalWorld
from pons_assets import ROOT
from tools.evals.category_rules import LAWS

DATA = ROOT.parent / "shared" / "data" / "commands"
"""Where the orders of others lie, beside a checkout; --data names another folder."""
HOLD_OUT_SEED = 5

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


def load_any(name: str) -> tuple[Suite, ...]:
    """Return one of our own suites, or one of others by its name.

    Raises:
        MissingSuite: there is none of that name, or its data is not here.
    """
    read = {"gpsr": gpsr, "zh": chinese}.get(name)
    return load(name) if read is None else (read(DATA),)


def gpsr(folder: Path) -> Suite:
    """Return the English suite.

    Raises:
        MissingSuite: the files are not there.
    """
    rows = _rows(folder / "gpsr_dev.tsv")
    world = EvalWorld(_gpsr_names(folder / "gpsr_lists" / "kyordhel_Locations.xml"))
    cases = tuple(Case(text, category, LAWS[category]) for category, _source, _rule, text in rows)
    return _split_in_half(Suite("gpsr", world, cases))


def chinese(folder: Path) -> Suite:
    """Return the Chinese suite.

    Raises:
        MissingSuite: the file is not there.
    """
    world = EvalWorld(_zh_names())
    rows = _rows(folder / "zh_dev.tsv")
    cases = tuple(_zh_case(kind, want, text) for kind, _from, want, text in rows)
    return _split_in_half(Suite("zh", world, cases))


def _split_in_half(suite: Suite) -> Suite:
    """Return the suite with a random half held out, the same every time."""
    order = list(range(len(suite.cases)))
    random.Random(HOLD_OUT_SEED).shuffle(order)
    held = frozenset(order[: len(order) // 2])
    cases = (
        replace(case, split=HELD_OUT if at in held else TUNED)
        for at, case in enumerate(suite.cases)
    )
    return replace(suite, cases=tuple(cases))


def _zh_case(kind: str, expected: str, text: str) -> Case:
    if kind not in ROUTES:
        return Case(text, kind, LAWS[kind])
    rooms = places_named(text if "rooms" in expected else expected, _zh_names())
    route = " > ".join(f"go {room} > look?" for room in rooms)
    return Case(text, kind, read_expectation(route))


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
