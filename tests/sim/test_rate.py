"""Late ticks run late, whole missed periods are skipped, and the real-time factor tells."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.contacts import Episodes
from sim.rate import RealTimeFactor, SimPacer

PERIOD_S = 0.01


def test_deadlines_are_absolute() -> None:
    pacer = SimPacer(PERIOD_S, 5.0)
    for tick in range(1, 6):
        assert pacer.next_s == pytest.approx(5.0 + tick * PERIOD_S)
        assert pacer.woke(pacer.next_s + 0.004) == 0  # lateness does not add up


def test_a_freeze_is_skipped_and_counted() -> None:
    pacer = SimPacer(PERIOD_S, 0.0)
    assert pacer.woke(7.0051) == 699
    assert pacer.next_s == pytest.approx(7.01)
    assert pacer.missed_total == 699
    assert pacer.woke(7.0101) == 0


@given(st.lists(st.floats(0.0, 0.3), max_size=50))
def test_it_never_hurries(pauses_s: list[float]) -> None:
    pacer, now_s = SimPacer(PERIOD_S, 0.0), 0.0
    for pause_s in pauses_s:
        now_s = max(now_s + pause_s, pacer.next_s)
        pacer.woke(now_s)
        assert now_s - 1e-9 <= pacer.next_s <= now_s + PERIOD_S + 1e-9


def test_the_factor_is_one_on_time_and_less_after_a_gap() -> None:
    factor = RealTimeFactor(PERIOD_S)
    assert [factor.note_tick(tick * PERIOD_S) for tick in range(150)] == pytest.approx([1.0] * 150)
    assert factor.note_tick(150 * PERIOD_S + 1.0) == pytest.approx(0.5, abs=0.01)
    after = [factor.note_tick(tick * PERIOD_S + 1.0) for tick in range(151, 251)]
    assert after[-1] == pytest.approx(1.0)


def test_a_rattling_contact_is_one_episode() -> None:
    episodes = Episodes(PERIOD_S)
    for contacts in [0, 1, 0, 0, 2, 0, 1] + [0] * 19 + [1]:
        episodes.sample(contacts)
    assert (episodes.now, episodes.total) == (1, 1)
    for contacts in [0] * 20 + [1]:
        episodes.sample(contacts)
    assert episodes.total == 2
