"""A map of ROS becomes files that the one reader of maps reads as ROS meant it."""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import Any

import pytest

from maps import FREE, OCCUPIED, UNKNOWN, load_map
from ros2.occupancy import map_files
from ros2.robot_words import MapHead, Unreadable


def head(**more: Any) -> MapHead:
    said = {"topic": "/map", "resolution_m": 0.05, "width": 3, "height": 2, "x_m": -1.0, "y_m": 2.0}
    return MapHead.model_validate(said | more, strict=True)


def loaded(folder: Path, cells: bytes, **more: Any) -> Any:
    text, picture = map_files(head(**more), cells)
    (folder / "map.yaml").write_text(text)
    (folder / "map.pgm").write_bytes(picture)
    return load_map(folder / "map.yaml")


def test_free_occupied_and_unknown_stay_where_they_are(tmp_path: Path) -> None:
    made = loaded(tmp_path, bytes([0, 100, 255, 0, 24, 50]))
    assert bytes(made.grid.cells) == bytes([FREE, OCCUPIED, UNKNOWN, FREE, FREE, UNKNOWN])
    assert (made.grid.width, made.grid.height, made.grid.resolution_m) == (3, 2, 0.05)
    assert (made.record.origin[0], made.record.origin[1]) == (-1.0, 2.0)
    assert made.kept_unknown == 0


def test_a_map_that_is_turned_is_turned_back(tmp_path: Path) -> None:
    made = loaded(tmp_path, bytes([0, 100, 0, 0, 0, 0]), yaw_rad=pi / 2)
    assert made.record.origin[2] == pytest.approx(pi / 2)
    assert (made.grid.width, made.grid.height) == (2, 3)


@pytest.mark.parametrize(
    ("cells", "more", "says"),
    [
        (bytes(5), {}, "3 x 2 cells, and data holds 5"),
        (bytes(6), {"width": 0}, "0 x 2 cells"),
        (bytes(6), {"width": 1 << 20, "height": 1 << 20}, "cells, and data holds 6"),
        (bytes([0, 0, 0, 0, 0, 101]), {}, "data holds 101"),
        (bytes([0, 0, 0, 0, 0, 254]), {}, "data holds 254"),
    ],
)
def test_what_is_no_map_is_refused(cells: bytes, more: dict[str, Any], says: str) -> None:
    with pytest.raises(Unreadable, match=says):
        map_files(head(**more), cells)
