"""Be the far end of a serial line: a pseudo-terminal, found by a link of a fixed name.

A line that its user closed is made anew, as a USB device that was pulled gets another name: the
kernel keeps a terminal's "exclusive" for as long as either end is open, and the next user would be
told that it is busy.
"""

from __future__ import annotations

import contextlib
import errno
import fcntl
import os
import struct
import tty
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

READ_BYTES = 4096
_TIOCSPTLCK, _TIOCGPTN = 0x40045431, 0x80045430
_TCGETS2 = 0x802C542A
_TERMIOS2 = struct.Struct("<IIIIB19sII")


class TwinLine:
    """Read and write the far end; never blocks."""

    def __init__(self, link: Path) -> None:
        """Make the line; ``link`` leads to its near end.

        Raises:
            OSError: the link can't be made there.
        """
        self._link = link
        link.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        self._far = self._make()

    def read(self) -> bytes:
        """Return the bytes that came; none where none came or nobody is there."""
        try:
            return os.read(self._far, READ_BYTES)
        except BlockingIOError:
            return b""
        except OSError as error:
            if error.errno != errno.EIO:
                raise
            self.hang_up()
            return b""

    def write(self, data: bytes) -> None:
        """Send bytes; what finds no room is lost, as on a wire."""
        with contextlib.suppress(BlockingIOError):
            os.write(self._far, data)

    def baud(self) -> int:
        """Return the speed that the near end was set to; a terminal keeps one for both ends."""
        raw = bytearray(_TERMIOS2.size)
        fcntl.ioctl(self._far, _TCGETS2, raw)
        return int(_TERMIOS2.unpack(raw)[-1])

    def hang_up(self) -> None:
        """Pull the plug and put it in again: whoever has the line open finds it gone."""
        os.close(self._far)
        self._far = self._make()

    def close(self) -> None:
        """Take the line away."""
        os.close(self._far)
        self._link.unlink(missing_ok=True)

    def _make(self) -> int:
        far = os.open("/dev/ptmx", os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK | os.O_CLOEXEC)
        try:
            fcntl.ioctl(far, _TIOCSPTLCK, struct.pack("i", 0))
            (number,) = struct.unpack("i", fcntl.ioctl(far, _TIOCGPTN, struct.pack("i", 0)))
            tty.setraw(far)  # of both ends: else the near one would echo what it is sent
            fresh = self._link.with_name(f"{self._link.name}.new")
            fresh.unlink(missing_ok=True)
            fresh.symlink_to(f"/dev/pts/{number}")
            fresh.replace(self._link)
        except BaseException:
            os.close(far)
            raise
        return far
