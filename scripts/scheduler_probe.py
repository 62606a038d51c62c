"""Tell whether this machine keeps time: on each processor, how late naps of 10 ms end.

Owns its own timers and asks nobody, least of all what is tested. Knows no bridge.
"""

from __future__ import annotations

import os
import threading
import time
from bisect import bisect_left
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from types import TracebackType

NAP_S = 0.01
LATE_S = 0.02
LATE_SHARE = 0.02
"""Of the naps: a loop of 100 Hz then misses two ticks in a second."""
STALL_S = 0.1
"""One nap so late: a bridge disarms for less."""
LOOK_S = 3.0


@dataclass(frozen=True, slots=True)
class HostTiming:
    """Give how naps ended in a span of time."""

    naps: int
    late: int
    worst_s: float
    lost_s: float = 0.0
    """By how much the late ones were late, together, on the processor that lost most."""

    @property
    def time(self) -> bool:
        """Tell whether the machine kept time. Where nothing was measured it did not."""
        return self.naps > 0 and self.late <= LATE_SHARE * self.naps and self.worst_s <= STALL_S

    def __str__(self) -> str:
        return (
            f"{self.late} of {self.naps} naps over {LATE_S * 1000:.0f} ms late, "
            f"the worst by {self.worst_s:.2f} s"
        )


@dataclass
class Naps:
    """Hold the naps of one processor, oldest first."""

    ended_s: list[float] = field(default_factory=list)
    late_s: list[float] = field(default_factory=list)
    due_s: float = float("inf")
    """When the one that is under way should end."""

    def between(self, from_s: float, to_s: float) -> list[float]:
        """Return how late those were that ended, or should have, in a span."""
        first, last = bisect_left(self.ended_s, from_s), bisect_left(self.ended_s, to_s)
        overdue_s = to_s - max(self.due_s, from_s)
        return self.late_s[first:last] + ([overdue_s] if overdue_s > LATE_S else [])


def worst_timing(processors: Sequence[Naps], from_s: float, to_s: float) -> HostTiming:
    """Judge a span by the processor that kept time worst."""
    each = [_timing_of(naps.between(from_s, to_s)) for naps in processors]
    worst = max(
        each, key=lambda one: (not one.time, one.late, one.worst_s), default=HostTiming(0, 0, 0.0)
    )
    return replace(worst, lost_s=max((one.lost_s for one in each), default=0.0))


def _timing_of(late_s: list[float]) -> HostTiming:
    late = [one for one in late_s if one > LATE_S]
    return HostTiming(len(late_s), len(late), max(late_s, default=0.0), sum(late))


def until_calm(
    look: Callable[[], HostTiming], limit_s: float, clock: Callable[[], float]
) -> HostTiming:
    """Look again and again until the machine keeps time, for so long at most; return the last."""
    end_s = clock() + limit_s
    while True:
        seen = look()
        if seen.time or clock() >= end_s:
            return seen


class Pulse:
    """Nap on every processor that this process may use, until closed."""

    def __init__(self) -> None:
        self._ending = threading.Event()
        self._naps: list[Naps] = []
        self._threads: list[threading.Thread] = []

    def __enter__(self) -> Self:
        for cpu in sorted(os.sched_getaffinity(0)):
            naps = Naps()
            thread = threading.Thread(target=self._nap, args=(cpu, naps), daemon=True)
            self._naps.append(naps)
            self._threads.append(thread)
            thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._ending.set()
        for thread in self._threads:
            thread.join()

    def timing_since(self, from_s: float) -> HostTiming:
        """Judge the time since then."""
        return worst_timing(self._naps, from_s, time.monotonic())

    def look(self) -> HostTiming:
        """Judge the next moments."""
        from_s = time.monotonic()
        time.sleep(LOOK_S)
        return self.timing_since(from_s)

    def _nap(self, cpu: int, naps: Naps) -> None:
        with suppress(OSError):  # it was taken from us: any other serves
            os.sched_setaffinity(0, {cpu})  # of this thread alone
        while not self._ending.is_set():
            naps.due_s = time.monotonic() + NAP_S
            time.sleep(NAP_S)
            ended_s = time.monotonic()
            naps.late_s.append(ended_s - naps.due_s)
            naps.ended_s.append(ended_s)
