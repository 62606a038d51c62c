"""Serve a robot below a path of its own, as a reverse proxy of a house does. Knows no robot."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from pons.robot_processes import free_port
from tests.e2e.polling import until

BELOW = "/robot"
_OTHER = b"another program of this house"


class SubPathProxy:
    """Hand on what is asked below the path, which is taken off; count what is asked beside it."""

    def __init__(self, behind: int) -> None:
        self.port = free_port()
        self.beside: list[str] = []
        self._behind = behind
        self.loop = asyncio.new_event_loop()
        self.is_open = False

    @property
    def address(self) -> str:
        """Return where the page is."""
        return f"http://127.0.0.1:{self.port}{BELOW}/"

    def run(self) -> None:
        """Serve until the loop is stopped."""
        opening = asyncio.start_server(self._serve, "127.0.0.1", self.port)
        server = self.loop.run_until_complete(opening)
        self.is_open = True
        self.loop.run_forever()
        server.close()
        for task in asyncio.all_tasks(self.loop):
            task.cancel()
        self.loop.run_until_complete(asyncio.sleep(0))
        self.loop.close()

    async def _serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Serve one request, or one socket for as long as it is open."""
        try:
            head = await reader.readuntil(b"\r\n\r\n")
        except (asyncio.IncompleteReadError, ConnectionError):
            writer.close()
            return
        line, rest = head.split(b"\r\n", 1)
        method, path, version = line.split(b" ")
        if not path.startswith(BELOW.encode() + b"/"):
            self.beside.append(path.decode())
            length = b"Content-Length: %d\r\nConnection: close\r\n\r\n" % len(_OTHER)
            writer.write(b"HTTP/1.1 404 Not Found\r\n" + length + _OTHER)
            writer.close()
            return
        within = path.removeprefix(BELOW.encode())
        up_reader, up_writer = await asyncio.open_connection("127.0.0.1", self._behind)
        once = rest.replace(b"Connection: keep-alive", b"Connection: close")
        up_writer.write(b" ".join((method, within, version)) + b"\r\n" + once)
        await asyncio.gather(_hand_on(reader, up_writer), _hand_on(up_reader, writer))


async def _hand_on(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    try:
        while data := await reader.read(65_536):
            writer.write(data)
            await writer.drain()
    except ConnectionError:
        pass  # the other end has had enough
    finally:
        writer.close()


@contextmanager
def below_a_path(behind: int) -> Iterator[SubPathProxy]:
    """Serve what listens at a port of the loopback below a path."""
    proxy = SubPathProxy(behind)
    thread = threading.Thread(target=proxy.run)
    thread.start()
    try:
        until(lambda: proxy.is_open, 10.0, "the proxy listening")
        yield proxy
    finally:
        proxy.loop.call_soon_threadsafe(proxy.loop.stop)
        thread.join()
