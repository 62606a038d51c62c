"""A home in which a robot could not live is refused, with a stable code and a clear sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from sim.site import load_home, parse_home, stale
from wire import ConfigError

GOOD = """
version: 1
site: flat
name: {en: flat, zh: 公寓}
dock: dock
rooms:
  left:
    name: {en: left room, zh: 左室}
    box: [0.0, 0.0, 3.0, 3.0]
    pose: [1.5, 2.0, 0]
  right:
    name: {en: right room, zh: 右室}
    box: [3.0, 0.0, 6.0, 3.0]
    pose: [4.5, 2.0, 180]
doors:
- {between: [left, right], at: [3.0, 1.5], width_m: 0.9}
furniture:
  crate: {box: [0.1, 0.1, 0.5, 0.5], height_m: 0.5}
places:
  dock:
    name: {en: dock, zh: 充电桩}
    pose: [1.5, 1.0, 0]
"""

DOORS = "doors:\n- {between: [left, right], at: [3.0, 1.5], width_m: 0.9}"
KEEP_OUT = "dock: dock\nfence: {{keep_outs: [{{id: rug, box: [{}]}}]}}\n"

REFUSALS = [
    ("home_syntax", "dock: dock\n", "dock: dock\ndock: other\n"),
    ("home_syntax", "version: 1", "version: 1: 2"),
    ("home_syntax", "dock: dock\n", "dock: &name dock\nsite: *name\n"),  # before it is followed
    ("home_invalid", "dock: dock\n", "dock: dock\nfurnace: 1\n"),
    ("home_invalid", "version: 1", "version: 2"),
    ("home_invalid", "height_m: 0.5", "height_m: 0.1"),
    ("home_invalid", "height_m: 0.5", "height_m: .nan"),
    ("home_invalid", "box: [0.1, 0.1, 0.5, 0.5]", "box: [0.5, 0.1, 0.1, 0.5]"),
    ("home_invalid", "crate: {box", "crate: {cylinder: [2.0, 2.0, 0.1], box"),
    ("home_invalid", "pose: [1.5, 1.0, 0]", "pose: [1.5, 1.0]"),
    ("home_invalid", "zh: 充电桩", "fr: quai"),
    ("dock_unknown", "dock: dock\n", "dock: garage\n"),
    ("id_taken", "  right:\n    name", "  dock:\n    name"),
    ("name_taken", "zh: 右室", "zh: 左室"),
    ("name_taken", "en: right room", "en: DOCK"),
    ("rooms_overlap", "box: [3.0, 0.0, 6.0, 3.0]", "box: [2.8, 0.0, 6.0, 3.0]"),
    ("door_narrow", "width_m: 0.9", "width_m: 0.89"),
    ("door_off_wall", "at: [3.0, 1.5]", "at: [3.1, 1.5]"),
    ("door_off_wall", "at: [3.0, 1.5]", "at: [3.0, 2.8]"),
    ("room_unknown", "between: [left, right]", "between: [left, rihgt]"),
    ("fence_apart", DOORS, "doors: []"),
    ("furniture_outside", "box: [0.1, 0.1, 0.5, 0.5]", "box: [7.1, 0.1, 7.5, 0.5]"),
    ("furniture_in_wall", "box: [0.1, 0.1, 0.5, 0.5]", "box: [0.0, 0.1, 0.5, 0.5]"),
    ("place_outside", "pose: [1.5, 1.0, 0]", "pose: [8.5, 1.0, 0]"),
    ("pose_outside_room", "pose: [4.5, 2.0, 180]", "pose: [1.5, 2.0, 180]"),
    ("place_near_obstacle", "pose: [1.5, 1.0, 0]", "pose: [0.89, 0.5, 0]"),
    ("place_near_obstacle", "pose: [1.5, 1.0, 0]", "pose: [1.5, 2.5501, 0]"),
    ("place_near_fence", "dock: dock\n", KEEP_OUT.format("1.7, 0.5, 2.5, 1.5")),
    ("place_outside_fence", "dock: dock\n", KEEP_OUT.format("1.0, 0.5, 2.0, 1.5")),
    ("place_unreachable", "box: [0.1, 0.1, 0.5, 0.5]", "box: [2.2, 0.1, 2.6, 2.9]"),
]  # fmt: skip


def test_the_good_home_is_accepted() -> None:
    assert parse_home(GOOD, "home.yaml").site == "flat"


@pytest.mark.parametrize(("code", "old", "new"), REFUSALS)
def test_a_bad_home_is_refused(code: str, old: str, new: str) -> None:
    assert old in GOOD
    with pytest.raises(ConfigError) as refusal:
        parse_home(GOOD.replace(old, new), "home.yaml")
    assert refusal.value.code == code
    assert "home.yaml" in refusal.value.detail


def test_a_refusal_says_what_came_and_what_exists() -> None:
    with pytest.raises(ConfigError, match=r"'garage' is no place; places: dock"):
        parse_home(GOOD.replace("dock: dock\n", "dock: garage\n"), "home.yaml")


def test_all_findings_of_a_stage_are_told_at_once() -> None:
    text = GOOD.replace("zh: 右室", "zh: 左室").replace("dock: dock\n", "dock: garage\n")
    with pytest.raises(ConfigError) as refusal:
        parse_home(text, "home.yaml")
    assert "garage" in refusal.value.detail
    assert "左室" in refusal.value.detail


@pytest.mark.parametrize(
    "text",
    [
        *("", "[]", "- 1", "? [a]\n: 1", "&a [*a]", "!!python/name:os.system", "a: !!timestamp x"),
        *("a: !!bool x", "a: !!int ''", "a: !!float x", "a: !!map [a]", "a: 2001-99-99"),
        *("a: " + "9" * 5_000, "[" * 20_000, "- " * 20_000),
    ],
    ids=lambda text: text[:20],
)
def test_what_is_no_declaration_is_refused_and_nothing_else(text: str) -> None:
    with pytest.raises(ConfigError) as refusal:
        parse_home(text, "home.yaml")
    assert refusal.value.code in {"home_syntax", "home_invalid"}


def test_a_missing_home_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as refusal:
        load_home(tmp_path)
    assert refusal.value.code == "home_missing"


def test_a_home_in_the_wrong_folder_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    (folder / "home.yaml").write_text(GOOD, "utf-8")
    with pytest.raises(ConfigError) as refusal:
        stale(folder)
    assert refusal.value.code == "home_site_mismatch"
