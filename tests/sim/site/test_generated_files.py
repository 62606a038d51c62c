"""The committed files follow from home.yaml, byte for byte, and agree with each other."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import yaml

from sim.site import check_fresh, load_home, parse_home, site_files, stale, write
from sim.site.__main__ import main
from sim.site.outline import area_m2, trace
from sim.site.raster import FREE, OCCUPIED, RESOLUTION_M, UNKNOWN, draw
from sim.site.shapes import Rect
from wire import ConfigError, map_id

SITES = ("home", "two_room")


@pytest.fixture(params=SITES)
def site_dir(request: pytest.FixtureRequest, repository: Path) -> Path:
    return repository / "sites" / str(request.param)


def test_committed_files_are_fresh(site_dir: Path) -> None:
    assert stale(site_dir) == []


def test_the_same_declaration_gives_the_same_bytes(site_dir: Path) -> None:
    again = parse_home((site_dir / "home.yaml").read_text("utf-8"), "read again")
    assert site_files(load_home(site_dir)) == site_files(again)


def test_stale_files_are_named_refused_and_written(site_dir: Path, tmp_path: Path) -> None:
    copy = tmp_path / site_dir.name
    shutil.copytree(site_dir, copy)
    (copy / "fence.json").unlink()
    (copy / "map.pgm").write_bytes(b"P5\n1 1\n255\n\0")
    assert stale(copy) == ["map.pgm", "fence.json"]
    with pytest.raises(ConfigError) as refusal:
        check_fresh(copy)
    assert refusal.value.code == "site_stale"
    assert write(copy) == ["map.pgm", "fence.json"]
    check_fresh(copy)


def test_the_command_line_checks_and_refuses(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy = tmp_path / "two_room"
    shutil.copytree(repository / "sites" / "two_room", copy)
    assert main(["--check", str(copy)]) == 0
    (copy / "places.yaml").write_text("", "utf-8")
    assert main(["--check", str(copy)]) == 1
    assert "stale: places.yaml" in capsys.readouterr().out
    assert (copy / "places.yaml").read_text("utf-8") == "", "checking writes nothing"
    assert main([str(copy)]) == 0
    assert main(["--check", str(copy)]) == 0
    (copy / "home.yaml").write_text("version: 1\n", "utf-8")
    assert main(["--check", str(copy)]) == 2
    assert capsys.readouterr().err.startswith("home_invalid: ")


def test_without_any_site_it_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["--check"]) == 2
    assert capsys.readouterr().err.startswith("no_sites: ")


def test_the_fence_names_the_map(site_dir: Path) -> None:
    fence = json.loads((site_dir / "fence.json").read_text("utf-8"))
    expected = map_id((site_dir / "map.yaml").read_bytes(), (site_dir / "map.pgm").read_bytes())
    assert fence["map_id"] == expected


def test_the_picture_is_the_grid_turned_over(site_dir: Path) -> None:
    grid = draw(load_home(site_dir))
    data = (site_dir / "map.pgm").read_bytes()
    rows, columns = grid.cells.shape
    head = f"P5\n{columns} {rows}\n255\n".encode()
    assert data.startswith(head)
    picture = np.frombuffer(data[len(head) :], dtype=np.uint8).reshape(rows, columns)
    assert np.array_equal(np.flipud(picture), grid.cells)
    settings = yaml.safe_load((site_dir / "map.yaml").read_text("utf-8"))
    assert settings["resolution"] == RESOLUTION_M
    assert settings["origin"] == [grid.x0_m, grid.y0_m, 0.0]
    # As Nav2 reads it: free, unknown and occupied stay three kinds.
    occupancy = {grey: (255 - grey) / 255 for grey in (FREE, UNKNOWN, OCCUPIED)}
    assert occupancy[FREE] < settings["free_thresh"] < occupancy[UNKNOWN]
    assert occupancy[UNKNOWN] < settings["occupied_thresh"] < occupancy[OCCUPIED]


def test_places_say_what_the_home_says(site_dir: Path) -> None:
    home = load_home(site_dir)
    written = yaml.safe_load((site_dir / "places.yaml").read_text("utf-8"))
    assert written["home"] == home.dock
    by_id = {place["id"]: place for place in written["places"]}
    assert list(by_id) == [*home.rooms, *home.places]
    for room_id, room in home.rooms.items():
        assert by_id[room_id]["kind"] == "room"
        corners = np.array(by_id[room_id]["polygon"])
        assert [*corners.min(axis=0), *corners.max(axis=0)] == list(room.box)
        assert by_id[room_id]["name"] == {"en": room.name.en, "zh": room.name.zh}
    for place_id, place in home.places.items():
        pose = by_id[place_id]["pose"]
        assert (pose["x_m"], pose["y_m"]) == place.pose[:2]
        assert np.degrees(pose["yaw_rad"]) == pytest.approx(place.pose[2], abs=1e-4)


def test_the_default_home_has_what_is_promised(repository: Path) -> None:
    home = load_home(repository / "sites" / "home")
    named = {room_id: room.name.zh for room_id, room in home.rooms.items()}
    named |= {place_id: place.name.zh for place_id, place in home.places.items()}
    assert named == {
        "living_room": "客厅", "kitchen": "厨房", "bedroom": "卧室", "bathroom": "卫生间",
        "study": "书房", "hallway": "走廊", "entrance": "玄关", "sofa": "沙发", "tv": "电视",
        "dining_table": "餐桌", "fridge": "冰箱", "bed": "床", "desk": "书桌",
        "charging_dock": "充电桩", "front_door": "大门",
    }  # fmt: skip


def test_the_union_of_rectangles_is_traced() -> None:
    ring = [Rect(0, 0, 4, 1), Rect(0, 3, 4, 4), Rect(0, 0, 1, 4), Rect(3, 0, 4, 4)]
    outer, hole = sorted(trace(ring), key=area_m2, reverse=True)
    assert (area_m2(outer), area_m2(hole)) == (16.0, -4.0)
    assert sorted(outer) == [(0, 0), (0, 4), (4, 0), (4, 4)]
    touching = trace([Rect(0, 0, 1, 1), Rect(1, 1, 2, 2)])
    assert [area_m2(loop) for loop in touching] == [1.0, 1.0]
    steps = trace([Rect(0, 0, 2, 1), Rect(0, 0, 1, 2)])
    assert steps == [[(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]]
