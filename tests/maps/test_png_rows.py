"""A PNG's rows are counted as the format lays them out: every depth, colour and interlacing."""

from __future__ import annotations

import struct
import zlib

import cv2
import numpy as np
import pytest

from maps.png_rows import count_rows_bytes
from wire.png import SIGNATURE


def chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def picture(
    width: int, height: int, depth: int, color: int, rows: bytes, *, woven: int = 0
) -> bytes:
    head = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, woven)
    return (
        SIGNATURE + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    )


@pytest.mark.parametrize(
    ("pixels", "kind"), [((5, 7), np.uint8), ((5, 7, 3), np.uint8), ((5, 7, 4), np.uint16)]
)
def test_what_opencv_writes_holds_what_it_says(pixels: tuple[int, ...], kind: type) -> None:
    data = cv2.imencode(".png", np.zeros(pixels, kind))[1].tobytes()
    held, wanted = count_rows_bytes(data)
    assert held == wanted > 5 * 7


@pytest.mark.parametrize(
    ("depth", "color", "row_bytes"), [(1, 0, 2), (2, 3, 3), (4, 0, 5), (8, 4, 18), (16, 6, 72)]
)
def test_a_row_is_whole_bytes_and_its_filter(depth: int, color: int, row_bytes: int) -> None:
    rows = bytes(3 * (1 + row_bytes))
    assert count_rows_bytes(picture(9, 3, depth, color, rows)) == (len(rows), len(rows))


def test_a_woven_picture_holds_seven_smaller_ones() -> None:
    passes = ((1, 1), (1, 1), (2, 1), (1, 2), (3, 1), (2, 3), (5, 2))
    rows = bytes(sum((1 + width) * height for width, height in passes))
    assert count_rows_bytes(picture(5, 5, 8, 0, rows, woven=1)) == (len(rows), len(rows))


@pytest.mark.parametrize("off", [-1, 1, 5_000_000])
def test_too_few_and_too_many_are_told_apart_and_no_bomb_is_unpacked(off: int) -> None:
    rows = bytes(10 * 11 + off)
    held, wanted = count_rows_bytes(picture(10, 10, 8, 0, rows))
    assert (wanted, held) == (110, 109 if off < 0 else 111)


def test_what_cannot_be_unpacked_is_refused() -> None:
    whole = picture(4, 4, 8, 0, bytes(20))
    at = whole.index(b"IDAT") + 4
    with pytest.raises(ValueError, match="cannot be unpacked"):
        count_rows_bytes(whole[:at] + b"\xff\xff" + whole[at + 2 :])
    with pytest.raises(ValueError, match="colour type is 5"):
        count_rows_bytes(picture(4, 4, 8, 5, bytes(20)))
