"""Keep a steady pace against a clock, without ever hurrying. Pure; told the time.

Law: a tick less than a period late runs late; whole missed periods are counted and skipped, never
caught up in a burst. Simulated time then lags, and the real-time factor says so.
"""

from __future__ import annotations

from collections import deque
from math import floor


class SimPacer:
    """Hold absolute deadlines one period apart."""

    def __init__(self, period_s: float, now_s: float) -> None:
        self._period_s = period_s
        self.next_s = now_s + period_s
        self.missed_total = 0

    def woke(self, now_s: float) -> int:
        """Move on to the deadline after ``now_s``; return how many whole periods were missed."""
        missed = max(0, floor((now_s - self.next_s) / self._period_s))
        self.missed_total += missed
        self.next_s += (missed + 1) * self._period_s
        return missed


class RealTimeFactor:
    """Measure simulated over real time for the last second's ticks."""

    def __init__(self, period_s: float, window_s: float = 1.0) -> None:
        self._period_s = period_s
        self._stamps: deque[float] = deque(maxlen=round(window_s / period_s) + 1)

    def note_tick(self, now_s: float) -> float:
        """Add a tick and return the real-time factor; 1 until there are two ticks to compare."""
        self._stamps.append(now_s)
        real_s = now_s - self._stamps[0]
        return (len(self._stamps) - 1) * self._period_s / real_s if real_s > 0.0 else 1.0
