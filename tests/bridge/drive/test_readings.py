"""Counts wrap, speeds are bounded, and a charge lies between two voltages."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.drive.readings import WheelCount, charge_of, limit_radps
from wire.drive_config import DriveConfig


@given(st.lists(st.integers(-(2**20), 2**20), min_size=1, max_size=50), st.integers(0, 2**32))
def test_a_count_goes_on_past_its_wrap(steps: list[int], start: int) -> None:
    count, shown = WheelCount(), start
    for k, step in enumerate([0, *steps]):
        shown = (shown + step + 2**31) % 2**32 - 2**31
        count.add(count.step(shown), 0.02 * k)
    assert count.whole == sum(steps)


def test_a_speed_is_that_of_the_last_counts() -> None:
    count = WheelCount()
    for k in range(20):
        count.add(count.step(100 * k if k < 10 else 900), 0.02 * k)
        if k == 0:
            assert count.ticks_a_s() == 0.0
        if k == 9:
            assert count.ticks_a_s() == pytest.approx(5_000)
    assert count.ticks_a_s() == 0.0


@given(st.floats(allow_nan=False))
def test_no_speed_is_too_fast_for_the_wire(radps: float) -> None:
    assert abs(limit_radps(radps)) <= 1000.0


def test_without_two_voltages_there_is_no_charge() -> None:
    config = DriveConfig(kind="waveshare", port="/dev/x")
    assert charge_of(11.0, config) is None
    full = DriveConfig(kind="waveshare", port="/dev/x", battery_empty_v=9.0, battery_full_v=12.0)
    assert [charge_of(v, full) for v in (None, 8.0, 10.5, 13.0)] == [None, 0.0, 0.5, 1.0]
