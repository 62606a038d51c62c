"""Run a mock model on a real port, in a thread of the test's own process."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import httpx
import uvicorn

from pons.mock_llm import build
from tests.pons.mock_llm.bad_server import BadServer
from tests.pons.mock_llm.faults import BadSwitches

START_LIMIT_S = 20.0


class RunningMock:
    """Be one mock that listens."""

    def __init__(self, url: str, client: httpx.Client) -> None:
        self.url = url
        self.client = client
        """For anybody: a client of one's own costs 0.1 s, most of it for certificates."""
        self._root = url.removesuffix("/v1")

    def set(self, **switches: Any) -> dict[str, Any]:
        """Change how it behaves."""
        reply = self.client.post(f"{self._root}/mock", json=switches)
        assert reply.status_code == 200, reply.text
        found: dict[str, Any] = reply.json()
        return found

    def report(self) -> dict[str, Any]:
        """Return what it has served."""
        found: dict[str, Any] = self.client.get(f"{self._root}/mock").json()
        return found


@contextmanager
def running_mock(switches: BadSwitches | None = None) -> Iterator[RunningMock]:
    """Serve until the block ends; what hangs lets go."""
    mock = BadServer(switches)
    config = uvicorn.Config(build(mock), log_level="error", timeout_graceful_shutdown=0)
    server = uvicorn.Server(config)
    mock.ending = lambda: server.should_exit
    with socket.socket() as ears:
        ears.bind(("127.0.0.1", 0))
        ears.listen(64)
        port = ears.getsockname()[1]
        thread = threading.Thread(target=server.run, kwargs={"sockets": [ears]}, daemon=True)
        thread.start()
        client = httpx.Client(trust_env=False, verify=False)
        try:
            yield RunningMock(f"http://127.0.0.1:{port}/v1", client)
        finally:
            client.close()
            server.should_exit = True
            thread.join(START_LIMIT_S)
            assert not thread.is_alive()
