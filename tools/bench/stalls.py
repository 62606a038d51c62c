"""Notice when the host takes a processor away: ``python -m tools.bench.stalls CPU``.

One watcher per processor, above every rank of ours, asleep but for a look every 10 ms. What it saw
goes line by line to standard output: when it woke on the monotonic clock, and how late [s].
"""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

from bridge.realtime import MonotonicClock, Pacer, lock_memory, pin, take_fifo
from processes.parent_death import child_command

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Self

NOTED_S = 0.02
PERIOD_S = 0.01
PRIORITY = 90


class Stalls:
    """Watch every processor while the context lasts."""

    def __init__(self) -> None:
        self.seen: list[tuple[float, float]] = []
        """When each stall ended on the monotonic clock and how long it was [s]; after the end."""
        self._watchers: list[subprocess.Popen[str]] = []

    def __enter__(self) -> Self:
        for cpu in sorted(os.sched_getaffinity(0)):
            words = child_command("tools.bench.stalls", str(cpu))
            self._watchers.append(
                subprocess.Popen(
                    words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
                )
            )
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for watcher in self._watchers:
            watcher.kill()
            said, _ = watcher.communicate()
            for line in said.splitlines():
                at_s, late_s = line.split()
                self.seen.append((float(at_s), float(late_s)))

    def longest_before_s(self, at_s: float, within_s: float) -> float:
        """Return the longest stall that ended within a time before a moment [s]; 0 for none."""
        near = (late_s for ended_s, late_s in self.seen if 0.0 <= at_s - ended_s <= within_s)
        return max(near, default=0.0)


def main(arguments: list[str]) -> int:
    """Watch one processor until killed."""
    lock_memory()
    pin(int(arguments[0]))
    take_fifo(PRIORITY)
    pacer = Pacer(MonotonicClock(), PERIOD_S)
    while True:
        tick = pacer.wait()
        late_s = tick.late_s + tick.missed * PERIOD_S
        if late_s > NOTED_S:
            print(f"{tick.now_s:.4f} {late_s:.4f}", flush=True)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
