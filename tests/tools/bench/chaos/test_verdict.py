"""The judge sees motion after a stop, contacts and words said twice, and no others."""

from __future__ import annotations

from dataclasses import replace

from tools.bench.chaos.verdict import (
    STOP_S,
    TruthSample,
    contacts,
    has_moved,
    judge_stop,
    said_twice,
)

STEP_S = 0.02


def at(world_s: float, v_mps: float = 0.0, x_m: float = 0.0, boot: str = "a") -> TruthSample:
    return TruthSample(100.0 + world_s, boot, world_s, x_m, 0.0, v_mps, 0.0, 0)


def ramp(stands_s: float, until_s: float = 4.0) -> list[TruthSample]:
    """Return a robot that brakes from 0.5 m/s to a stand."""
    trace, x_m = [], 0.0
    for number in range(round(until_s / STEP_S)):
        world_s = number * STEP_S
        v_mps = max(0.0, 0.5 * (1.0 - world_s / stands_s))
        x_m += v_mps * STEP_S
        trace.append(at(world_s, v_mps, x_m))
    return trace


def test_a_stop_that_holds_is_none_of_its_business() -> None:
    stopped = judge_stop(ramp(0.6), 100.0, 104.0)
    assert stopped.moving
    assert stopped.stood_s is not None
    assert 0.5 < stopped.stood_s <= 0.7
    assert not stopped.is_broken


def test_what_came_before_the_stop_and_after_the_persons_act_does_not_count() -> None:
    trace = [*ramp(0.6), at(4.5, 0.4)]
    assert not judge_stop(trace, 100.3, 104.2).is_broken
    assert judge_stop(trace, 100.3, 105.0).is_broken


def test_a_late_stop_is_broken() -> None:
    assert judge_stop(ramp(STOP_S + 0.5), 100.0, 104.0).late
    assert judge_stop(ramp(100.0), 100.0, 104.0).late


def test_a_span_too_short_to_stand_in_is_not_late() -> None:
    stopped = judge_stop(ramp(0.6), 100.0, 100.3)
    assert stopped.stood_s is None
    assert not stopped.is_broken


def test_a_twitch_after_standing_is_motion() -> None:
    trace = ramp(0.6)
    trace[150] = replace(trace[150], v_mps=0.07)
    assert "0.07 m/s" in judge_stop(trace, 100.0, 104.0).again


def test_creeping_below_every_speed_is_motion() -> None:
    trace = [replace(s, x_m=s.x_m + 0.015 * s.world_s) for s in ramp(0.6)]
    assert "crept" in judge_stop(trace, 100.0, 104.0).again


def test_a_simulator_that_began_anew_counts_from_its_own_first_instant() -> None:
    trace = [*ramp(0.6, 0.3), *(at(i * STEP_S, boot="b", x_m=5.0) for i in range(20))]
    trace = [replace(s, at_s=100.0 + i * STEP_S) for i, s in enumerate(trace)]
    assert not judge_stop(trace, 100.0, 104.0).is_broken
    trace[-1] = replace(trace[-1], v_mps=0.3)
    assert judge_stop(trace, 100.0, 104.0).again


def test_a_frozen_simulators_time_does_not_count() -> None:
    trace = [replace(s, at_s=s.at_s + (5.0 if s.world_s > 0.3 else 0.0)) for s in ramp(0.6)]
    assert not judge_stop(trace, 100.0, 110.0).is_broken


def test_contacts_count_from_the_first_sample_of_a_boot_and_from_zero_in_the_next() -> None:
    told = [("a", 3), ("a", 3), ("a", 5), ("b", 0), ("b", 1)]
    assert contacts([replace(at(0.0), boot=boot, contacts=n) for boot, n in told]) == 3
    assert contacts([]) == 0


def test_a_robot_that_turns_has_moved() -> None:
    assert has_moved([at(0.0), replace(at(0.1), w_radps=-0.5)])
    assert not has_moved([at(0.0), at(0.1, 0.01)])


def test_words_count_by_goal() -> None:
    heard = [("g1", "one"), ("g1", "two"), ("g1", "one"), ("g2", "two"), ("g1", "other")] * 1
    assert said_twice(heard, ["one", "two"]) == ["one"]
    assert said_twice([*heard, ("g1", "other")], ["one"]) == ["one"]
