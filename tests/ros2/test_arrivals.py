"""Arrivals are counted over two seconds, and refusals remembered as long."""

from __future__ import annotations

from ros2.arrivals import TopicArrivals


def test_the_rate_is_that_of_the_last_two_seconds() -> None:
    topic = TopicArrivals()
    for at in range(100):
        topic.note(at * 0.02)
    assert topic.rate_hz(2.0) == 50.0
    assert topic.rate_hz(3.0) == 25.0
    assert topic.rate_hz(9.0) == 0.0


def test_silence_counts_from_the_newest_or_from_when_it_was_asked_for() -> None:
    topic = TopicArrivals()
    assert topic.silent_s(5.0, 6.0) == 1.0
    topic.note(5.5)
    assert topic.silent_s(5.0, 6.0) == 0.5
    assert topic.silent_s(5.75, 6.0) == 0.25


def test_a_refusal_is_remembered_for_two_seconds() -> None:
    topic = TopicArrivals()
    assert not topic.is_refused(0.0)
    topic.refuse("null", 1.0)
    assert topic.is_refused(2.9)
    assert not topic.is_refused(3.1)
