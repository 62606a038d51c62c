"""Hold what the missions read of the world beside messages: time, ids, and how often to look."""

from __future__ import annotations

import time
import uuid
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
