"""Count what arrives on each topic, and remember what was wrong with it. Told the time."""

from __future__ import annotations

from collections import deque

WINDOW_S = 2.0


class TopicArrivals:
    """Hold the arrivals of one topic in the last seconds."""

    def __init__(self) -> None:
        self._at_s: deque[float] = deque(maxlen=4096)
        self.newest_s: float | None = None
        self.wrong = ""
        """Why the newest that was refused could not be used."""
        self.wrong_s = float("-inf")

    def note(self, now_s: float) -> None:
        """Count one good message."""
        self._at_s.append(now_s)
        self.newest_s = now_s

    def refuse(self, why: str, now_s: float) -> None:
        """Remember one that could not be used."""
        self.wrong, self.wrong_s = why, now_s

    def rate_hz(self, now_s: float) -> float:
        """Return how many a second came in the last two."""
        while self._at_s and now_s - self._at_s[0] > WINDOW_S:
            self._at_s.popleft()
        return len(self._at_s) / WINDOW_S

    def silent_s(self, since_s: float, now_s: float) -> float:
        """Return for how long nothing good came, counted from ``since_s`` at the earliest."""
        newest_s = self.newest_s if self.newest_s is not None else since_s
        return now_s - max(newest_s, since_s)

    def is_refused(self, now_s: float) -> bool:
        """Return whether a message was refused in the last two seconds."""
        return now_s - self.wrong_s <= WINDOW_S
