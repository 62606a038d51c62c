"""Stop by HTTP, by ``pons stop`` and by a page's open socket, while something is in the way.

Strangers crowd the planner's door (tools.bench.crowd), the disk is full, the home unwritable, or a
planner hangs. From the connection's begin, the process's start or the frame's sending to the
word that the bridge has confirmed; a stop without that word is lost. A hung planner answers
nobody: there the shell's direct way is asked alone.
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from pons.settings import CHECKOUT
from tools.bench.chaos.faults import full_disk
from tools.bench.chaos.house import mount, private_mounts, read_only, unmount
from tools.bench.confirmation import CLI, WAYS
from tools.bench.crowd import KINDS, CrowdProcess
from tools.bench.figures import none_in, percentile
from tools.bench.processes import rss_mb
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.bench.confirmation import Stop
    from tools.bench.context import BenchLab

NAME = "stop_at_the_door"
TITLE = "stop by HTTP, CLI and page with something in the way -> confirmed"
LONG_ONLY = False
GOAL, DIRECT_GOAL = "p99 <= 150", "p99 <= 1500"
QUICK, LONG = 25, 100
MOST_LOST = 20
"""So many lost ones say enough."""
PAUSE_S = 0.1
STARTS = 5
NOBODY, FULL, READ_ONLY, HUNG = "nobody", "full disk", "read-only home", "hung planner"
NEED_MOUNTS = (FULL, READ_ONLY)
CONDITIONS = (NOBODY, *KINDS, FULL, READ_ONLY, HUNG)
DISK_MB = 256
LOADED = "import pons.__main__, pons.stop, pons.settings"
"""What ``pons stop`` has done before it can speak."""


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take 25 stops by each way under each condition, in a long run 100; a robot for each."""
    unmounted = private_mounts()
    rows = []
    for name in CONDITIONS:
        if name in NEED_MOUNTS and unmounted:
            lab.say(f"{name}: skipped, {unmounted}")
            rows.append(ReportRow(name, "", GOAL, value="skipped", note=unmounted))
            continue
        found = list(lab.slices(name, 1, lambda _, name=name: _run(lab, name)))  # type: ignore[misc]  # the default binds the loop's name
        rows += [row for run in found for row in _rows(name, run)]
    return rows


def ways_of(name: str) -> tuple[str, ...]:
    """Return the ways by which a stop can be said under a condition."""
    return (CLI,) if name == HUNG else tuple(WAYS)


def _rows(name: str, run: dict[str, Any]) -> list[ReportRow]:
    rows = []
    for way in ways_of(name):
        took_ms, lost = run[way]["took_ms"], run[way]["lost"]
        n = len(took_ms)
        note = f"{lost} of {n + lost} not confirmed; {none_in(n)}" if lost else f"all {n} confirmed"
        if way == CLI:
            note += f"; of it {run['start_ms']:.0f} ms until it is loaded (p50 of {STARTS})"
        goal = DIRECT_GOAL if name == HUNG else GOAL
        rows.append(row_of(f"{name}: {way}", "ms", goal, took_ms, note, valid=lost == 0))
    rows[-1] = replace(rows[-1], note=f"{rows[-1].note}; {run['beside']}")
    return rows


def _run(lab: BenchLab, name: str) -> dict[str, Any]:
    count = lab.count(QUICK, LONG)
    with ExitStack() as stack:
        home = stack.enter_context(lab.folder())
        if name in NEED_MOUNTS:
            mount("tmpfs", home, "tmpfs", 0, f"size={DISK_MB}m,mode=755")
            stack.callback(unmount, home)
        robot = stack.enter_context(BenchRobot(home, "two_room"))
        robot.make_ready()
        stops = {way: stack.enter_context(WAYS[way](robot.settings)) for way in ways_of(name)}
        beside: dict[str, Any] = {}
        found: dict[str, Any] = {"beside": beside}
        with _in_the_way(robot, name, beside):
            found["start_ms"] = _start_ms()
            for way, stop in stops.items():
                took_ms, lost = _stops(stop, count)
                slowest = max(took_ms, default=0.0)
                lab.say(f"{name}, {way}: {len(took_ms)} confirmed, {lost} lost, {slowest:.0f} ms")
                found[way] = {"took_ms": took_ms, "lost": lost}
        beside["rss_mb"] = round(rss_mb(robot.pid("planner")))
        beside["load"] = round(os.getloadavg()[0], 1)
        return found


@contextmanager
def _in_the_way(robot: BenchRobot, name: str, beside: dict[str, Any]) -> Iterator[None]:
    """Put a condition in force; tell what it was like."""
    home = robot.settings.home
    if name in KINDS:
        with CrowdProcess(robot.settings.port, name) as crowd:
            yield
            beside.update(crowd.end())
    elif name == FULL:
        with full_disk(home):
            yield
            beside["free_bytes"] = shutil.disk_usage(home).free
    elif name == READ_ONLY:
        with read_only(home):
            yield
    elif name == HUNG:
        planner = robot.children["planner"]
        planner.signal(signal.SIGSTOP)
        try:
            yield
        finally:
            planner.signal(signal.SIGCONT)
    else:
        yield


def _stops(stop: Stop, count: int) -> tuple[list[float], int]:
    took_ms: list[float] = []
    lost = 0
    for _ in range(count):
        took_s = stop()
        if took_s is None:
            lost += 1
        else:
            took_ms.append(took_s * 1e3)
        if lost >= MOST_LOST:
            break
        time.sleep(PAUSE_S)
    return took_ms, lost


def _start_ms() -> float:
    """Return how long a process takes to load what ``pons stop`` needs [ms], median of some."""
    took_ms = []
    for _ in range(STARTS):
        began_s = time.monotonic()
        subprocess.run([sys.executable, "-c", LOADED], cwd=CHECKOUT, check=True)
        took_ms.append((time.monotonic() - began_s) * 1e3)
    return percentile(took_ms, 0.5)
