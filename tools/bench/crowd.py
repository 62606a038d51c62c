"""Crowd the planner's door as strangers might, bounded in number, from a process of its own.

Run as ``python -m tools.bench.crowd PORT KIND``: begins, says ``ready``, goes on until its
standard input
ends, and says what it did as JSON. Loopback alone.
"""

from __future__ import annotations

import asyncio
import json
import resource
import subprocess
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from websockets.asyncio.client import connect
from websockets.exceptions import WebSocketException

from processes.parent_death import child_command
from tools.bench.context import MeasurementFailure

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine
    from types import TracebackType
    from typing import Self

SILENT = 2_000
HEADER_BYTES = 60_000_000
GOALS_HZ = 50.0
SOCKETS = 20
SNAPSHOTS_HZ = 50.0
PATIENCE_S = 10.0
AGAIN_S = 1.0
"""How soon a closed connection comes again."""
HOST = "127.0.0.1"


class CrowdProcess:
    """Hold such a process."""

    def __init__(self, port: int, kind: str) -> None:
        """Describe it; entering the context starts it."""
        words = ["tools.bench.crowd", str(port), kind]
        self._command = child_command(*words)

    def __enter__(self) -> Self:
        self._process = subprocess.Popen(
            self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        said = self._process.stdout.readline() if self._process.stdout else b""
        if said.strip() != b"ready":
            self._process.kill()
            self._process.communicate()
            raise MeasurementFailure(f"the crowd said {said!r} instead of ready")
        return self

    def end(self) -> dict[str, Any]:
        """End it and return what it did."""
        said, _ = self._process.communicate(timeout=PATIENCE_S)
        found: dict[str, Any] = json.loads(said)
        return found

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._process.poll() is None:
            self._process.kill()
            self._process.communicate()


class Strangers:
    """Do what one kind does, and count it."""

    def __init__(self, port: int) -> None:
        self.port = port
        self.did: dict[str, int] = {}

    def count(self, what: str, many: int = 1) -> None:
        """Count what was done or met."""
        self.did[what] = self.did.get(what, 0) + many

    async def silent(self) -> None:
        """Open a connection, send the beginning of a request, wait; come again when closed."""
        await asyncio.gather(*(self._wait() for _ in range(SILENT)))

    async def _wait(self) -> None:
        while True:
            with suppress(OSError):
                reader, writer = await asyncio.open_connection(HOST, self.port)
                self.count("opened")
                writer.write(b"GET")
                await reader.read()
                writer.close()
            await asyncio.sleep(AGAIN_S)

    async def headers(self) -> None:
        """Send 60 MB of short headers and 60 MB of one, over and over."""
        line, long = b"a: b\r\n" * 10_000, b"a" * 60_000
        await asyncio.gather(self._head(b"", line), self._head(b"X: ", long))

    async def _head(self, first: bytes, piece: bytes) -> None:
        while True:
            with suppress(OSError):
                _, writer = await asyncio.open_connection(HOST, self.port)
                writer.write(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n" + first)
                for _ in range(HEADER_BYTES // len(piece)):
                    writer.write(piece)
                    await writer.drain()
                    self.count("megabytes_times_1000", len(piece) // 1_000)
                writer.close()
            await asyncio.sleep(AGAIN_S)

    async def goals(self) -> None:
        """Give 50 goals a second, each of 200 characters, on connections of their own."""
        number = 0
        async with asyncio.TaskGroup() as group:
            while True:
                number += 1
                group.create_task(self._goal(f"frobnicate the widget {number} " + "x" * 170))
                await asyncio.sleep(1.0 / GOALS_HZ)

    async def _goal(self, text: str) -> None:
        body = json.dumps({"text": text}).encode()
        head = (
            f"POST /v1/goals HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\n"
            f"Connection: close\r\nContent-Length: {len(body)}\r\n\r\n"
        )
        with suppress(OSError):
            reader, writer = await asyncio.open_connection(HOST, self.port)
            writer.write(head.encode() + body)
            self.count((await reader.read(12)).decode()[9:] or "closed")
            writer.close()

    async def snapshots(self) -> None:
        """Ask on 20 sockets for 50 snapshots a second each, and read all that comes."""
        await asyncio.gather(*(self._ask() for _ in range(SOCKETS)))

    async def _ask(self) -> None:
        while True:
            with suppress(OSError, WebSocketException):
                async with connect(f"ws://{HOST}:{self.port}/v1/events") as socket:
                    self.count("sockets")
                    reader = asyncio.create_task(self._read(socket))
                    try:
                        while not reader.done():
                            await socket.send('{"snapshot": true}')
                            await asyncio.sleep(1.0 / SNAPSHOTS_HZ)
                    finally:
                        reader.cancel()
            await asyncio.sleep(AGAIN_S)

    async def _read(self, socket: Any) -> None:
        async for frame in socket:
            self.count("snapshots", '"kind":"snapshot"' in frame[:40])


KINDS: dict[str, Callable[[Strangers], Coroutine[Any, Any, None]]] = {
    "2 000 silent connections": Strangers.silent,
    "60 MB of headers, twice": Strangers.headers,
    "50 goals/s": Strangers.goals,
    "20 sockets x 50 snapshots/s": Strangers.snapshots,
}


async def crowd(port: int, kind: str) -> dict[str, int]:
    """Crowd until standard input ends; return what was done."""
    strangers = Strangers(port)
    work = asyncio.create_task(KINDS[kind](strangers))
    await asyncio.sleep(2.0)  # all of them have come
    print("ready", flush=True)
    await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)
    work.cancel()
    await asyncio.gather(work, return_exceptions=True)
    return strangers.did


if __name__ == "__main__":
    hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(hard, 65_536), hard))
    print(json.dumps(asyncio.run(crowd(int(sys.argv[1]), sys.argv[2]))))
