"""Keep a serial port open though its device comes and goes, without ever making its user wait.

Opening and closing may take a driver's while, and closing may wait for bytes to leave; both happen
on a thread of this file's own. Whoever reads and writes sees an open port, or none.
"""

from __future__ import annotations

import logging
import threading
from typing import TYPE_CHECKING

from devices.serial_port import PortTrouble, SerialPort

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

log = logging.getLogger("devices")

RETRY_S = 0.25
PASSING = frozenset({"port_missing", "port_busy", "port_gone"})
"""What may mend by itself: a cable, another program's end. The rest needs a person first."""


class LastingPort:
    """Read and write a port that is opened anew whenever it went."""

    def __init__(
        self,
        path: Path,
        baud: int,
        *,
        dtr: bool | None = None,
        guard: Callable[[Path], None] | None = None,
    ) -> None:
        """Try to open the port once, and from then on in the background.

        Args:
            path: of the port.
            baud: of the line.
            dtr: set at each opening, as SerialPort says.
            guard: is given the path before each opening, and raises a PortTrouble to refuse it.

        Raises:
            PortTrouble: it can't be used, and waiting would not mend it.
        """
        self._path, self._baud, self._dtr, self._guard = path, baud, dtr, guard
        self._port: SerialPort | None = None
        self._gone: SerialPort | None = None
        self.trouble: PortTrouble | None = None
        """Why the port is away; None while it is open."""
        self._ending = threading.Event()
        self._wanted = threading.Event()
        self.opened = 0
        """How often it was opened; a rise says that what is behind may be another."""
        try:
            self._open()
        except PortTrouble as trouble:
            if trouble.code not in PASSING:
                raise
            self._say(trouble)
            self._wanted.set()
        self._thread = threading.Thread(target=self._serve, name="lasting-port", daemon=True)
        self._thread.start()

    def read(self) -> bytes:
        """Return the bytes that came; none where the port is away."""
        port = self._port
        if port is None:
            return b""
        try:
            return port.read()
        except PortTrouble as trouble:
            self._lose(port, trouble)
            return b""

    def write(self, data: bytes) -> bool:
        """Give the port a whole message or nothing; tell whether it took it."""
        port = self._port
        if port is None:
            return False
        try:
            return port.write(data)
        except PortTrouble as trouble:
            self._lose(port, trouble)
            return False

    def close(self) -> None:
        """Give the port back and end the thread."""
        self._ending.set()
        self._wanted.set()
        self._thread.join()
        if self._port is not None:
            self._port.close()
            self._port = None

    def _lose(self, port: SerialPort, trouble: PortTrouble) -> None:
        self._say(trouble)
        self._port, self._gone = None, port
        self._wanted.set()

    def _serve(self) -> None:
        while True:
            self._wanted.wait()
            if self._gone is not None:
                self._gone.close()
                self._gone = None
            if self._ending.is_set():
                return
            self._wanted.clear()
            try:
                self._open()
            except PortTrouble as trouble:
                self._say(trouble)
                self._wanted.set()
                self._ending.wait(RETRY_S)

    def _open(self) -> None:
        if self._guard is not None:
            self._guard(self._path)
        port = SerialPort(self._path, self._baud, dtr=self._dtr)
        if self.trouble is not None:
            log.warning("port_back: %s", self._path)
            self.trouble = None
        self._port = port
        self.opened += 1  # last: whoever greets the device for it finds the port there

    def _say(self, trouble: PortTrouble) -> None:
        """Log a trouble once, not four times a second."""
        if self.trouble is None or trouble.code != self.trouble.code:
            log.warning("%s", trouble)
        self.trouble = trouble
