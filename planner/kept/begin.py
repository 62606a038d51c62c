"""Begin a kept process: ``python -m planner.kept.begin PARENT_PID MODULE [ARGUMENT …]``.

It is bound to its parent and steps back before the module and its libraries are loaded: that takes
longer than many an answer. Runs ten steps of nice behind the planner, because the bridge's loop and
the planner's heartbeat share its cores, and apart: the planner's share is for its loop.
"""

from __future__ import annotations

import runpy
import sys

from planner.kept.bound import bind_to_parent
from planner.kept.child import REFUSED
from rank import nice

NICE = 10


def main(arguments: list[str]) -> int:
    """Bind to the parent, step back, then become the module."""
    parent_pid, module, *told = arguments
    if not bind_to_parent(int(parent_pid)):
        return REFUSED
    nice(NICE, apart=True)
    sys.argv = [module, *told]
    runpy.run_module(module, run_name="__main__", alter_sys=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
