"""The loop's figures are those of the last whole second."""

from __future__ import annotations

import pytest

from bridge.realtime.stats import LoopStats, Summary


def test_a_second_is_summed_up_when_it_is_over() -> None:
    stats = LoopStats()
    for tick in range(99):
        stats.add(late_s=tick * 1e-6, step_ns=1_000)
    assert stats.summary == Summary()
    stats.add(late_s=0.002, step_ns=250_000)
    assert stats.summary.late_p50_us == pytest.approx(50.0)
    assert stats.summary.late_max_us == pytest.approx(2_000.0)
    assert stats.summary.step_max_us == pytest.approx(250.0)


def test_the_next_second_begins_anew() -> None:
    stats = LoopStats()
    for _ in range(100):
        stats.add(late_s=0.5, step_ns=10**9)
    for _ in range(100):
        stats.add(late_s=1e-5, step_ns=1_000)
    assert stats.summary.late_max_us == pytest.approx(10.0)
    assert stats.summary.step_max_us == pytest.approx(1.0)
