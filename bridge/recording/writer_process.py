"""Start the writing process and notice its death.

posix_spawn takes about a millisecond and copies no memory, which fits a tick; what a thread under
SCHED_FIFO starts is not under it (realtime.rights resets it on fork).
"""

from __future__ import annotations

import os
import signal
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire.robot import Recording

_ROOT = Path(__file__).resolve().parents[2]
_MAIN = (
    "import sys; sys.path.insert(0, sys.argv.pop(1)); "
    "from bridge.recording.__main__ import main; sys.exit(main(sys.argv[1:]))"
)
_ENDS_WITHIN_S = 3.0


@dataclass(frozen=True, slots=True)
class Sizes:
    """Bound the disk space of recordings."""

    rotate_bytes: int
    """Of one file."""
    cap_bytes: int
    """Of all together; the oldest go first."""

    @classmethod
    def of(cls, owner: Recording) -> Sizes:
        """Return the sizes that robot.toml sets."""
        return cls(owner.file_mb << 20, owner.total_mb << 20)


class WriterProcess:
    """Hold one running writing process and the pipe of its answers."""

    def __init__(
        self, folder: Path, boot: str, read_fd: int, sizes: Sizes, offset_s: float
    ) -> None:
        """Start it on the reading end of a pipe.

        Raises:
            OSError: the system has no process left for us.
        """
        words = [str(folder), boot, str(sizes.rotate_bytes), str(sizes.cap_bytes), repr(offset_s)]
        self._words_fd, said_fd = os.pipe()
        os.set_blocking(self._words_fd, False)
        try:
            self.pid = os.posix_spawn(
                sys.executable,
                [sys.executable, "-I", "-c", _MAIN, str(_ROOT), *words],
                dict(os.environ),
                file_actions=[
                    (os.POSIX_SPAWN_DUP2, read_fd, 0),
                    (os.POSIX_SPAWN_DUP2, said_fd, 1),
                ],
                # Blocked until it can ignore them itself: a Ctrl-C in its first moments is not its.
                setsigmask=[signal.SIGINT, signal.SIGTERM],
            )
        except OSError:
            os.close(self._words_fd)
            raise
        finally:
            os.close(said_fd)
        self._alive = True

    def words(self) -> bytes:
        """Return the process's answers since the last call; never waits."""
        try:
            return os.read(self._words_fd, 4096) if self._words_fd >= 0 else b""
        except BlockingIOError:
            return b""

    def alive(self) -> bool:
        """Return whether the process still runs; costs one system call."""
        if self._alive:
            self._alive = not self._reap()
        return self._alive

    def join(self, limit_s: float = _ENDS_WITHIN_S) -> bool:
        """Wait until it has written everything, and end it if it does not; after the loop only."""
        end_s = time.monotonic() + limit_s
        while self.alive() and time.monotonic() < end_s:
            time.sleep(0.01)
        self.forget()
        if self._alive:  # ending our group would not: the writer leads a session of its own
            os.kill(self.pid, signal.SIGKILL)
        return not self._alive

    def forget(self) -> None:
        """Close the pipe of its words."""
        if self._words_fd >= 0:
            os.close(self._words_fd)
            self._words_fd = -1

    def _reap(self) -> bool:
        try:
            pid, _ = os.waitpid(self.pid, os.WNOHANG)
        except ChildProcessError:
            return True
        return pid == self.pid
