"""Garbage is collected in slack time only, and only when there is some."""

from __future__ import annotations

import gc
from collections.abc import Iterator

import pytest

from bridge.realtime import SlackCollector


@pytest.fixture
def collector() -> Iterator[SlackCollector]:
    """Give the test a frozen heap, and the rest of the run what it had: no look at what stays."""
    collector = SlackCollector()
    collector.freeze()
    yield collector
    collector.thaw()
    gc.freeze()


class Cycle:
    def __init__(self) -> None:
        self.me = self


def cycles() -> int:
    return sum(isinstance(item, Cycle) for item in gc.get_objects())


def test_nothing_is_collected_by_itself(collector: SlackCollector) -> None:
    for _ in range(2_000):
        Cycle()
    assert cycles() == 2_000
    assert collector.use(slack_s=0.008)
    assert cycles() == 0


@pytest.mark.parametrize("slack_s", [-0.01, 0.0, 0.005, float("nan")])
def test_without_slack_nothing_is_collected(collector: SlackCollector, slack_s: float) -> None:
    for _ in range(2_000):
        Cycle()
    assert not collector.use(slack_s)
    assert cycles() == 2_000


def test_without_garbage_nothing_is_done(collector: SlackCollector) -> None:
    gc.collect(0)
    assert not collector.use(slack_s=0.009)
