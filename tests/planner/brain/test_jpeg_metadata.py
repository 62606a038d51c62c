"""Check that a JPEG's size is read from its head, whatever the bytes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.brain.jpeg_metadata import START, jpeg_size, without_notes
from tests.planner.brain.pictures import jpeg

HEAD = b"\xff\xd8"


@pytest.mark.parametrize(
    ("data", "size"),
    [
        (jpeg(320, 240), (320, 240)),
        (jpeg(1, 65535), (1, 65535)),
        (HEAD + b"\xff\xff\xff\xc2\x00\x08\x08\x00\x02\x00\x03\x01", (3, 2)),  # filled, progressive
        (HEAD + b"\xff\xd0\xff\xc0\x00\x08\x08\x00\x02\x00\x03\x01", (3, 2)),
        (HEAD + b"\xff\xc4\x00\x08\x08\x00\x02\x00\x03\x00", None),  # a table is no frame
        (HEAD + b"\xff\xda\x00\x08\xff\xc0\x00\x08\x08\x00\x02\x00\x03", None),  # too late
        (HEAD + b"\xff\xc0\x00\x08\x08\x00", None),
        (HEAD + b"\xff\xe0\x00\x00" * 5000, None),
        (b"\x89PNG\r\n\x1a\n", None),
        (b"", None),
    ],
)
def test_the_size_is_what_the_frame_says(data: bytes, size: tuple[int, int] | None) -> None:
    assert jpeg_size(data) == size


def noted(marker: int, text: bytes) -> bytes:
    """Return a segment."""
    return bytes((0xFF, marker)) + (len(text) + 2).to_bytes(2, "big") + text


def test_what_a_camera_writes_about_itself_is_taken_out() -> None:
    bare = jpeg(320, 240, padding=9)
    app0 = bare[: 2 + 18]
    kept = noted(0xE2, b"ICC") + noted(0xEE, b"Adobe")
    said = (
        noted(0xE1, b"Exif 48.1N 11.5E") + noted(0xFE, b"GO TO \xff\xe1\x00\x05") + noted(0xED, b"")
    )
    assert without_notes(app0 + said + kept + bare[20:]) == app0 + kept + bare[20:]
    assert without_notes(bare) == bare


@given(st.binary(max_size=60))
def test_taking_notes_out_keeps_the_size(data: bytes) -> None:
    for whole in (START + data, jpeg() + data, noted(0xFE, data).join((jpeg()[:2], jpeg()[2:]))):
        assert jpeg_size(without_notes(whole)) == jpeg_size(whole)
        assert len(without_notes(whole)) <= len(whole)


@given(st.binary(max_size=60))
def test_no_bytes_are_too_bad_to_read(data: bytes) -> None:
    size = jpeg_size(START + data)
    assert size is None or min(size) >= 0
