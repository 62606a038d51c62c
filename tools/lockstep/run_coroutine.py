"""Run a coroutine within one tick. One that waits for anything outside does not fit here."""

from __future__ import annotations

from collections.abc import Awaitable, Generator
from typing import Any, TypeVar

T = TypeVar("T")

MAX_YIELDS = 100


class NotAtOnce(Exception):
    """A coroutine waited for something that does not exist on a simulated clock."""


def at_once(work: Awaitable[T]) -> T:
    """Run something awaitable to its end without an event loop; bare yields are allowed.

    Raises:
        NotAtOnce: it waits for a timer, a socket or a task.
    """
    running: Generator[Any, None, T] = work.__await__()
    try:
        for _ in range(MAX_YIELDS):
            if running.send(None) is not None:
                break
    except StopIteration as done:
        result: T = done.value
        return result
    running.close()
    raise NotAtOnce("the brain waits; in lockstep give its delay as Pace(brain=…) instead")
