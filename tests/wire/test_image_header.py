"""A picture's own statement of its size is read from its first bytes, and nothing else is."""

from __future__ import annotations

from struct import pack

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.wire.test_png import END, chunk
from wire.image_header import PictureHeader, read_header
from wire.png import SIGNATURE

TABLE = b"\xff\xdb\x00\x03\x01"
FRAME = b"\xff\xc0\x00\x11\x08" + pack(">HH", 48, 64) + b"\x03" + bytes(9)
SCAN = b"\xff\xda\x00\x02"
END_OF_IMAGE = b"\xff\xd9"
START = b"\xff\xd8"
WHOLE = START + TABLE + FRAME + SCAN + b"xyz" + END_OF_IMAGE
FOUND = PictureHeader("jpeg", 64, 48, 3, 8, whole=True)


def png(bits: int, kind: int) -> bytes:
    return SIGNATURE + chunk(b"IHDR", pack(">IIBBBBB", 64, 48, bits, kind, 0, 0, 0))


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (WHOLE, FOUND),
        (START + b"\xff" + TABLE + b"\xff\xd0" + FRAME + SCAN + END_OF_IMAGE, FOUND),
        (START + b"\xff\x01" + FRAME + SCAN, PictureHeader("jpeg", 64, 48, 3, 8, whole=False)),
        (START + FRAME, PictureHeader("jpeg", 64, 48, 3, 8, whole=False)),
        (START + FRAME[:9], None),
        (START + TABLE + SCAN + END_OF_IMAGE, None),
        (START + b"\xff\xdb\x00\x01\x01" + FRAME, None),
        (START + TABLE + b"\x00\x00\x00\x00", None),
        (START + TABLE + END_OF_IMAGE + b"\x00\x00", None),
        (START + b"\xff", None),
        (b"GIF89a", None),
        (b"", None),
    ],
)
def test_a_jpeg_says_its_size_before_its_first_scan(
    data: bytes, expected: PictureHeader | None
) -> None:
    assert read_header(data) == expected


@pytest.mark.parametrize(
    ("bits", "kind", "channels", "depth"),
    [(8, 2, 3, 8), (16, 0, 1, 16), (1, 3, 3, 8), (8, 4, 2, 8), (8, 6, 4, 8)],
)
def test_a_png_says_its_size_channels_and_bits(
    bits: int, kind: int, channels: int, depth: int
) -> None:
    found = read_header(png(bits, kind) + END)
    assert found == PictureHeader("png", 64, 48, channels, depth, whole=True)
    cut = read_header(png(bits, kind))
    assert cut is not None
    assert not cut.whole


@pytest.mark.parametrize("data", [png(8, 5), png(8, 2)[:32], SIGNATURE + chunk(b"IDAT", bytes(21))])
def test_what_only_begins_as_a_png_is_none(data: bytes) -> None:
    assert read_header(data) is None


@given(st.sampled_from([b"", SIGNATURE, START, WHOLE, png(8, 2)]), st.binary(max_size=80))
def test_whatever_follows_is_read_or_is_none(begin: bytes, data: bytes) -> None:
    found = read_header(begin + data)
    assert found is None or found.width >= 0
