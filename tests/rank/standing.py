"""Read from /proc where processes stand among those who wait for a processor."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

from rank import MOST


class Stand(NamedTuple):
    """Say by what a process and its session are weighed."""

    nice: int
    session: int | None
    """None where the kernel weighs none."""

    def behind(self, steps: int) -> Stand:
        """Return who stands so far behind this one, in a session that left this one's."""
        session = None if self.session is None else min(self.session + steps, MOST)
        return Stand(min(self.nice + steps, MOST), session)


def stand_of(pid: int) -> Stand:
    """Read it: proc(5) and sched(7)."""
    nice = int(Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[16])
    group = Path(f"/proc/{pid}/autogroup")
    words = group.read_text().split() if group.exists() else []
    return Stand(nice, int(words[-1]) if words else None)


def leads_its_session(pid: int) -> bool:
    return os.getsid(pid) == pid
