"""Hold the offline brain against orders that others wrote, where that data is at hand.

The law asserted here is "no wrong motion"; how many orders are answered as the table of that data
allows is printed (`pytest -s`) and not asserted: it grows.
"""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from planner.brain.offline import plan
from planner.brain.offline.normalise import squash
from planner.plan import Bilingual, Code, Entry, GoTo, StepPlan, Vocabulary

DATA = Path(__file__).parents[4] / "shared" / "data" / "commands"
needs_data = pytest.mark.skipif(
    not DATA.is_dir(),
    reason=f"the orders of others are not here: no {DATA.name} beside the checkout",
)
ZH_ROOMS = {
    "kitchen": "厨房",
    "living_room": "客厅",
    "bedroom": "卧室",
    "bathroom": "卫生间",
    "kitchen_area": "厨房工作区",
    "bench_area": "实验台工作区",
    "loading_bay": "装卸区",
    "trash_can": "垃圾桶",
    "entrance": "入口",
    "kitchen_table": "厨房桌子",
    "serving_table": "服务桌",
    "custom_table": "自定义桌子",
    "coffee_table": "茶几",
}


def rows(name: str) -> list[list[str]]:
    lines = (DATA / name).read_text(encoding="utf-8").splitlines()
    return [line.split("\t") for line in lines if line and not line.startswith(("#", "category\t"))]


def room(id_: str, en: str, zh: str) -> Entry:
    return Entry(id=id_, kind="room", name=Bilingual(en=en, zh=zh))


def gpsr_home() -> Vocabulary:
    entries = []
    for area in ET.parse(DATA / "gpsr_lists" / "kyordhel_Locations.xml").getroot():
        inside = area.get("name", "").replace(" ", "_")
        entries.append(room(inside, area.get("name", ""), area.get("name", "")))
        for place in area:
            name = place.get("name", "")
            entries.append(
                Entry(
                    id=name.replace(" ", "_"),
                    kind="place",
                    name=Bilingual(en=name, zh=name),
                    room=inside,
                )
            )
    return Vocabulary(entries=tuple(entries))


@needs_data
def test_english_orders_of_others_give_no_wrong_motion() -> None:
    home = gpsr_home()
    right: Counter[str] = Counter()
    total: Counter[str] = Counter()
    wrong = []
    for category, _source, _rule, text in rows("gpsr_dev.tsv"):
        made = plan(text, home)
        total[category] += 1
        if isinstance(made, StepPlan):
            goals = [step.place for step in made.steps if isinstance(step, GoTo)]
            named = all(squash(place) in squash(text) for place in goals)
            if category in {"bring_manipulate", "incomplete"} or not named:
                wrong.append((category, text, goals))
        code = getattr(made, "code", None)
        asks = made.kind == "clarify"
        lacks = code is Code.NO_CAPABILITY and category in {"bring_manipulate", "follow", "guide"}
        right[category] += asks or lacks or (made.kind != "refuse" and category != "incomplete")
        right[category] += category == "egpsr_other" and made.kind == "refuse"
    print("\nallowed outcomes:", {name: f"{right[name]}/{total[name]}" for name in sorted(total)})
    assert sum(total.values()) == 700
    assert wrong == []


def named_in_order(text: str, home: Vocabulary) -> list[str]:
    """Return the places whose names stand in a text, the longest name first at each point."""
    spelt = {name: entry.id for entry in home.entries for name in (entry.name.zh, entry.name.en)}
    pattern = "|".join(sorted(map(re.escape, spelt), key=len, reverse=True))
    return [spelt[found] for found in re.findall(pattern, text)]


@needs_data
def test_chinese_orders_of_others_give_no_wrong_motion() -> None:
    home = Vocabulary(
        entries=(
            *(room(id_, id_.replace("_", " "), zh) for id_, zh in ZH_ROOMS.items()),
            Entry(id="bed", kind="place", name=Bilingual(en="bed", zh="床"), room="bedroom"),
        )
    )
    wrong, still = [], []
    for kind, _source, _expected, text in rows("zh_dev.tsv"):
        made = plan(text, home)
        if not isinstance(made, StepPlan):
            still += [text] if kind == "navigate" else []
            continue
        goals = [step.place for step in made.steps if isinstance(step, GoTo)]
        route = goals if kind in {"relative", "wait"} else named_in_order(text, home)
        if kind not in {"navigate", "multi", "mixed", "relative", "wait"} or goals != route:
            wrong.append((kind, text, goals))
    assert wrong == []
    assert still == []  # every plain order to a known room is carried out
