"""Serve a test's own services by a real uvicorn server, as the planner process does."""

from __future__ import annotations

import asyncio
import contextlib
import json
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import uvicorn

from planner.api import Access, build
from planner.api.connections import HttpConnection, protocol
from planner.api.crowd import Bounds
from tests.planner.api.fakes import FakeServices

LOCAL = Access("127.0.0.1")
PATIENCE_S = 10.0


@dataclass(frozen=True)
class Served:
    """Be one running server."""

    port: int
    services: FakeServices
    http: type[HttpConnection]

    def connect(self) -> socket.socket:
        return socket.create_connection(("127.0.0.1", self.port), PATIENCE_S)

    @contextmanager
    def silent(self, count: int) -> Iterator[list[socket.socket]]:
        """Hold so many connections that say nothing."""
        with contextlib.ExitStack() as stack:
            yield [stack.enter_context(self.connect()) for _ in range(count)]

    def ask(self, raw: bytes) -> tuple[int, dict[str, Any]]:
        """Send these bytes on a connection of their own; return status and JSON of the answer."""
        with self.connect() as asking:
            asking.sendall(raw)
            return answer_of(asking)

    def stop(self) -> bool:
        """Stop on a connection of its own; return whether it was confirmed."""
        status, body = self.ask(request("POST", "/v1/stop"))
        return status == 200 and body["confirmed"] is True


def request(method: str, path: str, body: bytes = b"", *lines: str) -> bytes:
    """Return a request's bytes, with these header lines beside the usual ones."""
    more = "".join(f"{line}\r\n" for line in lines)
    length = f"Content-Length: {len(body)}\r\n" if body else ""
    head = f"{method} {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nConnection: close\r\n{length}{more}\r\n"
    return head.encode() + body


def read_all(asking: socket.socket) -> bytes:
    """Read to the end, however it comes."""
    read = bytearray()
    with contextlib.suppress(ConnectionError):
        while piece := asking.recv(65_536):
            read += piece
    return bytes(read)


def answer_of(asking: socket.socket) -> tuple[int, dict[str, Any]]:
    """Return status and JSON of the answer that ends a connection; 0 where it just ended."""
    head, _, body = read_all(asking).partition(b"\r\n\r\n")
    if not head:
        return 0, {}
    return int(head.split()[1]), json.loads(body) if body else {}


@contextmanager
def served(
    services: FakeServices | None = None, access: Access = LOCAL, bounds: Bounds | None = None
) -> Iterator[Served]:
    """Serve while the context lasts."""
    given = services or FakeServices()
    http = protocol(bounds)
    with socket.create_server(("127.0.0.1", 0), backlog=2_048) as listener:
        config = uvicorn.Config(
            build(given, access), http=http, log_config=None, access_log=False,
            ws_max_size=4_096, ws_per_message_deflate=False, timeout_graceful_shutdown=1,
        )  # fmt: skip
        server = uvicorn.Server(config)
        work = asyncio.Runner(loop_factory=config.get_loop_factory())
        thread = threading.Thread(target=lambda: _run(work, server, listener), daemon=True)
        thread.start()
        try:
            yield Served(listener.getsockname()[1], given, http)
        finally:
            server.should_exit = True
            thread.join(PATIENCE_S)


def _run(work: asyncio.Runner, server: uvicorn.Server, listener: socket.socket) -> None:
    with work:
        work.run(server.serve(sockets=[listener]))


def eventually(holds: Any, limit_s: float = PATIENCE_S) -> bool:
    """Wait for a real server, which needs real time; return whether it came so far."""
    end_s = time.monotonic() + limit_s
    while not holds():
        if time.monotonic() > end_s:
            return False
        time.sleep(0.01)
    return True
