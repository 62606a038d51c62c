"""A picture of a network is unpacked, or refused by a code before it costs memory."""

from __future__ import annotations

import struct
from typing import Any
from zlib import crc32

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from sensors.camera.health import CODES
from sensors.camera.packed_picture import MAX_PIXELS, MAX_SIDE_PX, TOO_LARGE, UNREADABLE, unpack
from sensors.camera.shot import CameraTrouble

WIDTH, HEIGHT = 64, 48
PICTURE = np.zeros((HEIGHT, WIDTH, 3), np.uint8)
PICTURE[:32], PICTURE[32:] = (200, 60, 20), (10, 120, 220)


def packed(kind: str, picture: Any = PICTURE) -> bytes:
    done, data = cv2.imencode(kind, picture)
    assert done
    return bytes(data)


JPEG, PNG = packed(".jpg"), packed(".png")


def png_of(width: int, height: int) -> bytes:
    """Return a PNG that says so of itself and holds nothing."""
    head = b"IHDR" + struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n\0\0\0\r" + head + crc32(head).to_bytes(4, "big") + PNG[-12:]


@pytest.mark.parametrize("form", ["rgb8; jpeg compressed bgr8", "jpeg", "png", ""])
@pytest.mark.parametrize("data", [JPEG, PNG])
def test_bytes_say_what_they_are_whatever_their_sender_calls_them(data: bytes, form: str) -> None:
    found = unpack(data, form, "/c")
    assert found.dtype == np.uint8
    assert np.abs(found.astype(int) - PICTURE).mean() < 3, "but for the edge, which JPEG smears"


def test_colours_that_were_packed_the_other_way_round_are_turned() -> None:
    found = unpack(PNG, "rgb8; png compressed rgb8", "/c")
    assert np.array_equal(found, PICTURE[:, :, ::-1])


@pytest.mark.parametrize("kind", [".jpg", ".png"])
def test_a_grey_picture_has_three_equal_channels(kind: str) -> None:
    found = unpack(packed(kind, PICTURE[:, :, 0]), "mono8; jpeg compressed ", "/c")
    assert found.shape == (HEIGHT, WIDTH, 3)
    assert np.array_equal(found[:, :, 0], found[:, :, 2])


@pytest.mark.parametrize(
    ("data", "code", "says"),
    [
        (b"", UNREADABLE, "neither JPEG nor PNG"),
        (b"RIFFxxxxWEBP", UNREADABLE, "begins with 52494646, its format is 'webp'"),
        (JPEG[:-200], UNREADABLE, "end is missing"),
        (PNG[:-12], UNREADABLE, "end is missing"),
        (packed(".png", PICTURE.astype(np.uint16)), UNREADABLE, "16 bits a channel"),
        (png_of(64, 48), UNREADABLE, "can't be unpacked"),
        (png_of(MAX_SIDE_PX + 1, 1), TOO_LARGE, f"{MAX_SIDE_PX + 1} x 1"),
        (png_of(MAX_SIDE_PX, MAX_SIDE_PX), TOO_LARGE, f"at most {MAX_PIXELS} pixels"),
        (png_of(0, 48), TOO_LARGE, "0 x 48"),
    ],
)
def test_what_is_no_picture_says_what_it_is(data: bytes, code: str, says: str) -> None:
    with pytest.raises(CameraTrouble, match=code) as told:
        unpack(data, "webp", "/c")
    assert says in told.value.detail
    assert code in CODES


def picture_or_code(data: bytes, form: str) -> Any:
    try:
        return unpack(data, form, "/c")
    except CameraTrouble as why:
        return why.code


@given(
    st.sampled_from([JPEG, PNG]), st.integers(0, len(JPEG) - 1), st.integers(0, 255),
    st.integers(1, len(JPEG)), st.text(max_size=8),
)  # fmt: skip
def test_whatever_bytes_come_it_is_a_picture_or_a_code(
    data: bytes, at: int, byte: int, length: int, form: str
) -> None:
    at %= len(data)
    spoilt = data[:at] + bytes((byte,)) + data[at + 1 :]
    for one in (spoilt, spoilt[:length], data[at:]):
        found = picture_or_code(one, form)
        assert found in CODES if isinstance(found, str) else found.shape[2] == 3
