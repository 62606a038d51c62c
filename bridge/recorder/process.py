"""Start the writer process and notice its death. Owns the child; knows nothing of lines.

posix_spawn takes about a millisecond and copies no memory, which fits a tick of a robot that has no
torque; nobody starts a writer while the robot is powered.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from pathlib import Path

from bridge.recorder import writer

ROTATE_BYTES = 64 << 20
CAP_BYTES = 1 << 30
"""All recordings together; the oldest go first."""
_ENDS_WITHIN_S = 3.0


class WriterProcess:
    """Be the handle of one running writer."""

    def __init__(self, folder: Path, boot: str, read_fd: int, *, rotate_bytes: int = ROTATE_BYTES,
                 cap_bytes: int = CAP_BYTES) -> None:  # fmt: skip
        """Start it on the reading end of a pipe.

        Raises:
            OSError: the system has no process left for us.
        """
        script = str(Path(writer.__file__).resolve())
        words = [str(folder), boot, str(rotate_bytes), str(cap_bytes)]
        self.pid = os.posix_spawn(
            sys.executable,
            [sys.executable, "-I", "-S", script, *words],
            dict(os.environ),
            file_actions=[(os.POSIX_SPAWN_DUP2, read_fd, 0)],
            # Blocked until it can ignore them itself: a Ctrl-C in its first moments is not its.
            setsigmask=[signal.SIGINT, signal.SIGTERM],
        )
        self._alive = True

    def alive(self) -> bool:
        """Say whether it still runs; costs one system call."""
        if self._alive:
            self._alive = not self._reap()
        return self._alive

    def join(self, limit_s: float = _ENDS_WITHIN_S) -> bool:
        """Wait until it has written everything; for use after the loop."""
        end_s = time.monotonic() + limit_s
        while self.alive() and time.monotonic() < end_s:
            time.sleep(0.01)
        return not self._alive

    def _reap(self) -> bool:
        try:
            pid, _ = os.waitpid(self.pid, os.WNOHANG)
        except ChildProcessError:
            return True
        return pid == self.pid
