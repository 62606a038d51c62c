"""Things that could not be where a home puts them are refused; what must be solid is."""

from __future__ import annotations

import json
from typing import Any

import pytest

from sim.site import Home, parse_home, site_files
from sim.site.classes import class_of
from sim.site.objects import ground_m, rest_m, uprights
from wire import ConfigError

ROOM = {"name": {"en": "hall", "zh": "厅"}, "box": [0, 0, 5, 4], "pose": [2.5, 2.0, 0]}
DOCK = {"name": {"en": "dock", "zh": "充电桩"}, "pose": [1.0, 2.0, 0]}
FURNITURE = {
    "table": {"box": [3.5, 0.5, 4.5, 1.3], "height_m": 0.75},
    "round_table": {"cylinder": [4.2, 3.2, 0.4], "height_m": 0.7},
    "sofa": {"box": [0.2, 0.1, 1.8, 0.9], "height_m": 0.8},
}
CUP = {"class": "cup", "at": [4.0, 0.9], "on": "table"}
CRATE = {"class": "box", "at": [3.0, 3.6], "size": [0.4, 0.4, 0.4]}


def home(objects: dict[str, Any] | None = None, people: dict[str, Any] | None = None) -> Home:
    """Return a checked home that holds these."""
    text = json.dumps({
        "version": 1, "site": "flat", "name": {"en": "flat", "zh": "公寓"}, "dock": "dock",
        "rooms": {"hall": ROOM}, "furniture": FURNITURE, "places": {"dock": DOCK},
        "objects": objects or {}, "people": people or {},
    })  # fmt: skip
    return parse_home(text, "home.yaml")


OBJECTS: list[tuple[str, dict[str, Any]]] = [
    ("home_invalid", {"it": {**CUP, "class": "hat"}}),
    ("home_invalid", {"it": {**CUP, "class": "person"}}),
    ("home_invalid", {"it": {**CUP, "color": "mauve"}}),
    ("home_invalid", {"it": {**CUP, "size": [0.1, 0.1, 0.0]}}),
    ("home_invalid", {f"cup_{n}": CUP for n in range(49)}),
    ("id_taken", {"table": CUP}),
    ("id_taken", {"person_0": CUP}),
    ("object_on_unknown", {"it": {**CUP, "on": "shelf"}}),
    ("object_off_furniture", {"it": {**CUP, "at": [4.48, 0.9]}}),
    ("object_off_furniture", {"it": {**CUP, "at": [3.9, 3.4], "on": "round_table", "yaw": 45}}),
    ("object_outside", {"it": {**CUP, "at": [6.0, 2.0], "on": 1.0}}),
    ("object_in_wall", {"it": {**CRATE, "at": [0.22, 3.0]}}),
    ("object_off_wall", {"it": {"class": "door", "at": [2.0, 2.0]}}),
    ("object_off_wall", {"it": {"class": "door", "at": [4.8, 0.0]}}),
    ("object_trap", {"it": {**CRATE, "size": [0.2, 0.2, 0.2]}}),
    ("object_trap", {"it": {"class": "cup", "at": [3.0, 3.6]}}),
    ("object_in_furniture", {"it": {**CRATE, "at": [1.7, 0.9]}}),
    ("objects_overlap", {"a": CRATE, "b": {**CRATE, "at": [3.2, 3.6], "yaw": 30}}),
    ("place_near_obstacle", {"it": {**CRATE, "at": [1.5, 2.0]}}),
]


@pytest.mark.parametrize(("code", "objects"), OBJECTS)
def test_an_object_that_cannot_be_there_is_refused(code: str, objects: dict[str, Any]) -> None:
    with pytest.raises(ConfigError) as refusal:
        home(objects)
    assert refusal.value.code == code
    assert "home.yaml" in refusal.value.detail


@pytest.mark.parametrize(("code", "at"), [
    ("object_in_furniture", [3.3, 1.0]),
    ("object_in_wall", [2.5, 0.25]),
    ("object_outside", [2.5, 9.0]),
    ("place_near_obstacle", [2.5, 2.3]),
])  # fmt: skip
def test_a_person_needs_room(code: str, at: list[float]) -> None:
    with pytest.raises(ConfigError) as refusal:
        home(people={"ann": {"at": at}})
    assert refusal.value.code == code


def test_things_rest_on_what_is_below_and_only_what_a_lidar_sees_is_solid() -> None:
    made = home(
        {
            "cup": CUP,
            "cushion": {"class": "box", "at": [1.0, 0.5], "on": "sofa", "size": [0.3, 0.3, 0.2]},
            "mat": {"class": "book", "at": [3.0, 3.0], "size": [0.3, 0.2, 0.03]},
            "crate": {**CRATE, "yaw": 90, "size": [0.3, 0.5, 0.4]},
            "front_door": {"class": "door", "at": [2.0, 0.0]},
        },
        {"ann": {"at": [3.0, 2.9], "yaw": 90}},
    )
    assert rest_m(made, made.objects["cup"]) == 0.75
    assert 0.35 < rest_m(made, made.objects["cushion"]) < 0.5
    assert (ground_m(made, 4.0, 0.9), ground_m(made, 2.5, 2.0)) == (0.75, 0.0)
    assert [thing.id for thing in uprights(made)] == ["ann", "crate"]
    crate = uprights(made)[1].solid.shape.bounds
    assert (crate.x1 - crate.x0, crate.y1 - crate.y0) == pytest.approx((0.5, 0.3))
    assert site_files(made) == site_files(home()), "no map shows what people move about"


def test_an_id_says_the_class_and_yaml_may_say_on() -> None:
    named = {"coffee_table": "table", "desk": "table", "armchair": "chair", "table_chair": "chair",
             "tv_stand": "tv", "nightstand": "none", "chairman": "none"}  # fmt: skip
    assert {name: class_of(name) for name in named} == named
    text = """
version: 1
site: flat
name: {en: no, zh: 家}
dock: dock
rooms: {hall: {name: {en: hall, zh: 厅}, box: [0, 0, 5, 4], pose: [2.5, 2.0, 0]}}
furniture: {table: {box: [3.5, 0.5, 4.5, 1.3], height_m: 0.75}}
objects: {cup: {class: cup, at: [4.0, 0.9], on: table}}
places: {dock: {name: {en: dock, zh: 充电桩}, pose: [1.0, 2.0, 0]}}
"""
    assert parse_home(text, "home.yaml").objects["cup"].on == "table"
