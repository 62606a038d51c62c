"""Send bytes to another process through a pipe without ever waiting.

A write to a pipe larger than what is free is cut short (pipe(7)), so the rest of one piece is kept
and goes first next time. At most that one piece waits: memory does not grow behind a slow reader.
"""

from __future__ import annotations

import fcntl
import os
import struct
import termios

WANTED_BYTES = 1 << 20
"""Several seconds of ticks: a writer that waits for a slow disk loses nothing. The kernel's limit
for an ordinary user (/proc/sys/fs/pipe-max-size)."""

_F_SETPIPE_SZ = getattr(fcntl, "F_SETPIPE_SZ", None)


class Pipe:
    """Write to a non-blocking pipe whose pieces arrive whole or not at all."""

    def __init__(self, wanted_bytes: int = WANTED_BYTES) -> None:
        self._read_fd, self._write_fd = (
            os.pipe2(os.O_CLOEXEC) if hasattr(os, "pipe2") else os.pipe()
        )
        os.set_blocking(self._write_fd, False)
        self._rest = b""
        self.broken = False
        """The reader is gone; nothing will ever be taken again."""
        self.capacity_bytes = _enlarge(self._write_fd, wanted_bytes)

    @property
    def read_fd(self) -> int:
        """Return the end for the reader; it is not inherited unless duplicated."""
        return self._read_fd

    def release_reader(self) -> None:
        """Close our copy of the reading end, so that the reader's death shows as broken."""
        if self._read_fd >= 0:
            os.close(self._read_fd)
            self._read_fd = -1

    def send(self, piece: bytes) -> bool:
        """Send the piece whole and return True, or return False. Never blocks, never raises."""
        if not self.flush():
            return False
        sent = self._write(piece)
        if sent == 0:
            return False
        self._rest = piece[sent:]
        return True

    def flush(self) -> bool:
        """Send the rest of the piece before; return whether none is left."""
        if self._rest:
            self._rest = self._rest[self._write(self._rest) :]
        return not self._rest and not self.broken

    def waiting_bytes(self) -> int:
        """Return how many bytes the reader has not taken yet."""
        if self.broken:
            return 0
        answer = fcntl.ioctl(self._write_fd, termios.FIONREAD, b"\0\0\0\0")
        return int(struct.unpack("i", answer)[0]) + len(self._rest)

    def close(self) -> None:
        """Let the reader see the end."""
        self.release_reader()
        if self._write_fd >= 0:
            os.close(self._write_fd)
            self._write_fd = -1
        self.broken = True

    def _write(self, data: bytes) -> int:
        if self.broken:
            return 0
        try:
            return os.write(self._write_fd, data)
        except BlockingIOError:
            return 0
        except OSError:  # EPIPE: the reader died; SIGPIPE is ignored by the interpreter
            self.broken = True
            return 0


def _enlarge(fd: int, wanted_bytes: int) -> int:
    """Return the pipe's size after asking for more; a refusal leaves the kernel's own, 64 KiB."""
    if _F_SETPIPE_SZ is None:
        return 65_536
    try:
        return fcntl.fcntl(fd, _F_SETPIPE_SZ, wanted_bytes)
    except OSError:
        return fcntl.fcntl(fd, fcntl.F_GETPIPE_SZ)
