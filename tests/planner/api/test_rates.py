"""A rate gives a burst, then so many a second; who hurries takes nothing from another."""

from __future__ import annotations

from planner.api.rates import MOST_ASKERS, Rate, Rates


def test_a_burst_then_so_many_a_second() -> None:
    rate = Rate(2.0, 5, 0.0)
    assert [rate.take(0.0) for _ in range(7)] == [True] * 5 + [False] * 2
    assert rate.wait_s() == 0.5
    assert sum(rate.take(tick / 50) for tick in range(1, 501)) == 20


def test_a_long_silence_gives_no_more_than_the_burst() -> None:
    rate = Rate(2.0, 5, 0.0)
    assert sum(rate.take(1e6) for _ in range(10)) == 5


def test_each_asker_has_a_rate_and_few_are_remembered() -> None:
    now_s = 0.0
    rates = Rates(1.0, 1, lambda: now_s)
    assert rates.wait_s("a") is None
    assert rates.wait_s("a") == 1.0
    assert rates.wait_s("b") is None
    for number in range(3 * MOST_ASKERS):
        rates.wait_s(str(number))
    assert len(rates) == MOST_ASKERS
