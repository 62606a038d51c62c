"""Ask the system for a place among those who wait for a processor. Imports nothing of ours.

Where Linux weighs sessions against each other (autogroup, sched(7)), a process's nice counts within
its session alone, and the session's own nice among sessions. Elsewhere, in a service or a container
too, the process's counts. So both are set, and the one that counts does. What is refused is said in
the log, and all goes on as before (docs/adr/0026).
"""

from __future__ import annotations

import errno
import logging
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

log = logging.getLogger("rank")

AUTOGROUP = Path("/proc/self/autogroup")
LEAST, MOST = -20, 19
TRIES, PAUSE_S = 5, 0.12
"""Who is not root may weigh a session 0.1 s after anybody did (EAGAIN), and ours start together."""


def fifo(priority: int) -> None:
    """Run the calling thread, and those it starts from now on, under SCHED_FIFO."""
    with _going_on(f"SCHED_FIFO {priority} refused"):
        if sys.platform != "linux":
            raise OSError(errno.ENOSYS, f"not on {sys.platform}")
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))


def nice(steps: int, *, apart: bool = False) -> None:
    """Stand behind others, among processes and sessions; threads started later inherit it.

    Only a session's leader weighs it: any other's may be a person's shell.

    Args:
        steps: how far behind who started this process; before it, if negative. Ten are a tenth of
            the weight, five a third.
        apart: be a session of one's own, for who is started within one that stays where it is. A
            Ctrl-C at its terminal is heard no longer. On Linux alone.
    """
    began, alone = session_nice(), os.getpriority(os.PRIO_PROCESS, 0)
    if apart and sys.platform == "linux":
        with suppress(PermissionError):  # it leads its group already, as a shell's job does
            os.setsid()
    with _going_on(f"nice {steps:+d} does not count in full"):
        os.nice(steps)
        if began is None and session_nice() is not None:
            began = alone  # what nobody gave a session yet is weighed among them by its own nice
        _move_session(began, steps)


def nice_among_sessions(steps: int) -> None:
    """Let the session stand behind others, for a leader that chooses its own nice."""
    with _going_on(f"nice {steps:+d} does not count among sessions"):
        _move_session(session_nice(), steps)


def session_nice() -> int | None:
    """Return what this process's session is weighed by; None where none is."""
    try:
        words = AUTOGROUP.read_text("ascii").split()  # "/autogroup-25 nice 0", or nothing
    except OSError:
        return None
    return int(words[-1]) if words else None


def _move_session(began: int | None, steps: int) -> None:
    if began is None:
        return
    if os.getsid(0) != os.getpid():
        raise PermissionError(errno.EPERM, "another process leads this session")
    wanted = min(max(LEAST, began + steps), MOST)
    if session_nice() == wanted:
        return
    for left in reversed(range(TRIES)):
        try:
            _put(str(wanted).encode())
        except BlockingIOError:
            if not left:
                raise
            time.sleep(PAUSE_S)
        else:
            return


@contextmanager
def _going_on(refused: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        log.warning("%s: %s", refused, error.strerror)


def _put(number: bytes) -> None:
    file = os.open(AUTOGROUP, os.O_WRONLY)  # a buffered file would hide the kernel's errno
    try:
        os.write(file, number)
    finally:
        os.close(file)
