"""A loop that fails or ends begins again, and its error is told; cancelled, it ends."""

from __future__ import annotations

import asyncio

import pytest

from planner.loops import keep_going


def test_an_error_is_told_and_the_loop_begins_again(caplog: pytest.LogCaptureFixture) -> None:
    rounds: list[str] = []
    third = asyncio.Event()

    async def work() -> None:
        rounds.append("begun")
        if len(rounds) == 1:
            raise ZeroDivisionError("of one round")
        if len(rounds) == 2:
            return
        third.set()
        await asyncio.Event().wait()

    async def story() -> None:
        loop = asyncio.create_task(keep_going("eyes", work, again_s=0.0))
        await third.wait()
        loop.cancel()
        with pytest.raises(asyncio.CancelledError):
            await loop

    asyncio.run(asyncio.wait_for(story(), 10.0))
    (told,) = caplog.records
    assert "eyes" in told.message
    assert told.exc_info is not None
    assert told.exc_info[0] is ZeroDivisionError
