"""Ranges cross as doubles, bit for bit, with or without beams that came back with nothing."""

from __future__ import annotations

import struct
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core import Inbox, initial, step
from bridge.recording.encode import pack_ranges, unpack_ranges
from bridge.recording.protobuf import laser_scan, ranges_of
from bridge.recording.recording_reader import TickFrame, read_recording
from tests.bridge.ground import core_config
from tests.bridge.recorded import stream_of, written
from tests.wire.examples import EXAMPLES
from wire import Scan

RANGES = st.lists(st.none() | st.floats(0.0, 1000.0), max_size=400).map(tuple)


@given(RANGES)
def test_ranges_come_back_as_they_went(ranges_m: tuple[float | None, ...]) -> None:
    scan = laser_scan(12, "base", (0.1, 0.0, (0.0, 1.0)), (-3.0, 3.0), pack_ranges(ranges_m))
    got = unpack_ranges(ranges_of(scan))
    assert [repr(r) for r in got] == [repr(r) for r in ranges_m]


@pytest.mark.parametrize("ranges_m", [(), (None,), (0.5, None, 8.0)])
def test_a_tick_with_any_scan_and_any_words_is_read_as_it_was(
    tmp_path: Path, ranges_m: tuple[float | None, ...]
) -> None:
    scan = EXAMPLES[Scan]
    assert isinstance(scan, Scan)
    inbox = Inbox(scan=scan.model_copy(update={"ranges_m": ranges_m}))
    config = core_config()
    before = initial(config, 100.0)
    decision = replace(step(config, before, inbox, 100.01), reasons=('a "word"\n', "停", "b\\"))
    (path,) = written(tmp_path, stream_of(config, [(before, inbox, 100.01, decision)]))
    *_, tick = read_recording(path)
    assert isinstance(tick, TickFrame)
    assert (tick.inbox, tick.reasons) == (inbox, decision.reasons)
    assert (tick.command, tick.mode) == (decision.command, decision.state.mode)


@pytest.mark.parametrize(
    "broken", [b"", b"\x08", b"\x0a\x05abc", b"\x32\x10" + bytes(8), b"\xff" * 9]
)
def test_what_is_no_scan_is_refused(broken: bytes) -> None:
    with pytest.raises((ValueError, struct.error)):
        ranges_of(broken)
