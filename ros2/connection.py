"""Hold a websocket to the rosbridge server of robot.toml: dial, read, send, dial anew.

What would have to wait is not sent: a command that stands in a queue is older than the next.
"""

from __future__ import annotations

import asyncio
import logging
import socket
import time
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, WebSocketException
from websockets.frames import CloseCode

from processes.backoff import Backoff
from ros2 import rosbridge
from ros2.transport import MOST_BYTES
from ros2.trouble import Ros2Trouble

if TYPE_CHECKING:
    from collections.abc import Callable

    from ros2.operations import Request
    from ros2.transport import GraphListener, LinkMessages

log = logging.getLogger("ros2")

DIAL_S = 3.0
SILENT_S = 6.0
"""The graph is asked every 2 s: a server that says nothing for so long is not there any more."""
FIRST_PAUSE_S, LONGEST_PAUSE_S = 0.25, 2.0
PORTS = {"ws": 80, "wss": 443}


class RosbridgeConnection:
    """Dial one server for as long as the process lives."""

    def __init__(
        self,
        url: str,
        link: GraphListener,
        publish: Callable[[LinkMessages], None],
        most_bytes: int = MOST_BYTES,
    ) -> None:
        self._most_bytes = most_bytes
        self._url, self._link, self._publish = url, link, publish
        self._socket: ClientConnection | None = None
        self._heard_s = 0.0

    async def serve(self) -> None:
        """Dial and read for ever."""
        pause = Backoff(FIRST_PAUSE_S, LONGEST_PAUSE_S, steady_s=5.0)
        while True:
            began_s = time.monotonic()
            try:
                await self._serve_once()
                trouble = Ros2Trouble("ros2_server_gone", f"{self._url} ended the connection")
            except (OSError, WebSocketException, TimeoutError, ValueError) as error:
                trouble = self._trouble_of(error)
            self._socket = None
            self._link.close(trouble)
            await asyncio.sleep(pause.pause_after(time.monotonic() - began_s))

    def has_room(self) -> bool:
        """Return whether what is sent now leaves now."""
        opened = self._socket
        return opened is not None and opened.transport.get_write_buffer_size() == 0

    async def send(self, request: Request) -> bool:
        """Send a request; False where there is no connection."""
        opened = self._socket
        if opened is None:
            return False
        try:
            await opened.send(rosbridge.write(request))
        except WebSocketException:
            return False
        return True

    async def drop_if_silent(self, now_s: float) -> None:
        """End a connection whose server says nothing, as one does that lost its power."""
        opened = self._socket
        if opened is not None and now_s - self._heard_s > SILENT_S:
            log.warning("%s says nothing for %.0f s: dialled anew", self._url, SILENT_S)
            self._heard_s = now_s
            opened.transport.abort()

    def _trouble_of(self, error: Exception) -> Ros2Trouble:
        ours = error.sent if isinstance(error, ConnectionClosed) else None
        if ours is not None and ours.code == CloseCode.MESSAGE_TOO_BIG:
            found = f"{self._url} sent a message of more than {self._most_bytes} bytes"
            return Ros2Trouble("ros2_message_too_large", found)
        code = "ros2_server_gone" if self._socket else "ros2_no_server"
        return Ros2Trouble(code, f"{self._url}: {str(error) or type(error).__name__}")

    async def _serve_once(self) -> None:
        raw = await asyncio.to_thread(_dial, self._url)
        async with connect(
            self._url,
            sock=raw,  # ours: no proxy of the environment stands between a base and its bridge
            compression=None,
            max_size=self._most_bytes,
            open_timeout=DIAL_S,
            close_timeout=0.5,
            ping_interval=None,  # the graph is asked instead, which proves more
        ) as opened:
            now_s = time.monotonic()
            self._heard_s = now_s
            self._socket = opened
            self._link.open(now_s)
            log.info("reached %s", self._url)
            async for frame in opened:
                now_s = time.monotonic()
                self._heard_s = now_s
                self._publish(self._link.hear(rosbridge.read(frame), now_s))


def _dial(url: str) -> socket.socket:
    parts = urlsplit(url)
    host, port = parts.hostname or "", parts.port or PORTS[parts.scheme]
    raw = socket.create_connection((host, port), timeout=DIAL_S)
    raw.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    raw.setblocking(False)
    return raw
