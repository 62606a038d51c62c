"""Coroutines run on a simulated clock as on a real one: order by time, then by when it was set."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from copy import deepcopy
from typing import Any

import pytest

from lockstep.tick_loop import TickLoop


def made() -> TickLoop:
    return TickLoop(1_000.0)  # type: ignore[abstract]  # what needs threads or sockets


def start(loop: TickLoop, work: Coroutine[Any, Any, None]) -> None:
    """Run a coroutine as far as it goes at once."""
    loop.do(loop.time(), lambda: [loop.create_task(work)])


def turn(loop: TickLoop, seconds: float) -> None:
    """Let time pass in ticks of 10 ms."""
    for _ in range(round(seconds / 0.01)):
        loop.do(loop.time() + 0.01, loop.fire)


def test_sleepers_wake_in_the_order_of_their_times_and_then_of_their_sleeping() -> None:
    loop, woken = made(), list[str]()

    async def sleep(name: str, seconds: float) -> None:
        await asyncio.sleep(seconds)
        woken.append(f"{name} {loop.time():.2f}")

    for name, seconds in (("late", 0.05), ("first", 0.02), ("second", 0.02), ("now", 0.0)):
        start(loop, sleep(name, seconds))
    assert woken == ["now 1000.00"]
    turn(loop, 0.1)
    assert woken == ["now 1000.00", "first 1000.02", "second 1000.02", "late 1000.05"]
    assert not loop.busy


def test_a_timeout_ends_what_waits_and_a_thread_is_not_waited_for() -> None:
    loop, told = made(), list[object]()

    async def wait() -> None:
        told.append(await asyncio.to_thread(sum, (1, 2)))
        try:
            async with asyncio.timeout(0.03):
                await asyncio.sleep(1.0)
        except TimeoutError:
            told.append(round(loop.time(), 2))

    start(loop, wait())
    assert told == [3]
    assert loop.busy
    turn(loop, 0.05)
    assert told == [3, 1000.03]
    assert not loop.busy, "the cancelled sleep is forgotten"
    assert not deepcopy(loop).busy


def test_what_a_callback_raises_comes_out_and_the_loop_around_is_left_as_it_was() -> None:
    loop = made()

    async def outside() -> None:
        around = asyncio.get_running_loop()
        with pytest.raises(ZeroDivisionError):
            loop.do(loop.time(), lambda: loop.call_soon(lambda: 1 / 0))
        assert asyncio.get_running_loop() is around

    asyncio.run(outside())
