"""Pauses double up to a bound, and begin anew after a steady life."""

from __future__ import annotations

from processes.backoff import Backoff


def test_pauses_double_up_to_a_bound() -> None:
    backoff = Backoff(0.5, 10.0, 30.0)
    pauses = [backoff.pause_after(0.1) for _ in range(8)]
    assert pauses == [0.5, 1.0, 2.0, 4.0, 8.0, 10.0, 10.0, 10.0]


def test_a_steady_life_begins_with_the_first_pause() -> None:
    backoff = Backoff(0.5, 10.0, 30.0)
    for _ in range(5):
        backoff.pause_after(29.9)
    assert backoff.next_s == 10.0
    assert [backoff.pause_after(30.0), backoff.pause_after(0.0)] == [0.5, 1.0]


def test_without_a_steady_life_only_a_reset_begins_anew() -> None:
    backoff = Backoff(0.05, 5.0)
    backoff.pause_after(1e9)
    assert backoff.next_s == 0.1
    backoff.reset()
    assert backoff.next_s == 0.05
