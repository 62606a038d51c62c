"""Look at a request as it comes in: its language, and when it came."""

from __future__ import annotations

import re
from collections import deque

from planner.plan import Language

_CJK = re.compile(r"[\u3400-\u9fff]")
KEPT = 1000


def language_of(text: str) -> Language:
    """Tell Chinese from English by its characters; names in the other script don't decide."""
    chinese = len(_CJK.findall(text))
    words = len(re.findall(r"[A-Za-z]+", text))
    return Language.ZH if chinese > words else Language.EN


class Accepted:
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
        """Stop the watch; return what it showed the first time, None ever after."""
        since_s = self._since_s.pop(goal_id, None)
        if since_s is None:
            return None
        self.seconds.append(now_s - since_s)
        return now_s - since_s
