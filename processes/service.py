"""Notify who supervises this process that its loop turns (sd_notify(3)): systemd, or `pons up`.

Does nothing without either.

The watchdog is fed by turning, not by being well: health is a row of the table, not a death.
"""

from __future__ import annotations

import os
import socket

WATCHDOG_PERIOD_S = 0.1
"""Often enough for any WatchdogSec= of a second, rare enough to cost nothing."""


def is_supervised() -> bool:
    """Say whether somebody starts this process again when it ends."""
    return "NOTIFY_SOCKET" in os.environ


class Service:
    """Speak to the service manager over its datagram socket; never blocks, never raises."""

    def __init__(self, address: str | None = None) -> None:
        path = os.environ.get("NOTIFY_SOCKET", "") if address is None else address
        self._socket = _connect(path)
        self._fed_s = float("-inf")

    def ready(self) -> None:
        """Notify systemd that start-up is over (READY=1)."""
        self._send(b"READY=1")

    def feed(self, now_s: float) -> None:
        """Feed systemd's watchdog, at most every WATCHDOG_PERIOD_S."""
        if self._socket is not None and now_s - self._fed_s >= WATCHDOG_PERIOD_S:
            self._fed_s = now_s
            self._send(b"WATCHDOG=1")

    def stopping(self) -> None:
        """Notify systemd that the process is leaving (STOPPING=1)."""
        self._send(b"STOPPING=1")

    def close(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    def _send(self, text: bytes) -> None:
        if self._socket is None:
            return
        try:
            self._socket.send(text)
        except OSError:
            return  # a manager that does not listen must cost the loop nothing


def _connect(path: str) -> socket.socket | None:
    if not path.startswith(("/", "@")):
        return None
    notify = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC)
    notify.setblocking(False)
    try:
        notify.connect("\0" + path[1:] if path.startswith("@") else path)
    except OSError:
        notify.close()
        return None
    return notify
