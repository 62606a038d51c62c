"""Weigh more than other ordinary processes, where that is allowed. Knows nothing of what runs.

The planner's loop needs little, but soon: beside sixteen busy processes it waited for a processor
for 25 to 65 % of the time, and the bridge called it late (docs/adr/0026). A real-time rank is not
for a loop that may hang; a share cannot keep anybody else from running.
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

NICE = -10
"""Nine and a half times the weight of a process at nice 0."""
AUTOGROUP = Path("/proc/self/autogroup")
"""Where Linux groups processes by session, it is the group's nice that others are weighed against,
and a process's own counts within it."""


def take_larger_share() -> None:
    """Take it for this thread, for those that it starts, and for the session; refused, go on."""
    with contextlib.suppress(OSError):  # no right to it
        os.setpriority(os.PRIO_PROCESS, 0, NICE)
    with contextlib.suppress(OSError):  # no right to it, or no such groups
        AUTOGROUP.write_text(str(NICE), "ascii")
