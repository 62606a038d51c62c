"""Summarise the loop's lateness and step times, second by second."""

from __future__ import annotations

from dataclasses import dataclass

WINDOW_TICKS = 100


@dataclass(frozen=True, slots=True)
class Summary:
    """Hold the last whole second's lateness and step times [us]."""

    late_p50_us: float = 0.0
    late_max_us: float = 0.0
    step_max_us: float = 0.0


class LoopStats:
    """Collect a second of ticks, then sum it up; a sort of 100 numbers once a second is 5 us."""

    def __init__(self) -> None:
        self._late_us: list[float] = []
        self._step_max_us = 0.0
        self.summary = Summary()

    def add(self, late_s: float, step_ns: int) -> None:
        """Take one tick: its lateness, skipped periods included, and its step's CPU time."""
        self._late_us.append(late_s * 1e6)
        self._step_max_us = max(self._step_max_us, step_ns / 1e3)
        if len(self._late_us) == WINDOW_TICKS:
            self._late_us.sort()
            self.summary = Summary(
                self._late_us[WINDOW_TICKS // 2], self._late_us[-1], self._step_max_us
            )
            self._late_us.clear()
            self._step_max_us = 0.0
