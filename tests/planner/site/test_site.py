"""Hold a site to its own agreement: map, places and fence, one broken at a time."""

from __future__ import annotations

import copy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from planner.site import Site, SiteError

SITES = Path(__file__).resolve().parents[3] / "sites"


def places() -> dict[str, Any]:
    def place(name: str, x_m: float, y_m: float) -> dict[str, Any]:
        return {
            "id": name,
            "kind": "place",
            "name": {"en": name, "zh": f"{name}处"},
            "pose": {"x_m": x_m, "y_m": y_m, "yaw_rad": 0.0},
        }

    return {"home": "a", "places": [place("a", 0.0, 0.0), place("b", 1.0, 0.0)]}


def test_a_site_loads_with_all_it_says(good_site: Site) -> None:
    assert [place.id for place in good_site.places] == ["left_room", "right_room", "dock"]
    assert good_site.home.id == "dock"
    assert [room.id for room in good_site.rooms] == ["left_room", "right_room"]
    assert good_site.fence.record.map_id == good_site.map_id
    dock = good_site.place("dock")
    assert dock is not None
    assert (dock.pose.x_m, dock.pose.y_m) == (-0.5, 0.5)
    assert good_site.place("attic") is None


@pytest.mark.parametrize(
    ("x_m", "y_m", "room"),
    [(0.0, 0.0, "left_room"), (1.5, 0.0, "right_room"), (5.0, 0.0, None), (float("nan"), 0, None)],
)
def test_the_room_around_a_point(good_site: Site, x_m: float, y_m: float, room: str | None) -> None:
    found = good_site.room_at(x_m, y_m)
    assert (found.id if found else None) == room


@pytest.mark.parametrize(
    "name", ["left_room", "Left  Room", "den", "DEN", "左边", "左房", "ｄｅｎ"]
)
def test_a_name_in_either_language_finds_the_place(good_site: Site, name: str) -> None:
    found = good_site.find_place(name)
    assert found is not None
    assert found.id == "left_room"


def test_a_part_of_a_name_finds_nothing(good_site: Site) -> None:
    assert good_site.find_place("room") is None
    assert good_site.find_place("") is None


@pytest.mark.parametrize(
    ("x_m", "y_m", "allowed"),
    [
        (0, 0, True),
        (-0.95, 0, False),
        (1.3, 0.6, False),
        (2.95, 0, False),
        (float("nan"), 0, False),
    ],
)
def test_the_fence_bounds_the_centre(
    good_site: Site, x_m: float, y_m: float, allowed: bool
) -> None:
    assert good_site.fence.allows(x_m, y_m) is allowed


def test_the_fence_slows_in_its_zones(good_site: Site) -> None:
    assert good_site.fence.max_speed_mps(2.5, 0.0) == 0.2
    assert good_site.fence.max_speed_mps(0.0, 0.0) == float("inf")


def test_distance_to_the_fence_counts_keep_outs(good_site: Site) -> None:
    assert good_site.fence.border_distance_m(0.0, 0.8) == pytest.approx(0.1)
    assert good_site.fence.border_distance_m(1.1, 0.6) == pytest.approx(0.1)


def refused(write_site: Callable[..., Path], **parts: Any) -> SiteError:
    folder = write_site(**parts)
    with pytest.raises(SiteError) as caught:
        Site.load(folder)
    return caught.value


def change(where: tuple[str | int, ...], value: Any) -> dict[str, Any]:
    changed = copy.deepcopy(places())
    target: Any = changed
    for step in where[:-1]:
        target = target[step]
    target[where[-1]] = value
    return changed


@pytest.mark.parametrize(
    ("where", "value", "code"),
    [
        (("home",), "attic", "home_unknown"),
        (("places", 1, "id"), "a", "place_duplicate_id"),
        (("places", 1, "name", "en"), "A", "place_alias_clash"),
        (("places", 1, "aliases"), {"zh": ["a处"]}, "place_alias_clash"),
        (("places", 1, "pose", "x_m"), 9.0, "place_outside_map"),
        (("places", 1, "pose", "x_m"), 2.95, "place_outside_fence"),
        (("places", 1, "pose", "x_m"), float("nan"), "value_malformed"),
        (("places", 1, "pose", "z_m"), 0.0, "unknown_key"),
        (("places", 1, "colour"), "red", "unknown_key"),
        (("places", 1, "kind"), "room", "value_malformed"),
        (("places", 1, "polygon"), [[0, 0], [1, 1], [2, 2]], "value_malformed"),
        (("places", 1, "polygon"), [[0, 0], [1, 1]], "value_malformed"),
        (("places", 1, "id"), "Two Words", "value_malformed"),
        (("places", 1, "name"), {"en": "b"}, "value_malformed"),
        (("places",), [], "value_malformed"),
    ],
)
def test_wrong_places_are_refused(
    write_site: Callable[..., Path], where: tuple[str | int, ...], value: Any, code: str
) -> None:
    assert refused(write_site, places=change(where, value)).code == code


@pytest.mark.parametrize(
    ("outline", "told"),
    [
        ([[0, 0], [1, 1], [2, 2]], "'b' has no area"),
        ([[0, 0], [0, 0], [0, 0]], "'b' has no area"),
        ([[0, 0], [1, 1], [1, 0], [0, 1]], "'b' has sides that cross: those from (0.0, 0.0)"),
    ],
)
def test_an_outline_of_nothing_is_told_from_one_that_crosses_itself(
    write_site: Callable[..., Path], outline: list[list[float]], told: str
) -> None:
    error = refused(write_site, places=change(("places", 1, "polygon"), outline))
    assert told in error.message["en"]


def test_a_place_in_a_wall_is_refused(write_site: Callable[..., Path]) -> None:
    image = b"P5 40 20 255\n" + b"\xfe" * 400 + b"\0" * 400  # the lower half is wall
    error = refused(write_site, image=image, places=change(("places", 1, "pose", "y_m"), -0.5))
    assert error.code == "place_in_obstacle"
    assert "'b'" in error.message["en"]


def test_a_fence_of_another_map_is_refused_with_both_names(
    write_site: Callable[..., Path],
) -> None:
    fence = {"map_id": "0" * 16, "version": 1, "allowed": [[[0, 0], [1, 0], [1, 1]]]}
    error = refused(write_site, fence=fence)
    assert error.code == "fence_map_mismatch"
    assert "0" * 16 in error.message["en"]


@pytest.mark.parametrize(
    ("fence", "code"),
    [
        ({"version": 1, "allowed": []}, "value_malformed"),
        ({"version": 2, "allowed": [[[0, 0], [1, 0], [1, 1]]]}, "value_malformed"),
        ({"version": 1, "allowed": [[[0, 0], [1, 1]]]}, "value_malformed"),
        ({"version": 1, "allowed": [[[0, 0], [1, 1], [2, 2]]]}, "polygon_degenerate"),
        ({"version": 1, "allowed": [[[0, 0], [1, 0], [1, 1]]], "holes": []}, "unknown_key"),
        (b"{", "json_malformed"),
        (b'{"version": 1, "version": 1}', "json_malformed"),
        (
            b'{"version": 1, "map_id": "x", "allowed": [[[NaN, 0], [1, 0], [1, 1]]]}',
            "value_malformed",
        ),
    ],
)
def test_wrong_fences_are_refused(
    write_site: Callable[..., Path], fence: dict[str, Any] | bytes, code: str
) -> None:
    assert refused(write_site, fence=fence).code == code


@pytest.mark.parametrize("name", ["map.yaml", "places.yaml", "fence.json"])
def test_a_missing_file_is_named(write_site: Callable[..., Path], name: str) -> None:
    folder = write_site()
    (folder / name).unlink()
    with pytest.raises(SiteError, match=name) as caught:
        Site.load(folder)
    assert caught.value.code == "site_file_missing"


@pytest.mark.parametrize("name", ["home", "two_room"])
def test_our_own_sites_load(name: str) -> None:
    site = Site.load(SITES / name)
    assert site.home.id == "charging_dock"
    for room in site.rooms:
        assert site.room_at(room.pose.x_m, room.pose.y_m) == room


def test_the_default_home_has_its_rooms_in_both_languages() -> None:
    site = Site.load(SITES / "home")
    names = {"客厅": "living_room", "厨房": "kitchen", "卧室": "bedroom", "卫生间": "bathroom"}
    names |= {"书房": "study", "走廊": "hallway", "玄关": "entrance", "大门": "front_door"}
    for name, wanted in names.items():
        found = site.find_place(name)
        assert found is not None
        assert found.id == wanted
