"""The page's measurement says why it can't be taken, and its watchers really listen."""

from __future__ import annotations

import asyncio
import json
from pathlib import Path

import pytest
from websockets.asyncio.server import ServerConnection, serve

from tools.bench import watchers
from tools.bench.context import BenchLab
from tools.bench.measure import page
from tools.bench.store import Store
from tools.bench.watchers import Watchers


def test_without_a_browser_it_is_not_measured_and_no_failure(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(page, "chromium", lambda: None)
    store = Store(tmp_path / "results.jsonl", False, "c1", "m1")
    (row,) = page.measure(BenchLab(store, long=False, name="page"))
    assert (row.value, row.valid) == ("not measured", True)
    assert "no Chromium" in row.note


@pytest.mark.parametrize("patience_s", [5.0, 0.0])
def test_each_watcher_opens_a_socket_of_its_own_and_reads(
    patience_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who has no patience kills them, and leaves no pipe open either."""
    monkeypatch.setattr(watchers, "PATIENCE_S", patience_s)

    async def story() -> None:
        taken = asyncio.Queue[int]()

        async def stream(socket: ServerConnection) -> None:
            await socket.send(json.dumps({"kind": "snapshot"}))
            for number in range(50):
                await socket.send("x" * 10_000)
                taken.put_nowait(number)
            await socket.wait_closed()

        async with serve(stream, "127.0.0.1", 0) as server:
            port = server.sockets[0].getsockname()[1]
            three = Watchers(f"ws://127.0.0.1:{port}/", 3)
            await asyncio.to_thread(three.__enter__)
            try:
                for _ in range(3 * 50):
                    await asyncio.wait_for(taken.get(), 5.0)
            finally:
                await asyncio.to_thread(three.__exit__, None, None, None)

    asyncio.run(story())
