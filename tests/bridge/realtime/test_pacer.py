"""The schedule skips whole missed periods and never bursts."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.realtime import Pacer
from tests.bridge.ground import FakeClock

PERIOD_S = 0.01


def test_on_time_ticks_are_one_period_apart() -> None:
    clock = FakeClock()
    pacer = Pacer(clock, PERIOD_S)
    times_s = [pacer.wait().now_s for _ in range(5)]
    assert times_s == pytest.approx([100.01, 100.02, 100.03, 100.04, 100.05])


def test_a_tick_less_than_a_period_late_runs_late_and_the_next_is_on_time() -> None:
    clock = FakeClock()
    pacer = Pacer(clock, PERIOD_S)
    clock.oversleep_s = 0.007
    late = pacer.wait()
    assert late.missed == 0
    assert late.late_s == pytest.approx(0.007)
    assert pacer.slack_s() == pytest.approx(0.003)
    following = pacer.wait()
    assert following.now_s == pytest.approx(100.02)
    assert following.missed == 0
    assert following.late_s == pytest.approx(0.0, abs=1e-9)


def test_whole_missed_periods_are_counted_and_skipped() -> None:
    clock = FakeClock()
    pacer = Pacer(clock, PERIOD_S)
    clock.oversleep_s = 0.034
    late = pacer.wait()
    assert late.missed == 3
    assert late.late_s == pytest.approx(0.004)
    assert pacer.wait().now_s == pytest.approx(100.05)


def test_work_longer_than_a_period_shows_as_lateness_of_the_next_tick() -> None:
    clock = FakeClock()
    pacer = Pacer(clock, PERIOD_S)
    pacer.wait()
    clock.time_s += 0.012
    assert pacer.slack_s() == pytest.approx(-0.002)
    late = pacer.wait()
    assert late.missed == 0
    assert late.late_s == pytest.approx(0.002)


@pytest.mark.parametrize("period_s", [0.0, -0.01, float("nan")])
def test_a_period_that_is_none_is_refused(period_s: float) -> None:
    with pytest.raises(ValueError, match="positive"):
        Pacer(FakeClock(), period_s)


@given(st.lists(st.floats(0.0, 0.5), max_size=30))
def test_time_is_accounted_for_whatever_the_delays(delays_s: list[float]) -> None:
    clock = FakeClock(0.0)
    pacer = Pacer(clock, PERIOD_S)
    periods = 0
    for delay_s in delays_s:
        clock.oversleep_s = delay_s
        tick = pacer.wait()
        periods += 1 + tick.missed
        assert 0.0 <= tick.late_s < PERIOD_S + 1e-9
        assert tick.now_s == pytest.approx(periods * PERIOD_S + tick.late_s)
