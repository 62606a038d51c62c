"""Hold what the missions read beside messages: time, ids, latency, and how often to look."""

from __future__ import annotations

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
