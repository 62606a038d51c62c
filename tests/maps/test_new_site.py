"""A map of somebody else becomes a site: its floor, its fence, its rooms, and what is refused."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from maps import FREE, SiteError, load_map
from maps.cell_array import cell_array
from maps.map_file import load_picture
from maps.new_site import NewSite, new_site
from maps.room_proposals import read_proposals
from maps.rooms import propose_rooms
from maps.site_fence import draw_fence, floor_around
from planner.site import Fence, Site
from tests.conftest import ROOT
from wire import Pose2
from wire.fence import MAX_CORNERS, FenceFile, flaw
from wire.site_map import read_map_id

RADIUS_M, CELL_M = 0.30, 0.05
Picture = NDArray[np.uint8]


def two_rooms(door_m: float = 0.9) -> Picture:
    """Draw two rooms of 4 m x 4 m and a door between them, in unknown."""
    picture: Picture = np.full((120, 200), 205, np.uint8)
    picture[18:102, 18:184] = 0
    picture[20:100, 20:100] = 254
    picture[20:100, 102:182] = 254
    half = round(door_m / CELL_M / 2)
    picture[60 - half : 60 + half, 100:102] = 254
    return picture


def written(folder: Path, picture: Picture, free_thresh: float = 0.25) -> Path:
    cv2.imwrite(str(folder / "m.pgm"), picture)
    path = folder / "m.yaml"
    path.write_text(
        f"image: m.pgm\nresolution: {CELL_M}\norigin: [-1, -1, 0]\nnegate: 0\n"
        f"occupied_thresh: 0.65\nfree_thresh: {free_thresh}\n"
    )
    return path


def test_a_map_becomes_a_site_that_loads(tmp_path: Path) -> None:
    loaded = load_map(written(tmp_path, two_rooms()))
    made = new_site(loaded, RADIUS_M)
    made.write(tmp_path / "flat")
    site = Site.load(tmp_path / "flat")
    assert site.grid == loaded.grid
    assert site.map_id == read_map_id(tmp_path / "flat")
    assert [room.id for room in read_proposals(tmp_path / "flat")] == ["room_1", "room_2"]
    with pytest.raises(SiteError, match="site_exists"):
        made.write(tmp_path / "flat")


class DyingFiles(dict[str, bytes]):
    """Be a site's files; whoever writes them is killed after so many."""

    after = 0

    def items(self) -> Iterator[tuple[str, bytes]]:  # type: ignore[override]
        """Yield name and bytes of each, as long as it lasts."""
        yield from list(super().items())[: self.after]
        os.kill(os.getpid(), signal.SIGKILL)


def die_while_writing(source: str, folder: str, after: int) -> None:
    made = new_site(load_map(Path(source)), RADIUS_M)
    files = DyingFiles(made.files)
    files.after = after
    NewSite(files, made.home, made.rooms).write(Path(folder))


@pytest.mark.parametrize("after", [0, 2, 5])
def test_killed_while_it_is_written_a_site_is_not_there_and_can_be_made_again(
    tmp_path: Path, after: int
) -> None:
    source, folder = written(tmp_path, two_rooms()), tmp_path / "sites" / "flat"
    call = f"die_while_writing({str(source)!r}, {str(folder)!r}, {after})"
    code = f"from tests.maps.test_new_site import die_while_writing; {call}"
    died = subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=False, timeout=60)
    assert died.returncode == -signal.SIGKILL
    assert not folder.exists()
    made = new_site(load_map(source), RADIUS_M)
    assert after <= len(made.files)
    made.write(folder)
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == made.files


def test_what_a_kill_left_half_written_is_in_nobodys_way(tmp_path: Path) -> None:
    made = new_site(load_map(written(tmp_path, two_rooms())), RADIUS_M)
    left = tmp_path / "sites" / ".flat.new"
    left.mkdir(parents=True)
    (left / "map.yaml").write_text("image: map.pgm\n")
    made.write(tmp_path / "sites" / "flat")
    assert {path.name for path in (tmp_path / "sites" / "flat").iterdir()} == set(made.files)


def test_what_a_map_without_room_holds_is_told(tmp_path: Path) -> None:
    picture: Picture = np.full((40, 50), 0, np.uint8)
    picture[:10], picture[20:24, 20:24] = 205, 254
    with pytest.raises(SiteError, match="map_no_floor") as refused:
        new_site(load_map(written(tmp_path, picture)), RADIUS_M)
    told = refused.value.message
    assert "of 50 x 40 cells 1 % are free, 74 % occupied, 25 % unknown" in told["en"]
    assert "空地 1%，障碍 74%，未知 25%" in told["zh"]
    assert "are resolution, negate and thresholds right?" in told["en"]
    picture[picture == 0] = 254
    yaml = written(tmp_path, picture)
    yaml.write_text(f"{yaml.read_text()}mode: raw\n")
    with pytest.raises(SiteError, match="map_no_floor") as refused:
        new_site(load_map(yaml), RADIUS_M)
    assert "a picture is mode: trinary" in refused.value.message["en"]
    assert "mode: trinary" in refused.value.message["zh"]


def test_a_persons_word_stands_in_the_pixels(tmp_path: Path) -> None:
    loaded = load_map(written(tmp_path, two_rooms()), frees_saved_unknown=True)
    assert loaded.kept_unknown > 0
    new_site(loaded, RADIUS_M).write(tmp_path / "flat")
    again = load_map(tmp_path / "flat" / "map.yaml")
    assert again.grid == loaded.grid
    assert again.grid.at(-0.9, -0.9) == FREE


def test_a_robot_that_made_the_map_begins_where_it_began(tmp_path: Path) -> None:
    loaded = load_map(written(tmp_path, two_rooms()))
    assert new_site(loaded, RADIUS_M, Pose2(1.0, 1.0, 0.5)).home == Pose2(1.0, 1.0, 0.5)
    home = new_site(loaded, RADIUS_M).home  # (0, 0) is a corner here
    assert loaded.grid.at(home.x_m, home.y_m) == FREE
    with pytest.raises(SiteError, match="place_in_obstacle"):
        new_site(loaded, RADIUS_M, Pose2(-0.9, -0.9, 0.0))


def test_floor_in_a_thousand_islands_becomes_one_site_with_a_fence_around_home(
    tmp_path: Path,
) -> None:
    picture = two_rooms()
    islands: Picture = np.full((picture.shape[0], 320), 205, np.uint8)
    islands[:, :200] = picture
    islands[2:-2:4, 202:-2:4] = 254
    made = new_site(load_map(written(tmp_path, islands, 0.19)), RADIUS_M)
    made.write(tmp_path / "s")
    site = Site.load(tmp_path / "s")
    assert site.fence.allows(made.home.x_m, made.home.y_m)
    assert not site.fence.allows(-1 + 210.5 * CELL_M, -1 + 60.5 * CELL_M)
    assert len(made.rooms) == 2


def test_walls_smeared_grey_by_jpeg_stay_walls(tmp_path: Path) -> None:
    """A map that went through a photograph's format: walls bleed into grey, floor gets spots."""
    clean = two_rooms()
    clean[clean == 205] = 0
    packed = cv2.imencode(".jpg", clean, [cv2.IMWRITE_JPEG_QUALITY, 30])[1]
    smeared = cv2.imdecode(packed, cv2.IMREAD_GRAYSCALE)
    loaded = load_map(written(tmp_path, np.asarray(smeared, np.uint8), 0.196))
    free = cell_array(loaded.grid) == FREE
    assert not free[np.flipud(clean) == 0].any()
    new_site(loaded, RADIUS_M).write(tmp_path / "s")
    assert Site.load(tmp_path / "s").rooms == ()


@pytest.mark.parametrize("grey", [0, 205])
def test_a_map_without_floor_is_refused(tmp_path: Path, grey: int) -> None:
    loaded = load_map(written(tmp_path, np.full((40, 40), grey, np.uint8)))
    with pytest.raises(SiteError, match="map_no_floor"):
        new_site(loaded, RADIUS_M)


def test_a_picture_alone_is_a_map_with_its_resolution(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "p.png"), two_rooms())
    loaded = load_picture(tmp_path / "p.png", CELL_M, (-1.0, -1.0, 0.0))
    assert loaded.grid == load_map(written(tmp_path, two_rooms())).grid
    for wrong in (0.0, -0.05, float("nan"), 10.0):
        with pytest.raises(SiteError, match="value_malformed"):
            load_picture(tmp_path / "p.png", wrong, (0.0, 0.0, 0.0))


@pytest.mark.parametrize("door_m", [0.7, 0.9, 1.2])
def test_rooms_are_cut_at_doors_and_hold_where_to_stand(tmp_path: Path, door_m: float) -> None:
    rooms = propose_rooms(load_map(written(tmp_path, two_rooms(door_m))).grid)
    assert len(rooms) == 2
    for room in rooms:
        assert 15.0 < room.area_m2 < 17.0
        assert room.clearance_m > 1.9


def test_a_wide_opening_is_no_door(tmp_path: Path) -> None:
    assert len(propose_rooms(load_map(written(tmp_path, two_rooms(1.6))).grid)) == 1


def test_the_rooms_of_our_own_homes_are_found_again(repository: Path) -> None:
    for name in ("home", "two_room"):
        site = Site.load(repository / "sites" / name)
        proposed = [site.room_at(room.x_m, room.y_m) for room in propose_rooms(site.grid)]
        assert sorted(room.id for room in proposed if room) == sorted(r.id for r in site.rooms)


def test_a_fence_lets_nobody_over_the_edge_of_the_known(tmp_path: Path) -> None:
    picture = two_rooms()
    picture[40:80, 18:20] = 205  # no wall there: stairs, for all that the map says
    grid = load_map(written(tmp_path, picture)).grid
    floor = floor_around(grid, 1.0, 1.0)
    fence = draw_fence(grid, "0" * 16, floor, RADIUS_M)
    assert flaw(fence) is None
    site_fence = Fence(fence, "")
    for y_m in np.arange(1.05, 2.95, 0.05):
        assert not site_fence.allows(0.14, float(y_m)), "0.15 m and the gate's 0.15 m: the disc"
    assert site_fence.allows(0.05, 0.5), "along a wall it is loose"
    assert site_fence.allows(4.05, 2.0), "the door is open"


@pytest.mark.parametrize("seed", range(3))
def test_a_ragged_map_gets_a_fence_without_flaw(tmp_path: Path, seed: int) -> None:
    chance = np.random.default_rng(seed)
    picture = two_rooms()
    noise = chance.random(picture.shape) < (0.002, 0.02, 0.2)[seed]
    picture[noise] = chance.choice([0, 205], int(noise.sum()))
    loaded = load_map(written(tmp_path, picture))
    made = new_site(loaded, 0.05)
    fence = FenceFile.model_validate(json.loads(made.files["fence.json"]), strict=False)
    assert flaw(fence) is None
    assert sum(map(len, fence.outlines)) <= MAX_CORNERS


def test_a_line_of_too_many_corners_is_drawn_looser(tmp_path: Path) -> None:
    """A hall with half-pillars along its walls: within a cell they take more than 1000 corners."""
    picture: Picture = np.full((900, 900), 205, np.uint8)
    picture[20:-20, 20:-20] = 0
    picture[22:-22, 22:-22] = 254
    for at in range(30, 870, 12):
        picture[22:25, at : at + 6] = picture[-25:-22, at : at + 6] = 0
        picture[at : at + 6, 22:25] = picture[at : at + 6, -25:-22] = 0
    grid = load_map(written(tmp_path, picture)).grid
    fence = draw_fence(grid, "0" * 16, floor_around(grid, 5.0, 5.0), RADIUS_M)
    assert flaw(fence) is None
    assert sum(map(len, fence.outlines)) <= MAX_CORNERS


def test_only_the_floor_around_a_point_counts(tmp_path: Path) -> None:
    picture = two_rooms()
    picture[:, 100:102] = 0
    grid = load_map(written(tmp_path, picture)).grid
    assert floor_around(grid, 1.0, 1.0).sum() == (cell_array(grid) == FREE).sum() / 2
    assert not floor_around(grid, -0.9, -0.9).any()
    assert not floor_around(grid, 99.0, 0.0).any()
