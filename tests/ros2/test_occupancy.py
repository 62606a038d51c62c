"""A map of ROS becomes files that the one reader of maps reads as ROS meant it."""

from __future__ import annotations

from array import array
from math import cos, pi, sin
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from maps import FREE, OCCUPIED, UNKNOWN, load_map
from ros2.occupancy import map_files
from ros2.robot_words import Unreadable


def grid(data: Any, width: int = 3, height: int = 2, yaw_rad: float = 0.0, **info: Any) -> Any:
    turned = {"x": 0.0, "y": 0.0, "z": sin(yaw_rad / 2), "w": cos(yaw_rad / 2)}
    origin = {"position": {"x": -1.0, "y": 2.0, "z": 0.0}, "orientation": turned}
    said = {"resolution": 0.05000000074505806, "width": width, "height": height, "origin": origin}
    return {"header": {"frame_id": "map"}, "info": said | info, "data": data}


def loaded(message: Any, folder: Path) -> Any:
    files = map_files(message)
    (folder / "map.yaml").write_text(files.yaml)
    (folder / "map.pgm").write_bytes(files.pgm)
    return load_map(folder / "map.yaml")


def test_free_occupied_and_unknown_stay_where_they_are(tmp_path: Path) -> None:
    made = loaded(grid([0, 100, -1, 0, 24, 50]), tmp_path)
    assert bytes(made.grid.cells) == bytes([FREE, OCCUPIED, UNKNOWN, FREE, FREE, UNKNOWN])
    assert (made.grid.width, made.grid.height, made.grid.resolution_m) == (3, 2, 0.05)
    assert (made.record.origin[0], made.record.origin[1]) == (-1.0, 2.0)
    assert made.kept_unknown == 0


def test_a_map_that_is_turned_is_turned_back(tmp_path: Path) -> None:
    straight = loaded(grid([0, 100, 0, 0, 0, 0], yaw_rad=pi / 2), tmp_path)
    assert straight.record.origin[2] == pytest.approx(pi / 2)
    assert (straight.grid.width, straight.grid.height) == (2, 3)


@given(st.lists(st.integers(-1, 100), min_size=6, max_size=6))
def test_a_list_and_bytes_of_dds_make_the_same_files(data: list[int]) -> None:
    assert map_files(grid(data)) == map_files(grid(array("b", data)))


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({}, "info is missing"),
        (grid([0] * 5), "3 x 2 cells, and data holds 5"),
        (grid(None), "data holds None"),
        (grid("000000"), "data holds '000000'"),
        (grid([0] * 6, width=0), "0 x 2 cells"),
        (grid([0] * 6, width=-3), "width holds -3"),
        (grid([0] * 6, width=1 << 40), "width holds"),
        (grid([0, 0, 0, 0, 0, 101]), "data holds 101"),
        (grid([0, 0, 0, 0, 0, -2]), "from -1 to 100"),
        (grid([0, 0, 0, 0, 0, None]), "from -1 to 100"),
        (grid([0, 0, 0, 0, 0, 0.5]), "from -1 to 100"),
        (grid([0] * 6, resolution=None), "resolution holds None"),
        (grid([0] * 6, resolution=float("nan")), "resolution holds nan"),
        (grid([0] * 6, origin=None), "position is missing"),
        (
            grid([0] * 6, origin={"position": {"x": 0.0, "y": 0.0},
                                  "orientation": {"x": 0.7, "y": 0.0, "z": 0.0, "w": 0.7}}),
            "tilted",
        ),
    ],
)  # fmt: skip
def test_what_is_no_map_is_refused(wrong: Any, says: str) -> None:
    with pytest.raises(Unreadable, match=says):
        map_files(wrong)
