"""Keep processes in tests: make small ones, ask them, tell stories of them in bounded time."""

from __future__ import annotations

import asyncio
import contextlib
import json
from collections.abc import AsyncIterator, Awaitable, Callable
from functools import wraps
from math import inf
from typing import ParamSpec

import pytest

from processes.worker import SupervisedWorker
from processes.worker_protocol import Frame, WorkerFailure
from tests.processes.small_worker_main import CODES, MODULE, Trouble

P = ParamSpec("P")
LIMIT_S = 30.0


class Tiny(SupervisedWorker):
    """Keep a small process that behaves as it is told."""

    def __init__(
        self, *, one_at_a_time: bool = False, rests_after_s: float = inf, **told: str
    ) -> None:
        super().__init__(
            *(MODULE, (json.dumps(told),), CODES),
            one_at_a_time=one_at_a_time,
            first_word_s=LIMIT_S,
            longest_pause_s=0.1,
            rests_after_s=rests_after_s,
        )

    def _check_greeting(self, said: object) -> None:
        if said is not None:
            raise Trouble("unwilling", f"it said {said}")

    async def asked(
        self, body: bytes = b"", timeout_s: float = LIMIT_S, **head: object
    ) -> tuple[int, bytes]:
        """Return which process answered, and what."""
        return await self.ask(head, (body,), timeout_s, _understood)


def _understood(frame: Frame) -> tuple[int, bytes]:
    head, body = frame
    return int(head["pid"]), body


@contextlib.asynccontextmanager
async def running(
    *, one_at_a_time: bool = False, rests_after_s: float = inf
) -> AsyncIterator[Tiny]:
    """Start a small one, and end it whatever happens."""
    tiny = Tiny(one_at_a_time=one_at_a_time, rests_after_s=rests_after_s)
    try:
        await tiny.start(LIMIT_S)
        yield tiny
    finally:
        await tiny.close()


def pid_of(kept: SupervisedWorker) -> int:
    assert kept.pid is not None
    return kept.pid


async def code_of(answer: Awaitable[object]) -> str:
    """Return the code of the failure that is the answer."""
    with pytest.raises(WorkerFailure) as caught:
        await answer
    return caught.value.code


async def until(holds: Callable[[], bool]) -> None:
    """Wait until something holds, as long as the story may last."""
    while not holds():  # noqa: ASYNC110  # nothing tells of another process's end
        await asyncio.sleep(0.01)


def story(test: Callable[P, Awaitable[None]]) -> Callable[P, None]:
    """Run a test to its end, in bounded time: on the ``loop`` that it names, or on its own."""

    @wraps(test)
    def run(*args: P.args, **kwargs: P.kwargs) -> None:
        async def bounded() -> None:
            async with asyncio.timeout(LIMIT_S):
                await test(*args, **kwargs)

        loop = kwargs.get("loop")
        if isinstance(loop, asyncio.Runner):
            loop.run(bounded())
        else:
            asyncio.run(bounded())

    return run
