"""Carry bytes to a broker and back, late or not at all: a broker that is slow, or never answers."""

from __future__ import annotations

import socket
import threading
import time
from contextlib import suppress
from typing import Self


class SlowLine:
    """Listen before a broker; what it answers comes ``late_s`` later, or not while it is shut."""

    def __init__(self, broker_port: int) -> None:
        self._broker_port = broker_port
        self._door = socket.create_server(("127.0.0.1", 0))
        self.port: int = self._door.getsockname()[1]
        self.late_s = 0.0
        self.is_shut = False
        self._ends = False
        self._open: list[socket.socket] = []
        self._threads = [threading.Thread(target=self._take)]

    def _take(self) -> None:
        while not self._ends:
            with suppress(OSError):
                near, _ = self._door.accept()
                self._open.append(near)
                far = socket.create_connection(("127.0.0.1", self._broker_port))
                self._open.append(far)
                for pair, answers in (((near, far), False), ((far, near), True)):
                    carrier = threading.Thread(target=self._carry, args=(*pair, answers))
                    carrier.start()
                    self._threads.append(carrier)

    def _carry(self, source: socket.socket, target: socket.socket, answers: bool) -> None:
        with suppress(OSError):
            while data := source.recv(65_536):
                if answers:
                    time.sleep(self.late_s)
                while answers and self.is_shut and not self._ends:
                    time.sleep(0.05)
                target.sendall(data)
        with suppress(OSError):
            target.shutdown(socket.SHUT_RDWR)

    def __enter__(self) -> Self:
        self._threads[0].start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ends = True
        with suppress(OSError):  # wakes who waits for a client
            socket.create_connection(("127.0.0.1", self.port)).close()
        self._threads[0].join()
        self._door.close()
        for each in self._open:
            each.close()
        for thread in self._threads:
            thread.join()
