"""Double the pause before each restart of a failing process. Told the time; reads no clock."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf


@dataclass(slots=True)
class Backoff:
    """Pauses between restarts: each twice the one before, up to a longest."""

    first_s: float
    longest_s: float
    steady_s: float = inf
    """What lived so long starts with the first pause again."""
    next_s: float = field(init=False)
    """The pause that comes next."""

    def __post_init__(self) -> None:
        self.next_s = self.first_s

    def pause_after(self, lived_s: float = 0.0) -> float:
        """Return how long to wait [s] before the next start, and double the one after it."""
        if lived_s >= self.steady_s:
            self.reset()
        pause_s, self.next_s = self.next_s, min(2.0 * self.next_s, self.longest_s)
        return pause_s

    def reset(self) -> None:
        """Begin with the first pause again: it works."""
        self.next_s = self.first_s
