"""Run a process that cannot outlive the supervisor: ``python -m pons.pdeathsig_exec …``.

The child asks the kernel for SIGTERM on its parent's death (prctl(2) PR_SET_PDEATHSIG) and then
checks that the parent still is who started it, which closes the gap before the request. It was
started in a session of its own, and weighs that for who sets no more than a nice of his own.
"""

from __future__ import annotations

import ctypes
import os
import runpy
import signal
import sys

from rank import nice_among_sessions

PR_SET_PDEATHSIG = 1
BEHIND = {"sim.camera": 5}
"""Whose sessions stand behind others, and how many steps of nice: a late picture is only late."""
USAGE = "usage: python -m pons.pdeathsig_exec PARENT_PID MODULE [ARGUMENT …]"


def bind_to_parent(parent_pid: int) -> bool:
    """Die with the parent from now on; False if it is gone already."""
    if sys.platform == "linux":
        libc = ctypes.CDLL(None, use_errno=True)
        if libc.prctl(PR_SET_PDEATHSIG, signal.SIGTERM, 0, 0, 0) != 0:
            raise OSError(ctypes.get_errno(), "prctl(PR_SET_PDEATHSIG)")
    return os.getppid() == parent_pid


def main(arguments: list[str]) -> int:
    """Bind to the parent, then become the module."""
    if len(arguments) < 2 or not arguments[0].isdecimal():
        print(USAGE, file=sys.stderr)
        return 2
    if not bind_to_parent(int(arguments[0])):
        return 1
    module = arguments[1]
    if module in BEHIND:
        nice_among_sessions(BEHIND[module])
    sys.argv = [module, *arguments[2:]]
    runpy.run_module(module, run_name="__main__", alter_sys=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
