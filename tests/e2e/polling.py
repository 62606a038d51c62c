"""Wait for what real processes do in real time: poll, with a bound, and say what never came."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

T = TypeVar("T")

POLL_S = 0.02


def until(
    seen: Callable[[], T | None], limit_s: float, what: str, tell: Callable[[], object] = lambda: ""
) -> T:
    """Return the first value that counts as true.

    Raises:
        AssertionError: none came within the bound; ``tell`` adds what there was instead.
    """
    end_s = time.monotonic() + limit_s
    while True:
        if value := seen():
            return value
        if time.monotonic() >= end_s:
            raise AssertionError(f"not within {limit_s:.1f} s: {what}; {tell()}")
        time.sleep(POLL_S)
