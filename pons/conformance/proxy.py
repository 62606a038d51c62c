"""Stand between a brain and the bridge as a broken link does: deliver, keep back, or read no more.

Owns a listening socket on a free port of the loopback and one thread per direction.
"""

from __future__ import annotations

import contextlib
import socket
import threading
from enum import StrEnum

CHUNK = 65_536
POLL_S = 0.005


class ProxyWay(StrEnum):
    """Name the fate of messages from the brain, and of those to it."""

    OPEN = "open"
    KEPT = "kept"
    """Accepted and kept back; delivered all at once when open again. The brain hears all."""
    STALLED = "stalled"
    """Neither side is read any more, and no connection is closed: a half-open link."""


class Proxy:
    """Forward one port to one door until closed."""

    def __init__(self, door: str) -> None:
        """Listen.

        Args:
            door: path of a unix socket, or host:port.
        """
        self.way = ProxyWay.OPEN
        self._door = door
        self._ending = threading.Event()
        self._sockets: list[socket.socket] = []
        self._listener = socket.create_server(("127.0.0.1", 0))
        self._listener.settimeout(0.1)
        self._threads = [threading.Thread(target=self._accept, daemon=True)]
        self._threads[0].start()

    @property
    def address(self) -> str:
        """Return host:port to dial."""
        return f"127.0.0.1:{self._listener.getsockname()[1]}"

    def close(self) -> None:
        """End every connection and thread."""
        self._ending.set()
        for thread in self._threads:
            thread.join(2.0)
        for one in (self._listener, *self._sockets):
            with contextlib.suppress(OSError):
                one.close()

    def _accept(self) -> None:
        while not self._ending.is_set():
            with contextlib.suppress(TimeoutError):
                brain, _ = self._listener.accept()
                bridge = self._dial()
                self._sockets += [brain, bridge]
                for pair in ((brain, bridge, True), (bridge, brain, False)):
                    thread = threading.Thread(target=self._forward, args=pair, daemon=True)
                    self._threads.append(thread)
                    thread.start()

    def _dial(self) -> socket.socket:
        host, colon, port = self._door.rpartition(":")
        if colon and port.isdecimal() and "/" not in self._door:
            return socket.create_connection((host, int(port)))
        bridge = socket.socket(socket.AF_UNIX)
        bridge.connect(self._door)
        return bridge

    def _forward(self, source: socket.socket, sink: socket.socket, to_bridge: bool) -> None:
        """Carry one direction."""
        kept: list[bytes] = []
        source.settimeout(POLL_S)
        with contextlib.suppress(OSError):
            while not self._ending.is_set():
                way = self.way
                if way is ProxyWay.STALLED:
                    self._ending.wait(POLL_S)
                    continue
                if kept and way is ProxyWay.OPEN:
                    sink.sendall(b"".join(kept))
                    kept.clear()
                try:
                    data = source.recv(CHUNK)
                except TimeoutError:
                    continue
                if not data and not kept:
                    return
                if not data:  # the sender is gone; what it said still waits to be delivered
                    self._ending.wait(POLL_S)
                elif self.way is ProxyWay.OPEN or (self.way is ProxyWay.KEPT and not to_bridge):
                    sink.sendall(data)
                else:  # asked again: the way may have changed while we read
                    kept.append(data)
