"""Hold the collector to its promise: nothing large while driving, and the process gets it back."""

from __future__ import annotations

import gc
from collections.abc import Iterator

import pytest

from planner.bridge_client.bridge_status import at_rest
from planner.mission.clocks import DRIVING_PERIOD_S, STANDING_PERIOD_S, Collector
from tests.planner.mission.fakes import status
from wire import Mode, Twist2


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[int]]:
    """Return which generations were collected, without collecting."""
    asked: list[int] = []
    monkeypatch.setattr(gc, "collect", lambda generation=2: asked.append(generation))
    yield asked
    gc.enable()
    gc.freeze()  # as the whole run has it, so that no later collection looks at what stays


def test_before_freeze_and_after_thaw_nothing_is_touched(runs: list[int]) -> None:
    collector = Collector()
    collector.maybe(1e9, standing=True)
    collector.thaw()
    assert runs == []
    assert gc.isenabled()


def test_all_is_collected_standing_and_only_the_youngest_driving(runs: list[int]) -> None:
    collector = Collector()
    collector.freeze(0.0)
    assert not gc.isenabled()
    runs.clear()
    collector.maybe(STANDING_PERIOD_S - 0.1, standing=True)
    assert runs == []
    collector.maybe(STANDING_PERIOD_S, standing=True)
    collector.maybe(DRIVING_PERIOD_S, standing=False)
    assert runs == [2]
    collector.maybe(STANDING_PERIOD_S + DRIVING_PERIOD_S, standing=False)
    assert runs == [2, 0]
    collector.thaw()
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0


def test_rest_is_standing_with_nothing_that_drives() -> None:
    assert at_rest(status(mode=Mode.HOLD))
    assert not at_rest(status(mode=Mode.ACTIVE))
    assert not at_rest(status(mode=Mode.HOLD, measured=Twist2(0.2, 0.0)))
