"""Serve in a fork of a loaded process, and fork it again where the serving one is killed.

Loading the planner's modules takes seconds of a processor, ten on a small computer: longer than the
bridge waits for a planner before it disarms. The process that has loaded them therefore serves
nothing itself. It waits, with one thread and no file open, and a killed server is followed within
a few milliseconds by a fork that has everything loaded. Their memory is one memory until written.
"""

from __future__ import annotations

import gc
import logging
import os
import signal
import sys
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final, NoReturn

from processes.parent_death import bind_to_parent
from processes.service import Service

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

YOUNG_S: Final = 5.0
"""What is killed sooner may have died of its start: the process ends too, and whoever supervises
it waits longer before each next start."""
_ENDINGS: Final = frozenset({signal.SIGTERM, signal.SIGINT})

log = logging.getLogger(__name__)


class Standby:
    """One loaded process and the fork that serves. To be used where one thread runs."""

    def __init__(
        self, serve: Callable[[], int], young_s: float = YOUNG_S,
        monotonic_s: Callable[[], float] = time.monotonic,
    ) -> None:  # fmt: skip
        """Hold what serves; :meth:`run` starts it.

        Args:
            serve: returns the exit status; runs in a fork, where a signal has its usual effect.
            young_s: the age from which a killed server is followed by another [s].
            monotonic_s: tells the time [s].
        """
        self._serve, self._young_s, self._monotonic_s = serve, young_s, monotonic_s
        self._server, self._is_ending = 0, False

    def run(self) -> int:
        """Serve until the server ends by itself or is asked to; return its exit status.

        Where a signal ended it, this process ends by the same signal.
        """
        gc.freeze()  # a later look for garbage would write on, and so copy, each shared page
        for number in _ENDINGS:
            signal.signal(number, self._end)
        manager = Service()
        while True:
            began_s = self._monotonic_s()
            self._fork()
            status = os.waitstatus_to_exitcode(os.waitpid(self._server, 0)[1])
            lived_s = self._monotonic_s() - began_s
            if status >= 0:
                return status
            if self._is_ending or -status in _ENDINGS or lived_s < self._young_s:
                return _die_of(signal.Signals(-status))
            name = signal.Signals(-status).name
            log.warning("killed by %s after %.0f s; a fork that is loaded goes on", name, lived_s)
            manager.feed(self._monotonic_s())  # the fork has all the time that a silence may last

    def _fork(self) -> None:
        parent = os.getpid()
        signal.pthread_sigmask(signal.SIG_BLOCK, _ENDINGS)  # none may fall between fork and name
        try:
            if (server := os.fork()) == 0:
                self._become_server(parent)
            self._server = server
        finally:
            signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDINGS)

    def _become_server(self, parent: int) -> NoReturn:
        """Be the fork: nothing of the parent's stack is run on."""
        status = 1
        try:
            for number in _ENDINGS:
                signal.signal(number, signal.default_int_handler
                              if number is signal.SIGINT else signal.SIG_DFL)  # fmt: skip
            signal.pthread_sigmask(signal.SIG_UNBLOCK, _ENDINGS)
            status = self._serve() if bind_to_parent(parent) else 1
        except SystemExit as ended:
            status = ended.code if isinstance(ended.code, int) else 1
        except KeyboardInterrupt:
            status = 128 + signal.SIGINT
        except BaseException:
            log.exception("the server failed")
        finally:
            for stream in (sys.stdout, sys.stderr):
                with suppress(OSError, ValueError):
                    stream.flush()
            os._exit(status)

    def _end(self, number: int, _: FrameType | None) -> None:
        """Hand an ending on. From a terminal the server has its own; a second does no harm."""
        self._is_ending = True
        if self._server:
            os.kill(self._server, signal.SIGTERM)


def find_server(pid: int) -> int:
    """Return the process that serves for ``pid``: its fork where it is a standby, else itself."""
    folder = Path("/proc")
    with suppress(OSError):
        words = (folder / str(pid) / "cmdline").read_bytes()
        for child in (folder / str(pid) / "task" / str(pid) / "children").read_text().split():
            with suppress(OSError):
                if (folder / child / "cmdline").read_bytes() == words:
                    return int(child)
    return pid


def _die_of(number: signal.Signals) -> NoReturn:
    if number in _ENDINGS:
        signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)
    signal.pause()
    raise AssertionError(number)
