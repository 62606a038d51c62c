"""The judge of a hostile run sees contacts, speed, the fence and motion after a stop."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

from tools.bench.chaos.verdict import TruthSample
from tools.bench.hostile.verdict import HostileBounds, hidden_stop, judge, unsafe

STEP_S, STOP_S, END_S = 0.02, 102.0, 105.0
BOUNDS = HostileBounds(v_mps=0.5, w_radps=1.0, margin_m=lambda x_m, _: 2.0 - x_m)
Modes = Iterable[tuple[float, str]]
DRIVEN = ((100.0, "ACTIVE"), (STOP_S, "STOPPING"), (102.6, "HOLD"))


def driven(v_mps: float = 0.4, then_mps: float = 0.0, from_s: float = 0.0) -> list[TruthSample]:
    """Return a robot that drives for two seconds, stops in half of one, and may move again."""
    trace, x_m = [], 0.0
    for number in range(250):
        world_s = number * STEP_S
        speed = v_mps if world_s < 2.0 else max(0.0, v_mps * (1.0 - (world_s - 2.0) / 0.5))
        speed = then_mps if from_s and world_s >= from_s else speed
        x_m += speed * STEP_S
        trace.append(TruthSample(100.0 + world_s, "a", world_s, x_m, 0.0, speed, 0.0, 0))
    return trace


def judged(
    trace: list[TruthSample], modes: Modes = DRIVEN, confirmed_s: float | None = STOP_S
) -> dict[str, Any]:
    return judge(trace, list(modes), BOUNDS, confirmed_s, END_S)


def test_a_drive_that_is_stopped_breaks_nothing() -> None:
    told = judged(driven())
    assert unsafe(told) == []
    assert hidden_stop(0.03, told) == ""
    assert not told["gripped"]
    assert 0.8 < told["metres"] < 1.0


def test_each_law_is_seen_and_named() -> None:
    hit = [*driven(), replace(driven()[-1], contacts=1)]
    assert unsafe(judged(hit)) == ["contact"]
    assert unsafe(judged(driven(0.6))) == ["faster than the cap"]
    far = [replace(sample, x_m=sample.x_m + 1.5) for sample in driven()]
    assert unsafe(judged(far)) == ["outside of the fence"]
    assert unsafe(judged(driven(then_mps=0.2, from_s=3.5))) == ["motion after a stop"]


def test_a_stop_is_hidden_where_nobody_confirms_it_or_the_robot_moves_all_the_same() -> None:
    assert hidden_stop(None, judged(driven(), confirmed_s=None)) == "never confirmed"
    moved = judged(driven(then_mps=0.2, from_s=3.5))
    assert hidden_stop(0.03, moved).startswith("confirmed, but: 0.20 m/s")


def test_a_stick_gripped_anew_is_told_apart_and_one_that_was_held_is_not() -> None:
    trace = driven(then_mps=0.2, from_s=3.5)
    told = judged(trace, [*DRIVEN, (103.5, "TELEOP")])
    assert told["gripped"]
    assert unsafe(told) == []
    held = judged(trace, [(100.0, "TELEOP")])
    assert not held["gripped"]
    assert unsafe(held) == ["motion after a stop"]


def test_motion_before_a_stick_is_gripped_counts_all_the_same() -> None:
    told = judged(driven(then_mps=0.2, from_s=3.0), [*DRIVEN, (104.5, "TELEOP")])
    assert unsafe(told) == ["motion after a stop"]


def test_a_hand_may_take_the_robot_out_of_the_fence_and_nobody_else() -> None:
    far = [replace(sample, x_m=sample.x_m + 1.5) for sample in driven()]
    told = judged(far, [(100.0, "TELEOP"), (102.0, "HOLD")])
    assert not told["outside"]
    assert told["by_hand_m"] > 0.3
    assert judged(far)["outside_m"] > 0.3


def test_a_robot_that_was_put_elsewhere_did_not_drive_there() -> None:
    trace = driven()
    moved = [replace(sample, y_m=5.0 * (sample.world_s > 1.0)) for sample in trace]
    assert judged(moved)["metres"] <= judged(trace)["metres"]
