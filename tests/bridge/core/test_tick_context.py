"""Hold ages to our own clock, windows to their rates, and a tick to what it tells of itself."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.reporting.report import status_of
from bridge.core.tick_context import TickContext, append_sent, fill, sensor_age_s, sent_at
from tests.bridge.core.reached import at
from tests.bridge.core.table import table


@table(
    ("level_s", "dt_s", "top_s", "dirty", "after_s"),
    [
        (0.0, 0.01, 1.0, True, 0.01),
        (0.5, 0.04, 1.0, False, 0.49),
        (0.005, 0.04, 1.0, False, 0.0),
        (0.0, 9.0, 1.0, True, 0.05),
        (0.5, 9.0, 1.0, False, 0.4875),
        (0.5, -1.0, 1.0, True, 0.5),
        (0.99, 0.04, 1.0, True, 1.0),
    ],
)
def test_a_window_fills_four_times_as_fast_as_it_drains(
    level_s: float, dt_s: float, top_s: float, dirty: bool, after_s: float
) -> None:
    assert fill(level_s, dt_s, top_s, dirty=dirty) == pytest.approx(after_s)


@given(st.integers(1, 600), st.integers(-10, 700))
def test_the_ring_knows_the_last_256_statuses_and_no_other(newest: int, seen: int) -> None:
    ring: tuple[float, ...] = ()
    for seq in range(1, newest + 1):
        ring = append_sent(ring, float(seq))
    sent_s = sent_at(ring, newest, seen)
    if max(1, newest - 255) <= seen <= newest:
        assert sent_s == float(seen)
    else:
        assert sent_s is None


@given(st.floats(0, 1e6), st.floats(0, 10), st.floats(-1e9, 1e9), st.booleans())
def test_no_stamp_makes_a_reading_younger(
    received_s: float, since_s: float, stamp_s: float, same_host: bool
) -> None:
    now_s = received_s + since_s
    assert sensor_age_s(now_s, received_s, stamp_s, same_host=same_host) >= now_s - received_s


@table(
    ("stamp_s", "same_host", "age_s"),
    [(8.0, True, 2.0), (9.0, True, 1.0), (9.5, True, 1.0), (8.0, False, 1.0), (9.5, False, 1.0)],
)
def test_a_reading_is_as_old_as_the_older_of_its_two_times(
    stamp_s: float, same_host: bool, age_s: float
) -> None:
    assert sensor_age_s(10.0, 9.0, stamp_s, same_host=same_host) == age_s


@table(
    ("still_s", "heard_s", "seconds", "still"),
    [
        (1.0, 0.0, 1.0, True),
        (1.0, 0.25, 0.5, True),
        (1.0, 0.25 + 1e-9, 0.5, False),
        (1.0, None, 0.5, False),
        (None, 0.0, 0.0, False),
        (1.0, 0.0, 1.0 + 1e-6, False),
        (0.0, 0.0, 1e-9, True),
        (0.0, 0.0, 0.0, True),
    ],
)
def test_a_robot_stands_while_its_drive_says_so(
    still_s: float | None, heard_s: float | None, seconds: float, still: bool
) -> None:
    tick = at()
    tick.now_s = 4.0
    tick.s.drive.still_since_s = None if still_s is None else tick.now_s - still_s
    tick.s.drive.received_s = None if heard_s is None else tick.now_s - heard_s
    assert tick.still_for(seconds) is still


def test_what_is_dropped_is_counted_once_and_its_reason_kept() -> None:
    tick: TickContext = at()
    before = tick.s.voice
    tick.drop("repeated")
    assert (tick.dropped, tick.reasons, tick.s.voice) == (1, ["repeated"], before)
    status_of(tick, tick.s)
    assert tick.s.voice.dropped == before.dropped + 1
