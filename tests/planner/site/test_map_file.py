"""Hold the map loader to the format, to every refusal, and to maps made by others."""

from __future__ import annotations

import json
import os
import tracemalloc
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import yaml

from planner.site import FREE, OCCUPIED, UNKNOWN, SiteError, load_map
from wire import map_id

GOOD = {
    "image": "map.pgm",
    "resolution": 0.5,
    "origin": [-1.0, 2.0, 0],
    "negate": 0,
    "occupied_thresh": 0.65,
    "free_thresh": 0.196,
}
PIXELS = bytes([0, 205, 254, 254, 254, 0])  # the first row is the top
IMAGE = b"P5 3 2 255\n" + PIXELS


def write(folder: Path, changes: dict[str, Any], image: bytes = IMAGE) -> Path:
    (folder / "map.pgm").write_bytes(image)
    path = folder / "map.yaml"
    path.write_text(yaml.safe_dump({**GOOD, **changes}))
    return path


def refusal(path: Path) -> SiteError:
    with pytest.raises(SiteError) as caught:
        load_map(path)
    return caught.value


def test_rows_grow_with_y_and_thresholds_sort_the_grey(tmp_path: Path) -> None:
    grid = load_map(write(tmp_path, {})).grid
    assert list(grid.cells) == [FREE, FREE, OCCUPIED, OCCUPIED, UNKNOWN, FREE]
    assert grid.at(-0.9, 2.9) == OCCUPIED
    assert grid.at(-0.9, 2.1) == FREE
    assert grid.centre_of(0, 0) == (-0.75, 2.25)


def test_beyond_the_edge_nothing_is_known(tmp_path: Path) -> None:
    grid = load_map(write(tmp_path, {})).grid
    assert grid.at(-1.01, 2.1) == UNKNOWN
    assert grid.at(0.51, 2.1) == UNKNOWN
    assert grid.at(0.0, 3.01) == UNKNOWN


def test_negate_turns_black_and_white_round(tmp_path: Path) -> None:
    grid = load_map(write(tmp_path, {"negate": 1})).grid
    assert list(grid.cells[:3]) == [OCCUPIED, OCCUPIED, FREE]


def test_a_free_threshold_above_the_grey_frees_it(tmp_path: Path) -> None:
    assert UNKNOWN not in load_map(write(tmp_path, {"free_thresh": 0.25})).grid.cells


def test_the_map_is_named_by_its_bytes(tmp_path: Path) -> None:
    path = write(tmp_path, {})
    assert load_map(path).map_id == map_id(path.read_bytes(), IMAGE)


def test_plain_pgm_and_another_white_read_the_same(tmp_path: Path) -> None:
    wanted = load_map(write(tmp_path, {})).grid
    plain = b"P2\n# made by hand\n3 2\n255\n0 205 254\n254 254 0\n"
    assert load_map(write(tmp_path, {}, plain)).grid == wanted
    hundred = b"P5 3 2 100\n" + bytes([0, 80, 100, 100, 100, 0])
    assert load_map(write(tmp_path, {}, hundred)).grid == wanted


def test_png_reads_as_pgm_does(tmp_path: Path) -> None:
    wanted = load_map(write(tmp_path, {})).grid
    grey = np.frombuffer(PIXELS, np.uint8).reshape(2, 3)
    cv2.imwrite(str(tmp_path / "map.png"), grey)
    assert load_map(write(tmp_path, {"image": "map.png"})).grid == wanted
    cv2.imwrite(str(tmp_path / "map.png"), np.dstack([grey] * 3))
    assert load_map(write(tmp_path, {"image": "map.png"})).grid == wanted


@pytest.mark.parametrize(
    ("changes", "code"),
    [
        ({"image": "nowhere.pgm"}, "map_image_missing"),
        ({"origin": [0, 0, 0.1]}, "map_rotated"),
        ({"mode": "scale"}, "map_mode_unsupported"),
        ({"mode": "raw"}, "map_mode_unsupported"),
        ({"free_thresh": 0.7}, "map_thresholds_crossed"),
        ({"resolutoin": 0.05}, "unknown_key"),
        ({"resolution": 0.0}, "value_malformed"),
        ({"resolution": float("nan")}, "value_malformed"),
        ({"origin": [0, 0]}, "value_malformed"),
        ({"origin": [float("inf"), 0, 0]}, "value_malformed"),
        ({"negate": 2}, "value_malformed"),
        ({"occupied_thresh": 1.5}, "value_malformed"),
        ({"image": None}, "value_malformed"),
    ],
)
def test_a_wrong_value_is_refused_by_name(
    tmp_path: Path, changes: dict[str, Any], code: str
) -> None:
    error = refusal(write(tmp_path, changes))
    assert error.code == code
    assert str(tmp_path) in error.message["en"]
    assert error.message["zh"] != error.message["en"]


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"- a\n",
        b"image: [\n",
        b"\xff\xfe\xff",
        b"image: a\nimage: b\n",
        b"1: 2\n",
        b"a: &a [*a]",
        *(b"a: !!timestamp x", b"a: !!bool x", b"a: !!int ''", b"a: !!float x", b"a: !!map [a]"),
        *(b"a: 2001-99-99", b"a: " + b"9" * 5_000, b"[" * 20_000),
    ],
    ids=lambda text: str(text[:20]),
)
def test_what_is_no_map_yaml_is_refused(tmp_path: Path, text: bytes) -> None:
    path = tmp_path / "map.yaml"
    path.write_bytes(text)
    assert refusal(path).code in {"yaml_malformed", "value_malformed", "unknown_key"}


def test_an_alias_is_refused_before_it_is_followed(tmp_path: Path) -> None:
    """Nine lines of nine aliases each once took more than 40 s and all memory."""
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 10)]
    path = tmp_path / "map.yaml"
    path.write_text("\n".join(lines))
    error = refusal(path)
    assert error.code == "yaml_malformed"
    assert "line 2: an alias (*); write the value out" in error.message["en"]


@pytest.mark.parametrize("name", ["../map.pgm", "/dev/zero", "../../../../etc/passwd"])
def test_a_picture_outside_the_sites_folder_is_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / "site").mkdir()
    (tmp_path / "map.pgm").write_bytes(IMAGE)
    error = refusal(write(tmp_path / "site", {"image": name}))
    assert error.code == "map_image_outside"
    assert name in error.message["en"]


@pytest.mark.timeout(10)
def test_a_picture_that_is_a_pipe_or_far_too_large_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path, {})
    with (tmp_path / "map.pgm").open("wb") as file:
        file.truncate(2 << 30)
    assert refusal(path).code == "map_image_too_large"
    (tmp_path / "map.pgm").unlink()
    os.mkfifo(tmp_path / "map.pgm")
    error = refusal(path)
    assert error.code == "map_image_missing"
    assert "not a regular file" in error.message["en"]


def test_plain_numbers_are_read_one_at_a_time_and_no_more_than_wanted(tmp_path: Path) -> None:
    image = b"P2 3 2 255\n" + b"0 205 254 254 254 0 " + b"7 " * 500_000 + b"x"
    path = write(tmp_path, {}, image)
    tracemalloc.start()
    try:
        assert load_map(path).grid == load_map(write(tmp_path, {})).grid
        assert tracemalloc.get_traced_memory()[1] < 8_000_000
    finally:
        tracemalloc.stop()


def test_yaml_makes_no_objects(tmp_path: Path) -> None:
    path = tmp_path / "map.yaml"
    path.write_text("image: !!python/object/apply:os.getcwd []\n")
    assert refusal(path).code == "yaml_malformed"


@pytest.mark.parametrize(
    ("image", "code"),
    [
        (b"", "map_image_malformed"),
        (b"GIF89a", "map_image_malformed"),
        (b"P5 3 2 255\n" + PIXELS[:-1], "map_image_malformed"),
        (b"P5 3 2 65535\n" + PIXELS * 2, "map_image_malformed"),
        (b"P5 3 2 0\n" + PIXELS, "map_image_malformed"),
        (b"P2 3 2 255\n0 1 2 3 4 x", "map_image_malformed"),
        (b"P5 3 2 100\n" + PIXELS, "map_image_malformed"),
        (b"P5 0 2 255\n", "map_image_too_large"),
        (b"P5 99999 99999 255\n" + PIXELS, "map_image_too_large"),
        (b"P5 " + b"9" * 5000 + b" 2 255\n" + PIXELS, "map_image_malformed"),
        (b"\x89PNG\r\n\x1a\n" + b"\0\0\0\rIHDR" + b"\0\0\0\1" * 2, "map_image_malformed"),
        (b"\x89PNG\r\n\x1a\n" + b"\0\0\0\rIHDR" + b"\x7f\0\0\0" * 2, "map_image_too_large"),
    ],
)
def test_a_broken_picture_is_refused(tmp_path: Path, image: bytes, code: str) -> None:
    assert refusal(write(tmp_path, {}, image)).code == code


def test_a_png_chunk_that_claims_two_gigabytes_is_refused_before_it_is_allotted(
    tmp_path: Path,
) -> None:
    whole = cv2.imencode(".png", np.zeros((3, 4), np.uint8))[1].tobytes()
    at = whole.index(b"IDAT") - 4
    image = whole[:at] + b"\x7f\xff\xff\xfftEXtxxxx" + whole[at:]
    refused = refusal(write(tmp_path, {}, image))
    assert refused.code == "map_image_malformed"
    assert "chunks speak of more" in str(refused)


def test_a_missing_map_yaml_is_named(tmp_path: Path) -> None:
    assert refusal(tmp_path / "map.yaml").code == "site_file_missing"


def test_a_missing_picture_names_what_is_there(tmp_path: Path) -> None:
    error = refusal(write(tmp_path, {"image": "nowhere.pgm"}))
    assert "map.pgm" in error.message["en"]


SHARED = Path(__file__).resolve().parents[4] / "shared" / "data" / "maps"
FOREIGN = {
    "aws_small_house/map.yaml": (500, 500),
    "nav2_depot/depot.yaml": (604, 307),
    "nav2_depot_keepout/depot_keepout.yaml": (604, 307),
    "nav2_depot_speed/depot_speed.yaml": "map_mode_unsupported",
    "nav2_map_server_test/invalid_image.yaml": "map_image_missing",
    "nav2_map_server_test/testmap.yaml": "map_rotated",
    "nav2_systests/empty_room.yaml": "map_image_missing",
    "nav2_systests/keepout_mask.yaml": (384, 384),
    "nav2_systests/map_circular.yaml": (384, 384),
    "nav2_systests/speed_mask.yaml": "map_mode_unsupported",
    "nav2_tb3_sandbox/tb3_sandbox.yaml": (384, 384),
    "turtlebot3_world/map.yaml": (384, 384),
}


@pytest.mark.parametrize("name", FOREIGN)
def test_maps_made_by_others_load_or_are_refused(name: str) -> None:
    if not SHARED.is_dir():
        pytest.skip("no foreign maps beside this checkout (../shared/data/maps)")
    wanted = FOREIGN[name]
    if isinstance(wanted, str):
        assert refusal(SHARED / name).code == wanted
        return
    grid = load_map(SHARED / name).grid
    assert (grid.width, grid.height) == wanted
    assert grid.cells.count(FREE) > 1000
    assert grid.cells.count(OCCUPIED) > 100


def test_every_foreign_map_is_listed_here() -> None:
    if not SHARED.is_dir():
        pytest.skip("no foreign maps beside this checkout (../shared/data/maps)")
    found = {path.relative_to(SHARED).as_posix() for path in SHARED.rglob("*.yaml")}
    assert found == set(FOREIGN), json.dumps(sorted(found))
