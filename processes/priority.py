"""Set SCHED_FIFO priority and nice, among processes and among sessions.

Where Linux weighs sessions against each other (autogroup, sched(7)), a process's nice counts within
its session alone, and the session's own nice among sessions. Elsewhere, in a service or a container
too, the process's counts. So both are set. A refusal is logged, and the process goes on as before
(docs/adr/0026).
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

log = logging.getLogger(__name__)

AUTOGROUP = Path("/proc/self/autogroup")
MIN_NICE, MAX_NICE = -20, 19
TRIES, PAUSE_S = 5, 0.12
"""Without CAP_SYS_ADMIN the machine allows one autogroup write per 0.1 s (EAGAIN else), and our
processes start together."""


def set_fifo(priority: int) -> None:
    """Run the calling thread, and those it starts from now on, under SCHED_FIFO."""
    with _refusal_logged(f"SCHED_FIFO {priority} refused"):
        if sys.platform != "linux":
            raise OSError(errno.ENOSYS, f"not on {sys.platform}")
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(priority))


def add_nice(steps: int, *, own_session: bool = False) -> None:
    """Add to the nice of this process, and of its session; threads started later inherit it.

    Only a session's leader sets the session's nice: another's session may be a person's shell.

    Args:
        steps: how far behind the parent process; before it, if negative. Ten are a tenth of the
            weight, five a third.
        own_session: lead a new session first, so that the parent's session stays where it is. A
            Ctrl-C at the terminal reaches this process no longer. On Linux alone.
    """
    began, alone = session_nice(), os.getpriority(os.PRIO_PROCESS, 0)
    if own_session and sys.platform == "linux":
        with suppress(PermissionError):  # it leads its group already, as a shell's job does
            os.setsid()
    with _refusal_logged(f"nice {steps:+d} does not count in full"):
        os.nice(steps)
        if began is None and session_nice() is not None:
            began = alone  # a session without a nice of its own counts with its leader's
        _move_session(began, steps)


def add_session_nice(steps: int) -> None:
    """Add to the nice of the session alone, for a leader that sets its own nice itself."""
    with _refusal_logged(f"nice {steps:+d} does not count among sessions"):
        _move_session(session_nice(), steps)


def session_nice() -> int | None:
    """Return the nice of this process's session; None where the kernel keeps none."""
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
    wanted = min(max(MIN_NICE, began + steps), MAX_NICE)
    if session_nice() == wanted:
        return
    for left in reversed(range(TRIES)):
        try:
            _write_autogroup(str(wanted).encode())
        except BlockingIOError:
            if not left:
                raise
            time.sleep(PAUSE_S)
        else:
            return


@contextmanager
def _refusal_logged(refusal: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        log.warning("%s: %s", refusal, error.strerror)


def _write_autogroup(number: bytes) -> None:
    file = os.open(AUTOGROUP, os.O_WRONLY)  # a buffered file would hide the kernel's errno
    try:
        os.write(file, number)
    finally:
        os.close(file)
