"""Figures are arithmetic with known answers."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tools.bench.figures import Figures, none_in, percentile, poisson_upper_95

SAMPLES = st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=200)


def test_nearest_rank_of_a_hundred() -> None:
    samples = [float(n) for n in range(100, 0, -1)]
    assert percentile(samples, 0.50) == 50.0
    assert percentile(samples, 0.99) == 99.0
    assert percentile(samples, 1.00) == 100.0
    assert percentile([7.0], 0.01) == 7.0


@given(SAMPLES)
def test_figures_are_samples_in_order(samples: list[float]) -> None:
    figures = Figures.of(samples)
    ranked = (figures.low, figures.p25, figures.p50, figures.p75, figures.p99, figures.high)
    assert list(ranked) == sorted(ranked)
    assert set(ranked) <= set(samples)
    assert figures.n == len(samples)


def test_nothing_has_no_figures() -> None:
    with pytest.raises(ValueError, match="no samples"):
        Figures.of([])


def test_zero_of_n_is_said_with_its_bound() -> None:
    assert none_in(100) == "0 of 100 (< 3.00% with 95 % confidence)"
    assert none_in(0) == "no trials"


@pytest.mark.parametrize(("count", "upper"), [(0, 3.689), (1, 5.572), (10, 18.39), (100, 121.63)])
def test_the_upper_end_of_a_poisson_interval_is_the_tables(count: int, upper: float) -> None:
    assert poisson_upper_95(count) == pytest.approx(upper, abs=0.01)
