"""Bound how often each asker may ask. A stop is never asked about here."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable

MOST_ASKERS = 256


class Rate:
    """Be one bucket of tokens: ``burst`` at once, then ``a_second``."""

    def __init__(self, a_second: float, burst: int, now_s: float) -> None:
        self._a_second, self._burst = a_second, float(burst)
        self._left, self._then_s = self._burst, now_s

    def take(self, now_s: float) -> bool:
        """Return whether one more is within the rate, and count it if so."""
        self._left = min(self._burst, self._left + (now_s - self._then_s) * self._a_second)
        self._then_s = now_s
        if not self._left >= 1.0:
            return False
        self._left -= 1.0
        return True

    def wait_s(self) -> float:
        """Return when the next one will be, counted from the last question [s]."""
        return max(0.0, 1.0 - self._left) / self._a_second


class Rates:
    """Hold a rate for each of the newest askers: one who hurries takes nothing from another."""

    def __init__(
        self, a_second: float, burst: int, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._a_second, self._burst, self._clock = a_second, burst, clock
        self._rates: OrderedDict[str, Rate] = OrderedDict()

    def __len__(self) -> int:
        return len(self._rates)

    def wait_s(self, asker: str) -> float | None:
        """Count one; return None where it is within the rate, else how long to wait [s]."""
        now_s = self._clock()
        rate = self._rates.pop(asker, None) or Rate(self._a_second, self._burst, now_s)
        self._rates[asker] = rate
        if len(self._rates) > MOST_ASKERS:
            self._rates.popitem(last=False)
        return None if rate.take(now_s) else rate.wait_s()
