"""A machine that holds naps up does not keep time; calm is waited for, but not for ever."""

from __future__ import annotations

import time

import pytest

from scripts.scheduler_probe import HostTiming, Naps, Pulse, until_calm, worst_timing

CALM = HostTiming(400, 0, 0.004)
HELD_UP = HostTiming(90, 40, 0.3)


def naps(late_s: list[float]) -> Naps:
    """Return naps of which each began when the one before had ended, from 0 s on."""
    made, now_s = Naps(), 0.0
    for late in late_s:
        now_s += 0.01 + late
        made.ended_s.append(now_s)
        made.late_s.append(late)
    return made


@pytest.mark.parametrize(
    ("late_s", "keeps"),
    [
        ([0.001] * 100, True),
        ([0.001] * 99 + [0.09], True),
        ([0.001] * 97 + [0.03] * 3, False),
        ([0.001] * 99 + [0.11], False),
        ([0.005] * 50 + [2.0], False),
        ([], False),
    ],
    ids=["calm", "late once", "late often", "stalled", "stalled long", "nothing measured"],
)
def test_it_keeps_time_where_hardly_any_nap_is_late(late_s: list[float], keeps: bool) -> None:
    seen = worst_timing([naps([0.002] * 100), naps(late_s)] if late_s else [], 0.0, 9.0)
    assert seen.time is keeps
    assert f"{sum(late > 0.02 for late in late_s)} of " in str(seen)


def test_only_the_span_counts_and_a_nap_that_has_not_ended_does_too() -> None:
    made = naps([0.5] + [0.001] * 100)
    assert not worst_timing([made], 0.0, 9.0).time
    assert worst_timing([made], 0.6, 9.0).time
    made.due_s = 2.0
    assert worst_timing([made], 0.6, 2.01).time
    assert worst_timing([made], 0.6, 3.0) == HostTiming(naps=93, late=1, worst_s=1.0, lost_s=1.0)


def test_what_was_lost_is_of_the_processor_that_lost_most_and_small_lateness_is_none() -> None:
    often, once = naps([0.03] * 5 + [0.001] * 95), naps([0.09] + [0.019] * 99)
    assert worst_timing([often, once], 0.0, 9.0).lost_s == pytest.approx(0.15)
    assert worst_timing([once], 0.0, 9.0).lost_s == pytest.approx(0.09)
    assert worst_timing([], 0.0, 9.0).lost_s == 0.0


@pytest.mark.parametrize(
    ("calm_after", "looks", "ends"),
    [(0, 1, CALM), (2, 3, CALM), (99, 6, HELD_UP)],
    ids=["at once", "at the third look", "never"],
)
def test_calm_is_waited_for(calm_after: int, looks: int, ends: HostTiming) -> None:
    looked: list[float] = []

    def look() -> HostTiming:
        looked.append(2.0)
        return CALM if len(looked) > calm_after else HELD_UP

    assert until_calm(look, 12.0, lambda: sum(looked)) == ends
    assert len(looked) == looks


def test_it_naps_on_every_processor_and_ends() -> None:
    from_s = time.monotonic()
    with Pulse() as pulse:
        while pulse.timing_since(from_s).naps < 4:
            time.sleep(0.005)
    count = pulse.timing_since(from_s).naps
    assert count >= 4
