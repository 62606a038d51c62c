"""Say how long things take in a simulated world, in ticks of 10 ms. Data only."""

from __future__ import annotations

from dataclasses import dataclass

TICK_S = 0.01


@dataclass(frozen=True, slots=True)
class Pace:
    """Hold the delays. The defaults are what real processes showed on a busy 2-core machine."""

    planner_bridge: tuple[int, int] = (1, 2)
    """Least and most ticks on the wire, either way."""
    brain: int = 1
    route: int = 2
    journal: int = 1
    localization_period: int = 5
    planner_hears: int = 1
    """Ticks between two of the planner's looks at what came."""
    planner_tick_period: int = 5
    """Ticks between two of the mission's looks at the clock."""
    repeat: int = 5
    """Ticks between repetitions of a stop or of an operator's request: 20 Hz."""
    give_up: int = 200
    """Ticks after which an unanswered request is given up: 2 s."""


def ticks(seconds: float) -> int:
    """Return the nearest number of ticks."""
    return round(seconds / TICK_S)
