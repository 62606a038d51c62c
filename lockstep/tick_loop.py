"""Run coroutines on a simulated clock: an event loop without threads, sockets and waiting.

The planner's shell runs on it unchanged: tasks, timers and futures are asyncio's own. What is done
in a thread elsewhere is done at once. Timers that are due together fire in the order in which they
were set, each with all that follows from it before the next.
"""

from __future__ import annotations

import asyncio
from asyncio import _get_running_loop, _set_running_loop
from collections import deque
from contextvars import copy_context
from functools import partial
from heapq import heappop, heappush
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine
    from contextvars import Context

T = TypeVar("T")

EPSILON_S = 1e-6
"""Sums of ticks differ in their last digits."""


class TickLoop(asyncio.AbstractEventLoop):
    """Hold what waits for its time. A copy holds nothing: only an idle one is worth copying."""

    def __init__(self, now_s: float) -> None:
        self._now_s = now_s
        self._ready: deque[tuple[asyncio.Handle, partial[object]]] = deque()
        self._timers: list[tuple[float, int, asyncio.TimerHandle, partial[object]]] = []
        self._count = 0

    def __deepcopy__(self, memo: dict[int, Any]) -> TickLoop:
        return TickLoop(self._now_s)  # type: ignore[abstract]  # as below: no threads, no sockets

    @property
    def busy(self) -> bool:
        """Return whether anything is still to happen."""
        return bool(self._ready) or any(not timer[2].cancelled() for timer in self._timers)

    def do(self, now_s: float, act: Callable[[], T]) -> T:
        """Do something inside the loop at a time, with all that follows from it at once.

        Raises:
            BaseException: what failed in it, or in a callback; a task keeps what failed in it.
        """
        self._now_s = now_s
        outside = _get_running_loop()
        _set_running_loop(self)
        try:
            result = act()
            self._settle()
        finally:
            _set_running_loop(outside)
        return result

    def fire(self) -> None:
        """Fire the timers that are due; for use inside ``do``."""
        while self._timers and self._timers[0][0] <= self._now_s + EPSILON_S:
            _, _, timer, act = heappop(self._timers)
            if not timer.cancelled():
                act()
            self._settle()

    def _settle(self) -> None:
        while self._ready:
            handle, act = self._ready.popleft()
            if not handle.cancelled():
                act()

    # What asyncio asks of an event loop -----------------------------------------------------------

    def time(self) -> float:
        """Return the simulated time [s]."""
        return self._now_s

    def call_soon(  # type: ignore[override]  # typeshed ties the arguments to the callback
        self, callback: Callable[..., object], *args: Any, context: Context | None = None
    ) -> asyncio.Handle:
        """Call something as soon as what runs now has ended."""
        handle = asyncio.Handle(callback, args, self, context)
        self._ready.append((handle, partial((context or copy_context()).run, callback, *args)))
        return handle

    def call_later(  # type: ignore[override]  # as above
        self,
        delay: float,
        callback: Callable[..., object],
        *args: Any,
        context: Context | None = None,
    ) -> asyncio.TimerHandle:
        """Call something after a delay [s]."""
        return self.call_at(self._now_s + delay, callback, *args, context=context)

    def call_at(  # type: ignore[override]  # as above
        self,
        when: float,
        callback: Callable[..., object],
        *args: Any,
        context: Context | None = None,
    ) -> asyncio.TimerHandle:
        """Call something at a time of this loop [s]."""
        timer = asyncio.TimerHandle(when, callback, args, self, context)
        self._count += 1
        act = partial((context or copy_context()).run, callback, *args)
        heappush(self._timers, (when, self._count, timer, act))
        return timer

    def create_future(self) -> asyncio.Future[Any]:
        """Return a future of this loop."""
        return asyncio.Future(loop=self)

    def create_task(  # type: ignore[override]  # typeshed: a coroutine-like of any kind
        self, coro: Coroutine[Any, Any, T], *, name: str | None = None, context: Any = None
    ) -> asyncio.Task[T]:
        """Run a coroutine from now on."""
        return asyncio.Task(coro, loop=self, name=name, context=context)

    def run_in_executor(  # type: ignore[override]  # no thread, so no executor
        self, executor: None, func: Callable[..., T], *args: Any
    ) -> asyncio.Future[T]:
        """Do at once what a thread would do."""
        future: asyncio.Future[T] = self.create_future()
        future.set_result(func(*args))
        return future

    def get_debug(self) -> bool:
        """Return False: nothing is slow on this clock."""
        return False

    def call_exception_handler(self, context: dict[str, Any]) -> None:
        """Nothing: tasks of a planner that was killed complain here when they are collected."""

    def _timer_handle_cancelled(self, handle: asyncio.TimerHandle) -> None:
        """Nothing: a cancelled timer is passed over when it is due."""
