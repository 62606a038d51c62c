"""Carry bytes between the service and a robot; cut them, hold them back, lose an answer."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from typing import Literal

Cut = Literal["refused", "held"]
OFFER = b"POST /v1/goals "


class Wire:
    """Be the way to one robot. What is held while it is cut arrives late, as on a real network."""

    def __init__(self, robot_port: int) -> None:
        self._robot_port = robot_port
        self._server: asyncio.Server | None = None
        self._cut: Cut | None = None
        self._whole = asyncio.Event()
        self._whole.set()
        self._open: set[asyncio.StreamWriter] = set()
        self.answers_to_lose = 0
        """So many offers reach the robot, and their answers do not come back."""

    async def start(self) -> int:
        """Listen, and return the port."""
        self._server = await asyncio.start_server(self._carry, "127.0.0.1", 0)
        port: int = self._server.sockets[0].getsockname()[1]
        return port

    async def cut(self, how: Cut, seconds: float) -> None:
        """Let nothing through for a time."""
        self._cut = how
        self._whole.clear()
        if how == "refused":
            for writer in list(self._open):
                writer.transport.abort()
        try:
            await asyncio.sleep(seconds)
        finally:
            self._cut = None
            self._whole.set()

    @property
    def is_cut(self) -> bool:
        """Return whether nothing gets through now."""
        return self._cut is not None

    def close(self) -> None:
        """End all connections."""
        if self._server is not None:
            self._server.close()
        for writer in list(self._open):
            writer.transport.abort()

    async def _carry(self, service: asyncio.StreamReader, back: asyncio.StreamWriter) -> None:
        writers = [back]
        try:
            if self._cut == "refused":
                return
            robot, on = await asyncio.open_connection("127.0.0.1", self._robot_port)
            writers.append(on)
            self._open.update(writers)
            lost = asyncio.Event()
            ways = (self._pump(service, on, lost), self._pump(robot, back, lost, is_answer=True))
            await asyncio.gather(*ways)
        except OSError:
            pass
        finally:
            for writer in writers:
                self._open.discard(writer)
                writer.transport.abort()

    async def _pump(
        self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, lost: asyncio.Event,
        *, is_answer: bool = False,
    ) -> None:  # fmt: skip
        with suppress(OSError):
            while data := await reader.read(65_536):
                await self._whole.wait()
                if not is_answer and self.answers_to_lose > 0 and data.startswith(OFFER):
                    self.answers_to_lose -= 1
                    lost.set()
                if is_answer and lost.is_set():
                    break
                writer.write(data)
                await writer.drain()
        writer.transport.abort() if is_answer else writer.close()
