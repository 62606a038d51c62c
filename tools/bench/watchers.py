"""Listen to the planner's event stream as further pages do: sockets in a process of their own.

Run as ``python -m tools.bench.watchers URL COUNT``: opens the sockets, reads all that comes, says
``ready`` once each has its snapshot, and ends when its standard input does.
"""

from __future__ import annotations

import asyncio
import subprocess
import sys
from typing import TYPE_CHECKING

from websockets.asyncio.client import ClientConnection, connect

from processes.parent_death import child_command
from tools.bench.context import MeasurementFailure

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Self

PATIENCE_S = 5.0
CLOSE_S = 0.5
"""A socket with frames that nobody reads any more can't see the answer to its closing."""


class Watchers:
    """Hold such a process."""

    def __init__(self, url: str, count: int) -> None:
        """Describe it; entering the context starts it."""
        words = ["tools.bench.watchers", url, str(count)]
        self._command = child_command(*words)

    def __enter__(self) -> Self:
        self._process = subprocess.Popen(
            self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        said = self._process.stdout.readline() if self._process.stdout else b""
        if said.strip() != b"ready":
            self._end()
            raise MeasurementFailure(f"the watchers said {said!r} instead of ready")
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        try:
            self._process.communicate(timeout=PATIENCE_S)
        except subprocess.TimeoutExpired:
            self._end()

    def _end(self) -> None:
        """Kill it, and close what led to it and from it."""
        self._process.kill()
        self._process.communicate()


async def watch(url: str, count: int) -> None:
    """Open so many sockets and read until standard input ends."""
    sockets = [await connect(url, close_timeout=CLOSE_S) for _ in range(count)]
    for socket in sockets:
        await socket.recv()
    print("ready", flush=True)
    readers = [asyncio.create_task(_read(socket)) for socket in sockets]
    await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)
    for reader in readers:
        reader.cancel()
    await asyncio.gather(*readers, return_exceptions=True)
    await asyncio.gather(*(socket.close() for socket in sockets))


async def _read(socket: ClientConnection) -> None:
    async for _ in socket:
        pass  # read and let go


if __name__ == "__main__":
    asyncio.run(watch(sys.argv[1], int(sys.argv[2])))
