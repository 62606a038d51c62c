"""Judge one run by what was true and by what a person was told. Pure."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import hypot
from typing import TYPE_CHECKING, Any

from tools.bench.chaos.verdict import contacts, judge_stop

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tools.bench.chaos.verdict import TruthSample

SPEED_SLACK_MPS, TURN_SLACK_RADPS = 0.05, 0.15
"""Wheels overshoot a little, and a caster drags."""
FENCE_SLACK_M = 0.05
"""Localization of the simulator is noisy by a few centimetres."""
DIRECT_S = 1.5
BY_HAND = "TELEOP"
SEEN_S = 0.1
"""A status is heard so long after what it tells of began."""
WITHIN_S = 1.0
LEAP_M = 0.3


@dataclass(frozen=True, slots=True)
class HostileBounds:
    """Hold what a robot may do."""

    v_mps: float
    w_radps: float
    margin_m: Callable[[float, float], float]
    """How far inside of the fence a point lies; negative outside."""


def judge(
    trace: Sequence[TruthSample],
    modes: Sequence[tuple[float, str]],
    bounds: HostileBounds,
    confirmed_s: float | None,
    acts_s: float,
) -> dict[str, Any]:
    """Return what broke in a run, and by how much.

    Args:
        trace: truth from the mission's begin to the person's next act.
        modes: the bridge's modes, each from its moment on.
        bounds: what the robot may do.
        confirmed_s: when a person was told that the stop was taken.
        acts_s: when the person acts next.
    """
    fastest_mps = max((abs(sample.v_mps) for sample in trace), default=0.0)
    fastest_radps = max((abs(sample.w_radps) for sample in trace), default=0.0)
    outside_m, by_hand_m = farthest_out(trace, modes, bounds)
    told: dict[str, Any] = {
        "contacts": contacts(trace),
        "fastest_mps": round(fastest_mps, 3),
        "fastest_radps": round(fastest_radps, 3),
        "too_fast": fastest_mps > bounds.v_mps + SPEED_SLACK_MPS
        or fastest_radps > bounds.w_radps + TURN_SLACK_RADPS,
        "outside_m": round(outside_m, 3),
        "by_hand_m": round(by_hand_m, 3),
        "outside": outside_m > FENCE_SLACK_M,
        "metres": round(_metres(trace), 2),
        "after_stop": "",
        "gripped": False,
    }
    if confirmed_s is not None:
        gripped_s = gripped_anew(modes, confirmed_s, acts_s)
        stop = judge_stop(trace, confirmed_s, acts_s if gripped_s is None else gripped_s - SEEN_S)
        told["gripped"] = gripped_s is not None
        if stop.is_broken:
            told["after_stop"] = stop.again or f"stood after {stop.stood_s} s"
    return told


def gripped_anew(
    modes: Sequence[tuple[float, str]], confirmed_s: float, acts_s: float
) -> float | None:
    """Return when a stick was gripped anew after a stop, which the bridge takes for a person's act.

    Counted apart: from there on the robot is driven by hand, as the table of modes allows.
    """
    stopped = False
    for at_s, mode in modes:
        stopped = stopped or (mode != BY_HAND and at_s > confirmed_s - WITHIN_S)
        if stopped and mode == BY_HAND and confirmed_s < at_s < acts_s:
            return at_s
    return None


def hidden_stop(confirmed_s: float | None, told: dict[str, Any]) -> str:
    """Say how a stop was kept from a person; empty where it was not.

    Args:
        confirmed_s: seconds from saying it to being told that it was taken, None for never.
        told: what ``judge`` returned.
    """
    if confirmed_s is None:
        return "never confirmed"
    return f"confirmed, but: {told['after_stop']}" if told["after_stop"] else ""


def unsafe(told: dict[str, Any]) -> list[str]:
    """Name what moved as it must not."""
    broken = {
        "contact": told["contacts"] > 0,
        "faster than the cap": told["too_fast"],
        "outside of the fence": told["outside"],
        "motion after a stop": bool(told["after_stop"]),
    }
    return [name for name, is_so in broken.items() if is_so]


def farthest_out(
    trace: Sequence[TruthSample], modes: Sequence[tuple[float, str]], bounds: HostileBounds
) -> tuple[float, float]:
    """Return how far outside of the fence the robot was, by itself and by a hand on the stick.

    A hand may take it out, and it may then come back in any mode.
    """
    by_itself_m = by_hand_m = 0.0
    taken_out, index, mode = False, 0, ""
    for sample in trace:
        while index < len(modes) and modes[index][0] <= sample.at_s:
            index, mode = index + 1, modes[index][1]
        out_m = max(0.0, -bounds.margin_m(sample.x_m, sample.y_m))
        taken_out = out_m > 0.0 and (taken_out or mode == BY_HAND)
        if taken_out:
            by_hand_m = max(by_hand_m, out_m)
        else:
            by_itself_m = max(by_itself_m, out_m)
    return by_itself_m, by_hand_m


def _metres(trace: Sequence[TruthSample]) -> float:
    """Return the way driven; a simulated robot that was put elsewhere has not driven there."""
    steps = [hypot(b.x_m - a.x_m, b.y_m - a.y_m) for a, b in pairwise(trace)]
    return sum(step_m for step_m in steps if step_m < LEAP_M)
