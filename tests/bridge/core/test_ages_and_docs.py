"""Hold ages to our own clock, and the safety page to the tables."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.faults.fault_messages import WORDS
from bridge.core.faults.fault_table import ROWS, FaultRow
from bridge.core.geometry.message_age import append_sent, sensor_age_s, sent_at
from bridge.core.modes.mode_table import TRANSITIONS
from bridge.core.safety_page import PATH, safety_md


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


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.id)
def test_every_row_has_words_and_is_documented(row: FaultRow) -> None:
    page = PATH.read_text("utf-8")
    assert f"`{row.id}`" in page
    en, zh = WORDS[row.id]
    assert en in page
    assert zh in page
    for stage in row.stages:
        assert stage.window in page


def test_every_transition_is_documented() -> None:
    page = PATH.read_text("utf-8")
    assert page == safety_md(), "run python -m bridge.core.safety_page"
    for (mode, _), to in TRANSITIONS.items():
        assert f"| {mode.value} |" in page
        assert f"| {to.value} |" in page


def test_words_belong_to_rows() -> None:
    assert set(WORDS) == {row.id for row in ROWS}
