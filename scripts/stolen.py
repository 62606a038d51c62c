"""Run a command and say whether its failure counts: ``python -m scripts.stolen COMMAND…``.

A hypervisor tells how long processors that had work to do were taken away (steal). A story in real
time that failed meanwhile says nothing: exit status 75 then, in place of 1. Where nothing was
taken, or nobody tells, a failure is a failure.
"""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

STAT = Path("/proc/stat")
TOO_MUCH = 0.05
"""Of all processors' time: 3 % and less were seen in hours in which no story failed for it."""
FAILED, SAYS_NOTHING = 1, 75
"""What pytest returns where tests failed; EX_TEMPFAIL of sysexits.h."""


class StealTicks(NamedTuple):
    """Count the ticks of all processors since the machine's start."""

    stolen: int
    all: int

    def share_since(self, before: StealTicks) -> float:
        """Return which share of the time since then was taken away, 0 to 1."""
        return (self.stolen - before.stolen) / max(1, self.all - before.all)


def main(command: list[str]) -> int:
    """Run it to its end; return its exit status, or 75."""
    before = current_steal()
    # Ctrl-C reaches the command too, for it is of one terminal; it cleans up by itself.
    ours = signal.signal(signal.SIGINT, lambda *_: None)
    code = subprocess.Popen(command).wait()
    signal.signal(signal.SIGINT, ours)
    code = code if code >= 0 else 128 - code  # as a shell says by what it was killed
    share = current_steal().share_since(before)
    if code != FAILED or not share > TOO_MUCH:
        return code
    print(f"stolen: the host took {share:.0%} of the processors meanwhile", flush=True)
    return SAYS_NOTHING


def current_steal() -> StealTicks:
    """Look at this machine's processors; where nobody tells, nothing is taken."""
    try:
        return read_steal(STAT.read_text("ascii"))
    except OSError:
        return StealTicks(0, 0)


def read_steal(stat: str) -> StealTicks:
    """Read /proc/stat's first line as proc(5) has it: user, nice, system, idle, …, steal."""
    ticks = [int(word) for word in stat.split("\n", 1)[0].split()[1:9]]
    return StealTicks(ticks[7] if len(ticks) == 8 else 0, sum(ticks))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
