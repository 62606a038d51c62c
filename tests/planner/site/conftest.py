"""Write small sites to a folder: a site that loads, to be broken by each test in one way."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from planner.site import Site
from tests.site_sentences import refusals_are_whole_in_chinese
from wire import map_id

__all__ = ["refusals_are_whole_in_chinese"]

SiteFolder = Callable[..., Path]


def good_map() -> dict[str, Any]:
    """Return a map of 4 x 2 m at 0.1 m with its corner at (-1, -1)."""
    return {
        "image": "map.pgm",
        "resolution": 0.1,
        "origin": [-1.0, -1.0, 0.0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
        "mode": "trinary",
    }


def good_places() -> dict[str, Any]:
    """Return two rooms that share the map, and a place that is home."""
    left = {"aliases": {"en": ["den"], "zh": ["左边"]}, "polygon": _outline(-1)}
    return {
        "home": "dock",
        "places": [
            {**_place("left_room", "左房", 0.0, 0.0), "kind": "room", **left},
            {**_place("right_room", "右房", 2.0, 0.0, 1.0), "kind": "room", "polygon": _outline(1)},
            _place("dock", "充电桩", -0.5, 0.5),
        ],
    }


def _place(name: str, zh: str, x_m: float, y_m: float, yaw_rad: float = 0.0) -> dict[str, Any]:
    names = {"en": name.replace("_", " "), "zh": zh}
    pose = {"x_m": x_m, "y_m": y_m, "yaw_rad": yaw_rad}
    return {"id": name, "kind": "place", "name": names, "pose": pose}


def _outline(x_m: int) -> list[list[int]]:
    return [[x_m, -1], [x_m + 2, -1], [x_m + 2, 1], [x_m, 1]]


def good_fence() -> dict[str, Any]:
    """Return a fence 0.1 m inside the map; its map_id is filled in on writing."""
    return {
        "version": 1,
        "allowed": [[[-0.9, -0.9], [2.9, -0.9], [2.9, 0.9], [-0.9, 0.9]]],
        "keep_outs": [[[1.2, 0.5], [1.4, 0.5], [1.4, 0.7], [1.2, 0.7]]],
        "speed_zones": [
            {"polygon": [[2, -1], [3, -1], [3, 1], [2, 1]], "max_speed_mps": 0.2},
        ],
    }


def pgm(width: int, height: int, pixels: bytes) -> bytes:
    return f"P5\n# a comment\n{width} {height}\n255\n".encode() + pixels


@pytest.fixture
def write_site(tmp_path: Path) -> SiteFolder:
    """Write a site whose parts may be replaced; a part given as bytes is written as it is."""

    def write(
        map_yaml: dict[str, Any] | bytes | None = None,
        image: bytes | None = None,
        places: dict[str, Any] | bytes | None = None,
        fence: dict[str, Any] | bytes | None = None,
    ) -> Path:
        picture = pgm(40, 20, b"\xfe" * 800) if image is None else image
        text = _bytes(good_map() if map_yaml is None else map_yaml)
        (tmp_path / "map.yaml").write_bytes(text)
        (tmp_path / "map.pgm").write_bytes(picture)
        (tmp_path / "places.yaml").write_bytes(_bytes(good_places() if places is None else places))
        outline = good_fence() if fence is None else fence
        if isinstance(outline, dict):
            outline = json.dumps({"map_id": map_id(text, picture), **outline}).encode()
        (tmp_path / "fence.json").write_bytes(outline)
        return tmp_path

    return write


@pytest.fixture
def good_site(write_site: SiteFolder) -> Site:
    return Site.load(write_site())


def _bytes(part: dict[str, Any] | bytes) -> bytes:
    return part if isinstance(part, bytes) else yaml.safe_dump(part).encode()
