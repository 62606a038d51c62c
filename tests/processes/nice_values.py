"""Read the nice of processes and their sessions from /proc."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

from processes.priority import MAX_NICE


class Stand(NamedTuple):
    """Say by what a process and its session are weighed."""

    nice: int
    session: int | None
    """None where the kernel weighs none, and for what nobody gave a session since it booted."""

    def leaving(self) -> Stand:
        """Return how a session is weighed that just left this one's, before anybody weighs it."""
        return self._replace(session=0 if weighs_sessions() else None)

    def behind(self, steps: int) -> Stand:
        """Return who stands so far behind this one, in a session that left this one's."""
        if not weighs_sessions():
            return Stand(min(self.nice + steps, MAX_NICE), None)
        among = self.nice if self.session is None else self.session
        return Stand(min(self.nice + steps, MAX_NICE), min(among + steps, MAX_NICE))


def stand_of(pid: int) -> Stand:
    """Read it: proc(5) and sched(7)."""
    nice = int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[16])
    group = Path(f"/proc/{pid}/autogroup")
    words = group.read_text().split() if group.exists() else []
    return Stand(nice, int(words[-1]) if words else None)


def weighs_sessions() -> bool:
    """Say whether this kernel can weigh sessions against each other."""
    return Path("/proc/self/autogroup").exists()


def leads_its_session(pid: int) -> bool:
    return os.getsid(pid) == pid
