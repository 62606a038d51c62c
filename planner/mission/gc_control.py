"""Keep the garbage collector away from driving: freeze what is there, collect only while standing.

A full collection over the whole heap paused the loop for over 100 ms, long enough to lose the
robot; over a frozen heap it costs what was allocated since.
"""

from __future__ import annotations

import gc

STANDING_PERIOD_S = 5.0
DRIVING_PERIOD_S = 60.0
"""While driving only the youngest generation, and seldom: a drive may take ten minutes."""


class Collector:
    """Own the process's collector from ``freeze`` to ``thaw``."""

    def __init__(self) -> None:
        self._newest_s = float("-inf")
        self._frozen = False

    def freeze(self, now_s: float) -> None:
        """Take all that lives now out of every later collection."""
        gc.collect()
        gc.freeze()
        gc.disable()
        self._frozen, self._newest_s = True, now_s

    def maybe(self, now_s: float, *, standing: bool) -> None:
        """Collect if it is time and nothing is disturbed by it."""
        if not self._frozen:
            return
        period_s = STANDING_PERIOD_S if standing else DRIVING_PERIOD_S
        if now_s - self._newest_s >= period_s:
            gc.collect(2 if standing else 0)
            self._newest_s = now_s

    def thaw(self) -> None:
        """Give the collector back as it was."""
        if self._frozen:
            gc.unfreeze()
            gc.enable()
            self._frozen = False
