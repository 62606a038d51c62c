"""The check of a site names each thing that is wrong, in both languages, and nothing else."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from maps import load_map
from maps.new_site import new_site, place_text
from planner.navigation.site_check import check_site
from wire import Pose2

RADIUS_M, CELL_M = 0.30, 0.05


def flat() -> NDArray[np.uint8]:
    """Draw a room of 5 m x 4 m in walls."""
    picture = np.full((100, 120), 205, np.uint8)
    picture[9:91, 9:111] = 0
    picture[10:90, 10:110] = 254
    return picture


def made(
    tmp_path: Path,
    picture: NDArray[np.uint8],
    *,
    place: Pose2 | None = None,
    cell_m: float = CELL_M,
) -> Path:
    """Write a site of a picture, with a place beside its home."""
    cv2.imwrite(str(tmp_path / "m.pgm"), picture)
    (tmp_path / "m.yaml").write_text(
        f"image: m.pgm\nresolution: {cell_m}\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    new_site(
        load_map(tmp_path / "m.yaml"), RADIUS_M, Pose2(30.5 * cell_m, 50.5 * cell_m, 0.0)
    ).write(tmp_path / "s")
    if place is not None:
        with (tmp_path / "s" / "places.yaml").open("a") as file:
            file.write(place_text("shelf", "place", ("shelf", "架子"), place))
    return tmp_path / "s"


def codes(folder: Path) -> set[str]:
    found = check_site(folder, RADIUS_M)
    assert all(finding.words.en != finding.words.zh for finding in found)
    assert sorted(found, key=lambda one: one.level != "error") == list(found)
    return {finding.code for finding in found} - {"no_rooms"}


def walled(width_m: float) -> NDArray[np.uint8]:
    """Draw a wall across, with a gap of a width."""
    picture = flat()
    picture[:, 70:72] = 0
    half = round(width_m / CELL_M / 2)
    picture[50 - half : 50 + half, 70:72] = 254
    return picture


def test_a_good_site_has_nothing_wrong(tmp_path: Path) -> None:
    assert codes(made(tmp_path, flat(), place=Pose2(4.5, 2.5, 0.0))) == set()


@pytest.mark.parametrize(
    ("width_m", "code"), [(0.9, None), (0.7, "margin_closes_way"), (0.3, "place_unreachable")]
)
def test_a_narrow_way_is_told_from_none(tmp_path: Path, width_m: float, code: str | None) -> None:
    site = made(tmp_path, walled(width_m), place=Pose2(4.5, 2.5, 0.0))
    assert codes(site) - {"place_near_fence"} == (set() if code is None else {code})


def test_floor_behind_a_wall_is_told(tmp_path: Path) -> None:
    assert "floor_apart" in codes(made(tmp_path, walled(0.0)))


def test_a_place_beside_a_wall_is_tight(tmp_path: Path) -> None:
    assert codes(made(tmp_path, flat(), place=Pose2(5.2, 2.5, 0.0))) >= {"place_tight"}


def test_a_map_without_walls_or_half_unknown_or_coarse_is_told(tmp_path: Path) -> None:
    bare = flat()
    bare[bare == 0] = 205
    bare[20:90, 45:70] = 205
    bare[20:90, 71:110] = 205
    for name, picture, cell_m, code in (
        ("a", bare, CELL_M, "no_walls"),
        ("b", bare, CELL_M, "unknown_much"),
        ("c", flat(), 0.2, "resolution_coarse"),
    ):
        (tmp_path / name).mkdir()
        assert code in codes(made(tmp_path / name, picture, cell_m=cell_m)), name


@pytest.mark.parametrize("turn_rad", [0.0, 0.5, 1.0])
def test_a_map_that_lies_askew_is_not_called_unknown_for_it(
    tmp_path: Path, turn_rad: float
) -> None:
    picture = flat()
    cv2.imwrite(str(tmp_path / "m.pgm"), picture)
    (tmp_path / "m.yaml").write_text(
        f"image: m.pgm\nresolution: {CELL_M}\norigin: [0, 0, {turn_rad}]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    new_site(load_map(tmp_path / "m.yaml"), RADIUS_M).write(tmp_path / "s")
    assert codes(tmp_path / "s") == set()


def room(room_id: str, left_m: float, right_m: float, pose: Pose2) -> str:
    corners = [(left_m, 0.5), (right_m, 0.5), (right_m, 4.4), (left_m, 4.4)]
    return place_text(room_id, "room", (room_id, f"房间{room_id}"), pose, corners)


@pytest.mark.parametrize(
    ("left_m", "stands_m", "wanted"),
    [
        (3.0, 4.0, set()),
        (2.9, 4.0, set()),
        (2.0, 4.0, {"rooms_overlap"}),
        (0.5, 4.0, {"rooms_overlap"}),
        (3.0, 1.5, {"room_apart"}),
    ],
)
def test_rooms_that_overlap_or_are_stood_in_elsewhere_are_told(
    tmp_path: Path, left_m: float, stands_m: float, wanted: set[str]
) -> None:
    folder = made(tmp_path, flat())
    with (folder / "places.yaml").open("a") as file:
        file.write(room("one", 0.5, 3.0, Pose2(1.5, 2.5, 0.0)))
        file.write(room("two", left_m, 5.4, Pose2(stands_m, 2.5, 0.0)))
    assert codes(folder) == wanted


def test_what_cannot_be_loaded_is_the_one_finding(tmp_path: Path) -> None:
    site = made(tmp_path, flat(), place=Pose2(0.1, 0.1, 0.0))
    assert codes(site) == {"place_in_obstacle"}
    (site / "map.pgm").unlink()
    assert codes(site) == {"map_image_missing"}


def test_a_threshold_that_frees_the_unknown_is_told(tmp_path: Path) -> None:
    site = made(tmp_path, flat())
    path = site / "map.yaml"
    path.write_text(path.read_text().replace("0.196", "0.25"))
    fence = site / "fence.json"
    fence.write_text(fence.read_text().replace(_map_id(fence), load_map(path).map_id))
    assert "unknown_kept" in codes(site)


def _map_id(fence: Path) -> str:
    return fence.read_text().split('"map_id":"')[1][:16]
