"""A sensor's time on our clock never lies after the bytes, whatever delays them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from devices.clock import WINDOW_S, SensorClock, WrappedCounter


@given(
    delays=st.lists(st.floats(0.0, 0.3), min_size=1, max_size=80),
    drift=st.floats(-0.01, 0.01),
)
def test_an_instant_lies_between_the_truth_less_the_drift_and_the_arrival(
    delays: list[float], drift: float
) -> None:
    clock, arrival_s = SensorClock(), 0.0
    for k, delay in enumerate(delays):
        true_s = 50.0 + 0.05 * k
        arrival_s = max(arrival_s, true_s + delay)
        said_s = clock.note(7.0 + 0.05 * k * (1.0 + drift), arrival_s)
        assert said_s <= arrival_s
        assert said_s >= true_s - 0.01 * (WINDOW_S + 0.4) - 1e-9


def test_a_burst_after_a_pause_is_dated_by_the_sensor() -> None:
    clock = SensorClock()
    for k in range(20):
        clock.note(0.1 * k, 100.0 + 0.1 * k)
    late = [clock.note(0.1 * k, 102.6) for k in range(20, 26)]
    assert late == pytest.approx([102.0, 102.1, 102.2, 102.3, 102.4, 102.5])


def test_a_counter_that_begins_again_goes_on() -> None:
    counter = WrappedCounter(30_000)
    assert [counter.unwrap(value) for value in (29_990, 29_999, 3, 9)] == [
        29_990,
        29_999,
        30_003,
        30_009,
    ]


def test_what_comes_with_a_delay_of_its_own_is_dated_by_what_comes_without() -> None:
    clock = SensorClock()
    assert clock.date(5.0, 100.0) is None
    clock.note(5.0, 100.01)
    clock.note(5.1, 100.2)
    assert clock.date(5.05, 100.3) == pytest.approx(100.06)
    assert clock.date(9.0, 100.3) == 100.3, "nothing is dated later than it came"
    assert clock.date(5.05, 100.3) == pytest.approx(100.06), "and it learns nothing by it"
