"""Unpack good and bad pictures, and lay out several on a sheet: never an exception."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner.brain.image_questions import LONG_SIDE_PX, MAX_VIEWS
from planner.perception.detect import ModelOptions, OnnxDetector, lay_out, shrink, unpack_color
from planner.perception.detect.pictures import GAP_PX, LABEL_PX, Picture, grid_of
from planner.perception.failure import SKIPS
from tests.laws import at_least
from tests.planner.perception.detect import tiny
from tests.planner.perception.detect.tiny import Array, Seen, encoded
from wire.image_header import read_header

RNG = np.random.default_rng(6)
COLOR = RNG.integers(0, 255, (48, 64, 3), np.uint8)
DEPTH = RNG.integers(400, 5000, (48, 64)).astype(np.uint16)
JPEG, PNG, DEEP = encoded(".jpg", COLOR), encoded(".png", COLOR), encoded(".png", DEPTH)


def png(width: int, height: int, bits: int = 8, kind: int = 2) -> bytes:
    """Return a PNG that says so of itself and holds nothing."""
    body = b"IHDR" + struct.pack(">IIBBBBB", width, height, bits, kind, 0, 0, 0)
    head = struct.pack(">I", 13) + body + struct.pack(">I", zlib.crc32(body))
    return b"\x89PNG\r\n\x1a\n" + head + b"\0\0\0\0IEND\xaeB`\x82"


def claiming(data: bytes) -> bytes:
    """Return a PNG with a chunk that claims 2 GB, which the decoder would allot."""
    at = data.index(b"IDAT") - 4
    return data[:at] + struct.pack(">I", 2**31 - 1) + b"tEXtxxxx" + data[at:]


def resized(data: bytes, width: int, height: int) -> bytes:
    """Return a JPEG that says another size of itself."""
    at = data.index(b"\xff\xc0")
    return data[: at + 5] + struct.pack(">HH", height, width) + data[at + 9 :]


@pytest.fixture(scope="module")
def detector(tmp_path_factory: pytest.TempPathFactory) -> OnnxDetector:
    path = tmp_path_factory.mktemp("model") / "m.onnx"
    outputs = tiny.yolov8([Seen((16.0, 16.0, 48.0, 40.0), 1, 0.9)])
    return OnnxDetector(ModelOptions(tiny.model(path, outputs, metadata=tiny.ULTRALYTICS)))


BAD_COLOR = [
    (b"", "picture_not_known"),
    (b"GIF89a" + bytes(50), "picture_not_known"),
    (b"\xff\xd8\xff", "picture_not_known"),
    (png(0, 0), "picture_empty"),
    (resized(JPEG, 0, 0), "picture_empty"),
    (png(50_000, 50_000), "picture_too_large"),
    (resized(JPEG, 50_000, 50_000), "picture_too_large"),
    (png(2_000_000_000, 1), "picture_too_large"),
    (encoded(".jpg", COLOR[:, :, 0]), "picture_one_channel"),
    (encoded(".png", COLOR[:, :, 0]), "picture_one_channel"),
    (encoded(".png", COLOR.astype(np.uint16) * 200), "picture_deep"),
    (DEEP, "picture_deep"),
    (png(64, 48, 4, 0), "picture_one_channel"),
    (png(64, 48, 4, 2), "picture_undecodable"),
    (JPEG.replace(b"\xff\xc0\0\x11\x08", b"\xff\xc0\0\x11\x04"), "picture_undecodable"),
    (JPEG[: len(JPEG) // 2], "picture_truncated"),
    (PNG[:-12], "picture_truncated"),
    (claiming(PNG), "picture_truncated"),
    (png(64, 48), "picture_undecodable"),
    (encoded(".jpg", COLOR[:40]), "picture_size_wrong"),
    (encoded(".jpg", COLOR // 32), "picture_dark"),
]
BAD_DEPTH = [
    (b"", "depth_not_known"),
    (JPEG, "depth_not_known"),
    (PNG, "depth_not_known"),
    (encoded(".png", (DEPTH // 256).astype(np.uint8)), "depth_not_known"),
    (DEEP[:-12], "depth_truncated"),
    (claiming(DEEP), "depth_truncated"),
    (encoded(".png", DEPTH[:40]), "depth_size_wrong"),
    (png(64, 48, 16, 0), "depth_undecodable"),
]


@pytest.mark.parametrize(("data", "code"), BAD_COLOR)
def test_a_bad_picture_is_skipped_with_its_reason(
    data: bytes, code: str, detector: OnnxDetector
) -> None:
    result = detector.look(data, DEEP, (64, 48))
    assert (result.skipped, result.detections) == (code, ())
    assert code in SKIPS


@pytest.mark.parametrize(("data", "code"), BAD_DEPTH)
def test_bad_depth_is_skipped_with_its_reason(
    data: bytes, code: str, detector: OnnxDetector
) -> None:
    result = detector.look(JPEG, data, (64, 48))
    assert (result.skipped, result.detections) == (code, ())
    assert code in SKIPS


def test_without_anything_measured_things_are_found_without_depth(detector: OnnxDetector) -> None:
    result = detector.look(JPEG, encoded(".png", np.zeros_like(DEPTH)), (64, 48))
    assert (result.skipped, result.depth_lost) == (None, "depth_empty")
    assert [(it.label, it.depth_m) for it in result.detections] == [("cup", None)]
    assert result.depth_lost in SKIPS


def test_a_model_that_fails_on_a_picture_skips_it(detector: OnnxDetector) -> None:
    def fail(_: object) -> list[Array]:
        raise RuntimeError("out of memory")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(detector.model.session, "run", fail)
        assert detector.look(JPEG).skipped == "detector_failed"
        patch.setattr(detector.model.session, "run", lambda _: [np.zeros((1, 3, 3), np.float32)])
        assert detector.look(JPEG).skipped == "detector_failed"


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_model_without_a_finite_number_failed_and_did_not_see_an_empty_room(
    bad: float, detector: OnnxDetector
) -> None:
    out = np.full((1, 6, tiny.CELLS), bad, np.float32)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(detector.model.session, "run", lambda _: [out])
        assert detector.look(JPEG).skipped == "detector_failed"
        out[0, :, ::2] = 0.0
        assert detector.look(JPEG).skipped is None


@pytest.mark.parametrize(
    "error", [cv2.error("no memory"), MemoryError(), IndexError(), KeyError(), OverflowError()]
)
@pytest.mark.parametrize("place", ["unpack_color", "dark", "in_picture", "look_inside"])
def test_whatever_fails_on_a_picture_costs_that_picture_alone(
    place: str, error: Exception, detector: OnnxDetector
) -> None:
    def fail(*_: object) -> None:
        raise error

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(f"planner.perception.detect.detector.{place}", fail)
        assert detector.look(JPEG, DEEP).skipped == "detector_failed"
    assert detector.look(JPEG, DEEP).skipped is None


@pytest.mark.parametrize("bits", [1, 2, 4, 8])
def test_a_picture_of_a_palette_is_seen_however_few_bits_choose(
    bits: int, detector: OnnxDetector
) -> None:
    size, body = struct.pack(">IIBBBBB", 64, 48, bits, 3, 0, 0, 0), bytes(1 + 64 * bits // 8) * 48
    parts = ((b"IHDR", size), (b"PLTE", b"\x20\x80\xf0" * 2**bits), (b"IDAT", zlib.compress(body)))
    chunks = (
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in (*parts, (b"IEND", b""))
    )
    result = detector.look(b"\x89PNG\r\n\x1a\n" + b"".join(chunks), None, (64, 48))
    assert [(it.label, it.color) for it in result.detections] == [("cup", "blue")]


@given(at=st.integers(0, len(JPEG) - 1), byte=st.integers(0, 255), length=st.integers(0, len(JPEG)))
@settings(max_examples=50)
def test_whatever_bytes_come_it_is_a_picture_or_a_code(at: int, byte: int, length: int) -> None:
    spoilt = JPEG[:at] + bytes((byte,)) + JPEG[at + 1 :]
    for data in (spoilt, spoilt[:length], JPEG[at:]):
        found = unpack_color(data, (64, 48))
        assert found in SKIPS if isinstance(found, str) else found.shape == (48, 64, 3)


def test_a_header_is_read_behind_other_segments() -> None:
    comment = b"\xff\xfe" + struct.pack(">H", 402) + b"\xff\xd9" * 200  # an end that is none
    header = read_header(JPEG[:2] + b"\xff\xff" + comment[1:] + JPEG[2:])
    assert header is not None
    assert (header.width, header.height, header.whole) == (64, 48, True)
    cut = JPEG[:2] + comment + JPEG[2:-40]
    assert unpack_color(cut) == "picture_truncated"


@pytest.mark.parametrize(
    ("size", "long_side", "expected"),
    [((640, 480), 320, (320, 240)), ((64, 48), 1024, (64, 48)), ((900, 10), 90, (90, 1))],
)
def test_a_picture_is_shrunk_to_its_longer_side(
    size: tuple[int, int], long_side: int, expected: tuple[int, int]
) -> None:
    data = shrink(np.zeros((size[1], size[0], 3), np.uint8), long_side)
    header = read_header(data)
    assert header is not None
    assert (header.kind, header.width, header.height) == ("jpeg", *expected)


def test_pictures_of_others_unpack_to_what_opencv_makes_of_them(shared_data: Path) -> None:
    for path in sorted((shared_data / "images").glob("*.jpg")):
        found = unpack_color(path.read_bytes())
        assert not isinstance(found, str), path
        expected = cv2.imread(str(path))
        assert expected is not None
        assert np.array_equal(found, expected)


COLORS = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (0, 255, 255), (255, 0, 255), (128, 128, 128)]


def plain(color: tuple[int, int, int], width: int, height: int) -> Picture:
    return np.full((height, width, 3), color, np.uint8)


def laid_out(*pictures: tuple[Picture, str]) -> Picture:
    sheet = unpack_color(lay_out(pictures, LONG_SIDE_PX))
    assert not isinstance(sheet, str)
    return sheet


@pytest.mark.parametrize(
    ("count", "size"), [(6, (640, 480)), (3, (640, 480)), (6, (320, 240)), (4, (480, 640))]
)
def test_every_picture_is_there_in_its_order_and_below_its_label(
    count: int, size: tuple[int, int]
) -> None:
    grid = grid_of(count, size, LONG_SIDE_PX)
    sheet = laid_out(*((plain(c, *size), f"{n} left") for n, c in enumerate(COLORS[:count], 1)))
    assert max(sheet.shape) <= LONG_SIDE_PX
    assert grid.width >= min(size[0], 320), "a model sees what a person would"
    for number, color in enumerate(COLORS[:count]):
        row, column = divmod(number, grid.columns)
        top, left = row * (grid.height + LABEL_PX + GAP_PX), column * (grid.width + GAP_PX)
        tile = sheet[top + LABEL_PX : top + LABEL_PX + grid.height, left : left + grid.width]
        middle = tile[16:-16, 16:-16].reshape(-1, 3)
        assert np.abs(middle.astype(int) - color).max() < 12, number
        strip = sheet[top : top + LABEL_PX, left : left + grid.width]
        assert strip.min() < 90, "something is written there"
        assert strip.max() > 240


@at_least(200)
@given(
    st.integers(1, MAX_VIEWS), st.tuples(st.integers(1, 4000), st.integers(1, 4000)),
    st.integers(64, 1024),
)  # fmt: skip
def test_a_sheet_is_never_longer_than_it_may_be_and_a_tile_never_larger_than_its_picture(
    count: int, size: tuple[int, int], long_side: int
) -> None:
    grid = grid_of(count, size, long_side)
    assert grid.columns * grid.rows >= count > grid.columns * (grid.rows - 1)
    assert grid.width <= size[0]
    assert grid.height <= size[1]
    wide = grid.columns * (grid.width + GAP_PX) - GAP_PX
    high = grid.rows * (grid.height + GAP_PX + LABEL_PX) - GAP_PX
    assert wide <= max(long_side, grid.columns * (1 + GAP_PX))
    assert high <= max(long_side, grid.rows * (1 + GAP_PX + LABEL_PX))


def test_pictures_of_two_sizes_and_a_long_label_find_room() -> None:
    sheet = laid_out(
        (plain(COLORS[0], 1920, 1080), "1 ahead on the left"),
        (plain(COLORS[1], 100, 300), "x" * 99),
    )
    assert max(sheet.shape) <= LONG_SIDE_PX
    found = {tuple(int(v > 128) for v in px) for px in sheet[::7, ::7].reshape(-1, 3)}
    assert {(1, 0, 0), (0, 1, 0)} <= found
