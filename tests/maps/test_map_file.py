"""Hold the map loader to the format and to every refusal."""

from __future__ import annotations

import os
import tracemalloc
import zlib
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import yaml
from numpy.typing import NDArray

from maps import FREE, OCCUPIED, UNKNOWN, SiteError, load_map
from maps.cell_array import cell_array
from wire import map_id
from wire.site_map import read_map_id

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


@pytest.mark.parametrize("mode", ["trinary", "scale"])
@pytest.mark.parametrize("negate", [0, 1])
def test_no_threshold_frees_the_grey_that_map_savers_write_for_unknown(
    tmp_path: Path, mode: str, negate: int
) -> None:
    """Nav2's own default of 0.25 makes 34 % of one office free that nobody ever saw."""
    pixels = bytes(255 - grey for grey in PIXELS) if negate else PIXELS
    changes = {"free_thresh": 0.25, "mode": mode, "negate": negate}
    loaded = load_map(write(tmp_path, changes, b"P5 3 2 255\n" + pixels))
    assert loaded.grid == load_map(write(tmp_path, {})).grid
    assert loaded.kept_unknown == 1
    assert load_map(write(tmp_path, {})).kept_unknown == 0


@pytest.mark.parametrize("free_thresh", [0.25, 0.196])
@pytest.mark.parametrize("negate", [0, 1])
def test_the_grey_that_jpeg_makes_of_unknown_is_not_floor_either(
    tmp_path: Path, free_thresh: float, negate: int
) -> None:
    greys = bytes((200, 201, 202, 205, 206, 208, 209, 254))
    wanted = [FREE if free_thresh == 0.25 else UNKNOWN] * 2 + [UNKNOWN] * 4 + [FREE] * 2
    image = b"P5 8 1 255\n" + (bytes(255 - grey for grey in greys) if negate else greys)
    changes = {"free_thresh": free_thresh, "negate": negate}
    loaded = load_map(write(tmp_path, changes, image))
    assert list(loaded.grid.cells) == wanted
    assert loaded.kept_unknown == (4 if free_thresh == 0.25 else 2)
    freed = load_map(write(tmp_path, changes, image), frees_saved_unknown=True)
    assert list(freed.grid.cells).count(UNKNOWN) == (0 if free_thresh == 0.25 else 4)


@pytest.mark.parametrize("quality", [10, 30, 95])
def test_a_map_that_was_a_jpeg_frees_nothing_that_was_unknown(tmp_path: Path, quality: int) -> None:
    clean = np.full((64, 64), 254, np.uint8)
    clean[:, :40], clean[:, 40:44] = 205, 0
    packed = cv2.imencode(".jpg", clean, [cv2.IMWRITE_JPEG_QUALITY, quality])[1]
    smeared = np.asarray(cv2.imdecode(packed, cv2.IMREAD_GRAYSCALE), np.uint8)
    image = b"P5 64 64 255\n" + smeared.tobytes()
    loaded = load_map(write(tmp_path, {"free_thresh": 0.25}, image))
    cells = np.flipud(cell_array(loaded.grid))
    assert not (cells[:, :32] == FREE).any(), "blocks of 8 x 8 without an edge stay flat"
    assert (cells[:, 48:] == FREE).all()


@pytest.mark.parametrize(
    ("mode", "greys", "kinds"),
    [
        ("trinary", (0, 100, 205, 230, 254, 255), (1, 2, 2, 0, 0, 0)),
        ("scale", (0, 100, 205, 230, 254, 255), (1, 2, 2, 0, 0, 0)),
        ("raw", (0, 19, 20, 66, 100, 101), (0, 0, 2, 1, 1, 2)),
    ],
)
def test_each_mode_sorts_the_greys(
    tmp_path: Path, mode: str, greys: tuple[int, ...], kinds: tuple[int, ...]
) -> None:
    image = b"P5 6 1 255\n" + bytes(greys)
    for negate in (0, 1):
        turned = b"P5 6 1 255\n" + bytes(255 - grey for grey in greys)
        inverted = negate == 1 and mode != "raw"  # Nav2 takes no notice of it in mode raw
        changes = {"mode": mode, "negate": negate}
        loaded = load_map(write(tmp_path, changes, turned if inverted else image))
        assert tuple(loaded.grid.cells) == kinds


@pytest.mark.parametrize("mode", ["trinary", "scale", "raw"])
@pytest.mark.parametrize("kind", [np.uint8, np.uint16])
def test_what_is_not_opaque_is_unknown(tmp_path: Path, mode: str, kind: type) -> None:
    white = np.iinfo(kind).max
    picture: NDArray[Any] = np.full((1, 3, 4), white, kind)
    picture[0, 1, :3] = 0
    picture[0, :, 3] = (white, white, white - 1)
    cv2.imwrite(str(tmp_path / "map.png"), picture)
    wanted = {"trinary": [FREE, OCCUPIED, UNKNOWN], "scale": [FREE, OCCUPIED, UNKNOWN]}
    grid = load_map(write(tmp_path, {"image": "map.png", "mode": mode})).grid
    assert list(grid.cells) == wanted.get(mode, [UNKNOWN, FREE, UNKNOWN])


@pytest.mark.parametrize("negate", [True, False])
def test_negate_may_be_a_word(tmp_path: Path, negate: bool) -> None:
    wanted = load_map(write(tmp_path, {"negate": int(negate)})).grid
    assert load_map(write(tmp_path, {"negate": negate})).grid == wanted


def test_a_quarter_turn_is_exact(tmp_path: Path) -> None:
    plain = load_map(write(tmp_path, {"origin": [0, 0, 0]})).grid
    turned = load_map(write(tmp_path, {"origin": [0, 0, np.pi / 2]})).grid
    assert (turned.width, turned.height) == (plain.height, plain.width)
    assert (turned.origin_x_m, turned.origin_y_m) == (-1.0, 0.0)
    for column in range(plain.width):
        for row in range(plain.height):
            x_m, y_m = plain.centre_of(column, row)
            assert turned.at(-y_m, x_m) == plain.at(x_m, y_m)


@pytest.mark.parametrize("yaw_rad", [0.01, np.pi / 4, 2.5, -3.0, 7.0])
def test_a_turned_map_keeps_its_walls_whole_and_frees_nothing(
    tmp_path: Path, yaw_rad: float
) -> None:
    picture = np.full((60, 80), 254, np.uint8)
    picture[0], picture[-1], picture[:, 0], picture[:, -1] = 0, 0, 0, 0
    picture[20, :50] = 0
    picture[30:40, 60:70] = 205
    image = b"P5 80 60 255\n" + picture.tobytes()
    plain = load_map(write(tmp_path, {"resolution": 0.1, "origin": [0, 0, 0]}, image)).grid
    changes = {"resolution": 0.1, "origin": [3.0, -2.0, yaw_rad]}
    grid = load_map(write(tmp_path, changes, image)).grid
    cells = cell_array(grid)
    for row, column in np.argwhere(cells == FREE):
        x_m, y_m = grid.centre_of(int(column), int(row))
        dx, dy = x_m - 3.0, y_m + 2.0
        along = dx * np.cos(yaw_rad) + dy * np.sin(yaw_rad)
        assert plain.at(along, dy * np.cos(yaw_rad) - dx * np.sin(yaw_rad)) == FREE
    # Nobody gets out through the walls, not even from corner to corner of two cells.
    open_cells = np.pad((cells != OCCUPIED).astype(np.uint8), 1, constant_values=1)
    _, parts = cv2.connectedComponents(open_cells, connectivity=8)
    assert not np.isin(parts[1:-1, 1:-1][cells == FREE], parts[0, 0]).any()


def test_a_turned_map_that_grows_too_large_is_refused(tmp_path: Path) -> None:
    path = write(tmp_path, {"origin": [0, 0, 0.7]}, b"P5 20000 200 255\n" + bytes(4_000_000))
    assert refusal(path).code == "map_image_too_large"


def test_the_map_is_named_by_its_bytes(tmp_path: Path) -> None:
    path = write(tmp_path, {})
    assert load_map(path).map_id == map_id(path.read_bytes(), IMAGE)


def test_plain_pgm_and_another_white_read_the_same(tmp_path: Path) -> None:
    wanted = load_map(write(tmp_path, {})).grid
    plain = b"P2\n# made by hand\n3 2\n255\n0 205 254\n254 254 0\n"
    assert load_map(write(tmp_path, {}, plain)).grid == wanted
    deep = np.frombuffer(PIXELS, np.uint8).astype(">u2") * 257
    assert load_map(write(tmp_path, {}, b"P5 3 2 65535\n" + deep.tobytes())).grid == wanted
    noted = b"P5\n# CREATOR: a map saver\n3 2\n# white\n255\n" + PIXELS
    assert load_map(write(tmp_path, {}, noted)).grid == wanted
    long = b"P2 3 2 65535\n" + b" ".join(str(value).encode() for value in deep)
    assert load_map(write(tmp_path, {}, long)).grid == wanted
    assert load_map(write(tmp_path, {}, IMAGE + b"a second picture")).grid == wanted
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
        ({"origin": [0, 0, float("nan")]}, "value_malformed"),
        ({"origin": [1e9, 0, 0]}, "value_malformed"),
        ({"origin": [0, 0, 0, 0]}, "value_malformed"),
        ({"mode": "mapping"}, "value_malformed"),
        ({"free_thresh": 0.7}, "map_thresholds_crossed"),
        ({"free_thresh": 0.65}, "map_thresholds_crossed"),
        ({"resolutoin": 0.05}, "unknown_key"),
        ({"resolution": 0.0}, "value_malformed"),
        ({"resolution": -0.05}, "value_malformed"),
        ({"resolution": 1e-9}, "value_malformed"),
        ({"resolution": 10.0}, "value_malformed"),
        ({"resolution": float("nan")}, "value_malformed"),
        ({"resolution": True}, "value_malformed"),
        ({"occupied_thresh": True}, "value_malformed"),
        ({"origin": [1e4, 0, 0]}, "value_malformed"),
        ({"origin": [-1e4, 0, 2.0]}, "value_malformed"),
        ({"origin": [0, 0]}, "value_malformed"),
        ({"origin": [float("inf"), 0, 0]}, "value_malformed"),
        ({"negate": 2}, "value_malformed"),
        ({"negate": "1"}, "value_malformed"),
        ({"image": "."}, "map_image_missing"),
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
        (b"GIF89a", "map_image_malformed"),
        (b"P5 3 2 255\n" + PIXELS[:-1], "map_image_malformed"),
        (b"P5 3 2 65535\n" + PIXELS, "map_image_malformed"),
        (b"P5 3 2 300\n" + PIXELS * 2, "map_image_malformed"),
        (b"P5 3 2 65536\n" + PIXELS * 2, "map_image_malformed"),
        (b"P2 3 2 255\n0 1 2 3 4", "map_image_malformed"),
        (b"P5 20000 20000 255\n", "map_image_too_large"),
        (b"P5 3 2 0\n" + PIXELS, "map_image_malformed"),
        (b"P5 3 2 100\n" + PIXELS, "map_image_malformed"),
        (b"P5 99999 99999 255\n" + PIXELS, "map_image_too_large"),
        (b"P5 " + b"9" * 5000 + b" 2 255\n" + PIXELS, "map_image_malformed"),
        (b"\x89PNG\r\n\x1a\n" + b"\0\0\0\rIHDR" + b"\0\0\0\1" * 2, "map_image_malformed"),
        (b"\x89PNG\r\n\x1a\n" + b"\0\0\0\rIHDR" + b"\x7f\0\0\0" * 2, "map_image_too_large"),
    ],
)
def test_a_broken_picture_is_refused(tmp_path: Path, image: bytes, code: str) -> None:
    assert refusal(write(tmp_path, {}, image)).code == code


@pytest.mark.parametrize(
    ("image", "en", "zh"),
    [
        (b"", "got an empty file, expected PGM (P2, P5) or PNG", "请先转换"),
        (b"\xff\xd8\xff\xe0", "got a JPEG, expected PGM", "收到 JPEG"),
        (b"words", "a file that begins b'words'", "请先转换"),
        (b"P5 0 2 255\n", "0 x 2 pixels; expected 1 to", "0 x 2"),
        (b"P2 3 2 255\n0 1 x", "pixel 3 is b'x', expected 0 to 255", "第 3 个像素"),
        (b"P2 3 2 255\n0 999 0 0 0 0", "pixel 2 is 999, expected 0 to 255", "第 2 个像素是 999"),
        (b"P2 3 2 100\n0 0 0 0 0 -1", "pixel 6 is -1, expected 0 to 100", "应为 0 到 100"),
        (b"P2 3 2 255\n# here\n0 1", "a comment (#) behind the value of white", "注释"),
        (b"P5 3 2 255\n# here\n" + PIXELS, "a comment (#) behind the value", "注释"),
    ],
)
def test_a_broken_picture_is_told_by_what_came(
    tmp_path: Path, image: bytes, en: str, zh: str
) -> None:
    error = refusal(write(tmp_path, {}, image))
    assert error.code == "map_image_malformed"
    assert en in error.message["en"]
    assert zh in error.message["zh"]


def test_a_pixel_that_looks_like_a_comment_is_one(tmp_path: Path) -> None:
    image = b"P5 3 2 255\n#" + PIXELS[1:]
    assert list(load_map(write(tmp_path, {}, image)).grid.cells)[3:] == [OCCUPIED, UNKNOWN, FREE]


def test_an_image_that_is_missing_is_told_with_those_that_are_there(tmp_path: Path) -> None:
    (tmp_path / "old.png").mkdir()
    error = refusal(write(tmp_path, {"image": "nowhere.pgm"}))
    assert f"images in {tmp_path}: map.pgm" in error.message["en"]
    assert f"{tmp_path} 中的图像：map.pgm" in error.message["zh"]


@pytest.mark.parametrize(
    "name",
    ["~/map.pgm", "sandbox/map.pgm", "/home/someone/maps/map.pgm", r"C:\maps\map.pgm", "MAP.pgm"],
)
def test_an_image_that_lies_beside_its_yaml_is_named_with_how_to_write_it(
    tmp_path: Path, name: str
) -> None:
    there = "Map.PGM" if name == "MAP.pgm" else "map.pgm"
    path = write(tmp_path, {"image": name})
    (tmp_path / "map.pgm").rename(tmp_path / there)
    error = refusal(path)
    assert error.code in {"map_image_missing", "map_image_outside"}
    assert f"images in {tmp_path}: {there}; write 'image: {there}'" in error.message["en"]
    assert f"请写作'image: {there}'" in error.message["zh"]


def test_a_byte_order_mark_before_the_yaml_is_read_past(tmp_path: Path) -> None:
    path = write(tmp_path, {})
    told = load_map(path).grid
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes())
    assert load_map(path).grid == told


def test_a_png_chunk_that_claims_two_gigabytes_is_refused_before_it_is_allotted(
    tmp_path: Path,
) -> None:
    whole = cv2.imencode(".png", np.zeros((3, 4), np.uint8))[1].tobytes()
    at = whole.index(b"IDAT") - 4
    image = whole[:at] + b"\x7f\xff\xff\xfftEXtxxxx" + whole[at:]
    refused = refusal(write(tmp_path, {}, image))
    assert refused.code == "map_image_malformed"
    assert "chunks speak of more" in str(refused)


def test_a_png_of_many_bytes_a_pixel_is_refused_before_it_is_unpacked(tmp_path: Path) -> None:
    deep = cv2.imencode(".png", np.zeros((8, 8, 4), np.uint16))[1].tobytes()
    head = b"IHDR" + (8000).to_bytes(4) * 2 + deep[24:29]
    image = deep[:12] + head + zlib.crc32(head).to_bytes(4) + deep[33:]
    refused = refusal(write(tmp_path, {}, image))
    assert refused.code == "map_image_too_large"
    assert "colour type 6 and 16 bits" in str(refused)


@pytest.mark.parametrize("size", [(3, 5), (4, 4), (2, 4), (3, 2), (6, 2)])
def test_a_png_whose_header_lies_is_refused(tmp_path: Path, size: tuple[int, int]) -> None:
    whole = cv2.imencode(".png", np.zeros((3, 4), np.uint8))[1].tobytes()
    head = b"IHDR" + size[1].to_bytes(4) + size[0].to_bytes(4) + whole[24:29]
    image = whole[:12] + head + zlib.crc32(head).to_bytes(4) + whole[33:]
    assert refusal(write(tmp_path, {}, image)).code == "map_image_malformed"


@pytest.mark.parametrize(
    "line",
    ["image: a#b.pgm", 'image: "map\\x2epgm"', "image: >\n  map.pgm", "image: map.pgm x\n  y"],
)
def test_an_image_that_the_bridge_would_read_otherwise_is_refused(
    tmp_path: Path, line: str
) -> None:
    """The bridge finds the image without YAML; a map must have one name for all."""
    path = write(tmp_path, {})
    (tmp_path / "a#b.pgm").write_bytes(IMAGE)
    rest = "\n".join(text for text in path.read_text().splitlines() if "image" not in text)
    path.write_text(f"{line}\n{rest}\n")
    assert refusal(path).code == "map_image_ambiguous"


@pytest.mark.parametrize("image", ["map.pgm", "'map.pgm'  # north up", '"map.pgm"'])
def test_every_process_calls_a_map_by_one_name(tmp_path: Path, image: str) -> None:
    path = write(tmp_path, {})
    rest = "\n".join(text for text in path.read_text().splitlines() if "image" not in text)
    path.write_text(f"# from a robot\nimage: {image}\n{rest}\n")
    assert load_map(path).map_id == read_map_id(tmp_path)


@pytest.mark.parametrize(
    ("site", "name"), [("home", "7cf47ac07b7d0d59"), ("two_room", "bf7e3febf0c3b29b")]
)
def test_the_names_of_our_own_maps_stay(repository: Path, site: str, name: str) -> None:
    """Taught places and fences of homes in use are kept under these names."""
    assert load_map(repository / "sites" / site / "map.yaml").map_id == name
    assert read_map_id(repository / "sites" / site) == name


def test_a_missing_map_yaml_is_named(tmp_path: Path) -> None:
    assert refusal(tmp_path / "map.yaml").code == "site_file_missing"
