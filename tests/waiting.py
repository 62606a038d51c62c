"""Wait for what another thread or process does in real time."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

LIMIT_S = 30.0


def until(seen: Callable[[], T | None], limit_s: float = LIMIT_S) -> T:
    """Return the first value that counts as true; fail where none comes in time."""
    end_s = time.monotonic() + limit_s
    while not (value := seen()):
        assert time.monotonic() < end_s, f"not within {limit_s:g} s"
        time.sleep(0.005)
    return value
