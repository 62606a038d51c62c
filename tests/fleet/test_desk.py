"""Try what keeps the fleet's loops going."""

from __future__ import annotations

import asyncio

import pytest
from sqlalchemy.exc import OperationalError

import fleet.desk
from fleet.desk import keep_going


def test_a_loop_that_fails_begins_again_until_it_is_cancelled(
    monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(fleet.desk, "AGAIN_S", 0.0)
    failures = [OperationalError("", {}, OSError()), KeyError("odd"), OSError("no space left")]
    reached = asyncio.Event()

    async def loop() -> None:
        if failures:
            raise failures.pop()
        reached.set()
        await asyncio.Event().wait()

    async def story() -> None:
        task = asyncio.create_task(keep_going("sweep", loop))
        async with asyncio.timeout(10.0):
            await reached.wait()
        task.cancel()
        (ended,) = await asyncio.gather(task, return_exceptions=True)
        assert isinstance(ended, asyncio.CancelledError)

    asyncio.run(story())
    assert "store_unavailable: sweep" in caplog.text
    assert "KeyError: 'odd'" in caplog.text
