"""Schedule ticks at a fixed period and skip missed ones.

Whole missed periods are counted and skipped, never caught up in a burst: a burst would send old
decisions as if they were new. A tick less than a period late just runs late.
"""

from __future__ import annotations

from math import floor
from typing import TYPE_CHECKING

from wire.value import value

if TYPE_CHECKING:
    from bridge.realtime.clock import Clock


@value
class PacerTick:
    """Hold a tick's wake time, its lateness, and the periods skipped before it."""

    now_s: float
    late_s: float
    """Behind its own due time, so always less than a period."""
    missed: int


class Pacer:
    """Wait for each period of an absolute schedule."""

    def __init__(self, clock: Clock, period_s: float) -> None:
        if not period_s > 0.0:
            raise ValueError(f"period_s must be positive, got {period_s}")
        self._clock = clock
        self.period_s = period_s
        self._due_s = clock.now_s() + period_s

    def wait(self) -> PacerTick:
        """Sleep until the next tick is due and say how it went."""
        self._clock.sleep_until(self._due_s)
        now_s = self._clock.now_s()
        missed = max(0, floor((now_s - self._due_s) / self.period_s))
        self._due_s += missed * self.period_s
        late_s = max(0.0, now_s - self._due_s)
        self._due_s += self.period_s
        return PacerTick(now_s, late_s, missed)

    def slack_s(self) -> float:
        """Return the time until the next tick is due; negative when it is already late."""
        return self._due_s - self._clock.now_s()
