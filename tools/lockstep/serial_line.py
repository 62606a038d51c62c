"""Be a serial line in memory, which can be spoilt as lines of metal are."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from random import Random
from typing import Final

from devices import PortTrouble

PATH: Final = Path("/dev/line")


class LineFault(StrEnum):
    """Name what a line does to bytes."""

    GARBAGE = "garbage"
    """Each byte is another one in one of ten cases."""
    CUT = "cut"
    """Runs of bytes are missing."""
    FLIPPED = "flipped"
    """One bit in a hundred bytes is another."""
    SILENT = "silent"
    HUNG_UP = "hung_up"
    WRONG_BAUD = "wrong_baud"


class SerialLine:
    """Carry bytes between a device and its reader as a port that can be pulled."""

    def __init__(self, seed: int) -> None:
        self.opened = 1
        self.trouble: PortTrouble | None = None
        self.fault: LineFault | None = None
        self.heard = b""
        self._coming = b""
        self._random = Random(f"line {seed}")

    def read(self) -> bytes:
        """Return the bytes that came."""
        data, self._coming = self._coming, b""
        return data

    def write(self, data: bytes) -> bool:
        """Take a whole message or nothing."""
        if self.trouble is not None:
            return False
        if self.fault not in (LineFault.WRONG_BAUD, LineFault.SILENT):
            self.heard += data
        return True

    def take_heard(self) -> bytes:
        """Return what the device was told."""
        data, self.heard = self.heard, b""
        return data

    def put(self, data: bytes) -> None:
        """Send bytes the host's way, as the line lets them."""
        if self.trouble is None:
            self._coming += self._spoil(data)

    def break_down(self, fault: LineFault | None) -> None:
        """Let one fault stand from now on, or none."""
        if fault is LineFault.HUNG_UP:
            self.trouble = PortTrouble("port_gone", PATH, "it was hung up")
            self._coming = b""
        elif self.trouble is not None:
            self.trouble = None
            self.opened += 1
        self.fault = fault

    def close(self) -> None:
        """Do nothing: it is memory."""

    def _spoil(self, data: bytes) -> bytes:
        random = self._random
        if self.fault is LineFault.SILENT:
            return b""
        if self.fault is LineFault.WRONG_BAUD:
            return random.randbytes(len(data))
        if self.fault is LineFault.GARBAGE:
            return bytes(random.randrange(256) if random.random() < 0.1 else b for b in data)
        if self.fault is LineFault.FLIPPED:
            flips = (random.random() < 0.01 for _ in data)
            return bytes(
                b ^ (1 << random.randrange(8)) if flip else b
                for b, flip in zip(data, flips, strict=True)
            )
        if self.fault is LineFault.CUT and data and random.random() < 0.3:
            start = random.randrange(len(data))
            return data[:start] + data[start + random.randint(1, 60) :]
        return data
