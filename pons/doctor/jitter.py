"""Measure how late this machine wakes a 100 Hz loop: the bridge's own, and cyclictest beside it.

Virtual machines stall for milliseconds by themselves; cyclictest in the same seconds tells which
lateness is the machine's and which is ours.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import threading
from dataclasses import dataclass

from bridge.realtime import MonotonicClock, Pacer, pin, take_fifo

PERIOD_S = 0.01
TICKS = 500
LATE_S = 5.0
"""How long cyclictest may take after our own loop has ended: all is over within 15 s."""
_CYCLIC = re.compile(r"Min:\s*(\d+).*Avg:\s*(\d+).*Max:\s*(\d+)")
HEAD = ("loop", "ticks", "p50 us", "p99 us", "max us", "missed", "scheduled")


@dataclass(frozen=True, slots=True)
class Lateness:
    """Hold one loop's lateness [us]; ``missed`` counts whole periods."""

    loop: str
    ticks: int
    p50_us: float | None
    p99_us: float | None
    max_us: float
    missed: int | None
    scheduled: str

    def cells(self) -> tuple[str, ...]:
        """Return the row as text; a dash for a figure that a tool does not give."""
        shown = ("-" if n is None else f"{n:.0f}" for n in (self.p50_us, self.p99_us, self.max_us))
        missed = "-" if self.missed is None else str(self.missed)
        return (self.loop, str(self.ticks), *shown, missed, self.scheduled)


def measure(priority: int, ticks: int = TICKS) -> list[Lateness]:
    """Run our loop, and cyclictest at the same time where it is installed."""
    other = _start_cyclictest(priority, ticks)
    rows: list[Lateness] = []
    thread = threading.Thread(target=lambda: rows.append(_ours(priority, ticks)))
    thread.start()
    thread.join()
    if other is not None:
        rows += _finish(other, ticks, priority)
    return rows


def _ours(priority: int, ticks: int) -> Lateness:
    pin(None)  # both of this thread alone, which ends with the measurement
    right = take_fifo(priority)
    pacer = Pacer(MonotonicClock(), PERIOD_S)
    late_us: list[float] = []
    missed = 0
    for _ in range(ticks):
        tick = pacer.wait()
        late_us.append((tick.late_s + tick.missed * PERIOD_S) * 1e6)
        missed += tick.missed
    late_us.sort()
    how = f"FIFO {priority}" if right.granted else "no real time"
    p99_us = late_us[min(ticks - 1, ticks * 99 // 100)]
    return Lateness("bridge", ticks, late_us[ticks // 2], p99_us, late_us[-1], missed, how)


def _start_cyclictest(priority: int, ticks: int) -> subprocess.Popen[str] | None:
    path = shutil.which("cyclictest")
    if path is None:
        return None
    words = ["-q", "-t1", "-p", str(priority), "-i", str(int(PERIOD_S * 1e6)), "-l", str(ticks)]
    return subprocess.Popen(
        [path, *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )


def _finish(process: subprocess.Popen[str], ticks: int, priority: int) -> list[Lateness]:
    try:
        said, _ = process.communicate(timeout=LATE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return []
    return cyclictest_row(said, ticks, priority)


def cyclictest_row(said: str, ticks: int, priority: int) -> list[Lateness]:
    """Read what cyclictest prints at its end; nothing where it was not allowed to run."""
    found = _CYCLIC.search(said)
    if found is None:
        return []
    _, average, most = map(float, found.groups())
    loop = f"cyclictest (mean {average:.0f})"
    return [Lateness(loop, ticks, None, None, most, None, f"FIFO {priority}")]


def table(rows: list[Lateness]) -> str:
    """Return the rows aligned."""
    lines = [HEAD, *(row.cells() for row in rows)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(HEAD))]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )
