"""Start a module as a process that cannot outlive its parent.

Run as ``python -m processes.parent_death PARENT_PID [OPTION …] MODULE [ARGUMENT …]``; the words
come from :func:`child_command` or :func:`worker_command`.

The process asks the kernel for a signal on its parent's death (prctl(2) PR_SET_PDEATHSIG) and then
checks that its parent still is the process that started it, which closes the gap before the
request. It is bound, and its nice set, before the module and its libraries are loaded: that takes
longer than many an answer.
"""

from __future__ import annotations

import ctypes
import os
import runpy
import signal
import sys
from collections.abc import Sequence
from itertools import takewhile

from processes.priority import add_nice, add_session_nice

MODULE = "processes.parent_death"
WORKER_NICE = 10
"""The bridge's loop and the planner's heartbeat share a worker's cores."""
KILL = "--kill"
OWN_SESSION_NICE = "--own-session-nice="
SESSION_NICE = "--session-nice="
PARENT_GONE = 1
USAGE = (
    f"usage: python -m {MODULE} PARENT_PID [{KILL}] [{OWN_SESSION_NICE}N | {SESSION_NICE}N] "
    "MODULE [ARGUMENT …]"
)
_PR_SET_PDEATHSIG = 1  # prctl(2)


def child_command(
    module: str, *arguments: str, session_nice: int = 0, parent_pid: int | None = None
) -> tuple[str, ...]:
    """Return how to run a module of ours that gets SIGTERM when this process dies.

    Args:
        module: run as ``__main__``.
        arguments: of that module.
        session_nice: how far its session, which it must lead, stands behind others.
        parent_pid: the process that it must not outlive; this one unless given.
    """
    options = [f"{SESSION_NICE}{session_nice}"] if session_nice else []
    parent = str(os.getpid() if parent_pid is None else parent_pid)
    return (sys.executable, "-m", MODULE, parent, *options, module, *arguments)


def worker_command(module: str, *arguments: str) -> tuple[str, ...]:
    """Return how to run a worker (:mod:`processes.worker_main`), killed when this process dies.

    It runs ten steps of nice behind this process and in a session of its own: the planner's share
    of the processor is for its loop.
    """
    options = (KILL, f"{OWN_SESSION_NICE}{WORKER_NICE}")
    return (sys.executable, "-m", MODULE, str(os.getpid()), *options, module, *arguments)


def module_in(command: Sequence[str]) -> str | None:
    """Return the module that a command line of this file runs; None where it is another's."""
    if MODULE not in command:
        return None
    words = command[command.index(MODULE) + 2 :]
    return next((word for word in words if not word.startswith("--")), None)


def bind_to_parent(parent_pid: int, ending: signal.Signals = signal.SIGKILL) -> bool:
    """Get a signal when the parent dies, from now on; False if it is gone already."""
    if sys.platform == "linux":
        libc = ctypes.CDLL(None, use_errno=True)
        if libc.prctl(_PR_SET_PDEATHSIG, ending, 0, 0, 0) != 0:
            raise OSError(ctypes.get_errno(), "prctl(PR_SET_PDEATHSIG)")
    return os.getppid() == parent_pid


def main(arguments: list[str]) -> int:
    """Bind to the parent, set nice, then become the module."""
    options = list(takewhile(lambda word: word.startswith("--"), arguments[1:]))
    rest = arguments[1 + len(options) :]
    if not rest or not arguments[0].isdecimal():
        sys.stderr.write(f"{USAGE}\n")
        return 2
    if not bind_to_parent(int(arguments[0]), signal.SIGKILL if KILL in options else signal.SIGTERM):
        return PARENT_GONE
    for option in options:
        name, _, steps = option.rpartition("=")
        if f"{name}=" == OWN_SESSION_NICE:
            add_nice(int(steps), own_session=True)
        elif f"{name}=" == SESSION_NICE:
            add_session_nice(int(steps))
    sys.argv = rest
    runpy.run_module(rest[0], run_name="__main__", alter_sys=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
