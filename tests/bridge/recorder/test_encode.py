"""Ranges cross as doubles, bit for bit, with or without beams that came back with nothing."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.blackbox.protobuf import laser_scan, ranges_of
from bridge.recorder.encode import packed, unpacked

RANGES = st.lists(st.none() | st.floats(0.0, 1000.0), max_size=400).map(tuple)


@given(RANGES)
def test_ranges_come_back_as_they_went(ranges_m: tuple[float | None, ...]) -> None:
    scan = laser_scan(12, "base", (0.1, 0.0, (0.0, 1.0)), (-3.0, 3.0), packed(ranges_m))
    got = unpacked(ranges_of(scan))
    assert [repr(r) for r in got] == [repr(r) for r in ranges_m]


@pytest.mark.parametrize(
    "broken", [b"", b"\x08", b"\x0a\x05abc", b"\x32\x10" + bytes(8), b"\xff" * 9]
)
def test_what_is_no_scan_is_refused(broken: bytes) -> None:
    with pytest.raises((ValueError, struct.error)):
        ranges_of(broken)
