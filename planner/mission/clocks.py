"""Hold what the missions read beside messages: time, ids, latency, and how often to look.

The garbage collector is kept away from driving: all that is there is frozen, and it collects only
while the robot stands. A full collection over the whole heap paused the loop for over 100 ms, long
enough to lose the robot; over a frozen heap it costs what was allocated since.
"""

from __future__ import annotations

import gc
import time
import uuid
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

POLL_S = 0.005
"""Half a bridge tick: a status waits 2.5 ms on average; an empty drain costs 0.1 µs."""


@dataclass(frozen=True, slots=True)
class Clocks:
    """Tell time and mint ids; tests put their own here."""

    monotonic: Callable[[], float] = time.monotonic
    wall: Callable[[], float] = time.time
    new_id: Callable[[], str] = lambda: uuid.uuid4().hex[:12]
    poll_s: float = POLL_S


KEPT = 1000


class WaypointLatency:
    """Measure from a goal's acceptance to its first waypoint on the wire [s]."""

    def __init__(self) -> None:
        self._since_s: dict[str, float] = {}
        self.seconds: deque[float] = deque(maxlen=KEPT)

    def note(self, goal_id: str, now_s: float) -> None:
        """Start the watch."""
        if len(self._since_s) >= KEPT:
            self._since_s.pop(next(iter(self._since_s)))
        self._since_s[goal_id] = now_s

    def first_waypoint(self, goal_id: str, now_s: float) -> float | None:
        """Stop the watch; return its reading the first time, None ever after."""
        since_s = self._since_s.pop(goal_id, None)
        if since_s is None:
            return None
        self.seconds.append(now_s - since_s)
        return now_s - since_s


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
