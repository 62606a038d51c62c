"""Tell which UTC day spending counts to, by our own wall clock. A clock that steps back gives none.

The newest day ever seen stays the day while the clock says an older one. A clock that leapt ahead
by mistake would shut the budget until that date comes, so a day's running without a restart, on our
monotonic clock, while the wall clock stays behind ends that day as well.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, date, datetime, timedelta

DAY_S = 86_400.0


@dataclass(frozen=True, slots=True)
class DayClocks:
    """Read the two clocks; tests set them."""

    unix_s: Callable[[], float] = time.time
    monotonic_s: Callable[[], float] = time.monotonic


class Days:
    """Remember the newest day, and since when the wall clock is behind it."""

    def __init__(self, newest: date | None, clocks: DayClocks) -> None:
        self._clocks = clocks
        self._newest = newest
        self._behind_since_s: float | None = None

    def today(self) -> date:
        """Return the day that spending counts to now."""
        shown = utc_date(self._clocks.unix_s())
        newest = self._newest
        if newest is None or shown >= newest:
            self._newest, self._behind_since_s = shown, None
            return shown
        now_s = self._clocks.monotonic_s()
        if self._behind_since_s is None:
            self._behind_since_s = now_s
        if now_s - self._behind_since_s >= DAY_S:
            self._newest, self._behind_since_s = shown, None
            return shown
        return newest

    def resets_in_s(self) -> float:
        """Return how long until the next day [s]."""
        today, unix_s = self.today(), self._clocks.unix_s()
        midnight = datetime.combine(today + timedelta(days=1), datetime.min.time(), UTC)
        by_wall_s = max(0.0, midnight.timestamp() - unix_s)
        if self._behind_since_s is None:
            return by_wall_s
        left_s = DAY_S - (self._clocks.monotonic_s() - self._behind_since_s)
        return min(by_wall_s, max(0.0, left_s))


def utc_date(unix_s: float) -> date:
    """Return the UTC date of a wall clock; a time beyond the calendar is its first day."""
    try:
        return datetime.fromtimestamp(unix_s, UTC).date()
    except (ValueError, OverflowError, OSError):
        return date(1970, 1, 1)
