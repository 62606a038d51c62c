"""Read the monotonic clock and sleep until an absolute time. The loop's only clock.

An absolute sleep can't drift: the time a tick took and the time until the thread really slept are
both inside the deadline. Python has no door to clock_nanosleep(2), so ctypes opens one; it lets go
of the GIL while it sleeps.
"""

from __future__ import annotations

import ctypes
import sys
import time
from errno import EINTR
from typing import Protocol

_CLOCK_MONOTONIC = 1
_TIMER_ABSTIME = 1
_NS = 1_000_000_000


class Clock(Protocol):
    """Read this host's monotonic time [s] and wait until one."""

    def now_s(self) -> float: ...

    def sleep_until(self, at_s: float) -> None:
        """Return at ``at_s`` or later; at once when it has passed."""


class _Timespec(ctypes.Structure):
    _fields_ = (("tv_sec", ctypes.c_long), ("tv_nsec", ctypes.c_long))


class MonotonicClock:
    """Sleep by clock_nanosleep where the system has it, else by time.sleep."""

    def __init__(self) -> None:
        self._libc = _clock_nanosleep()
        self._until = _Timespec()
        self._until_ref = ctypes.byref(self._until)

    @property
    def absolute(self) -> bool:
        """Return whether sleeps are absolute; where not, each is late by the work before it."""
        return self._libc is not None

    def now_s(self) -> float:
        return time.monotonic()

    def sleep_until(self, at_s: float) -> None:
        if self._libc is None:
            time.sleep(max(0.0, at_s - time.monotonic()))
            return
        seconds = int(at_s)
        self._until.tv_sec = seconds
        self._until.tv_nsec = min(_NS - 1, int((at_s - seconds) * _NS))
        while self._libc(_CLOCK_MONOTONIC, _TIMER_ABSTIME, self._until_ref, None) == EINTR:
            pass  # a signal: its Python handler runs when this returns; the tick keeps its time


def _clock_nanosleep() -> ctypes._NamedFuncPointer | None:
    if sys.platform != "linux":
        return None
    try:
        function = ctypes.CDLL(None).clock_nanosleep
    except AttributeError:
        return None
    function.argtypes = (ctypes.c_int, ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)
    function.restype = ctypes.c_int
    return function
