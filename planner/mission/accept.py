"""Measure how long goals wait for their first waypoint."""

from __future__ import annotations

from collections import deque

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
