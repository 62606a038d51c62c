"""Stop by ``POST /v1/stop`` on a new connection while strangers crowd the planner's door.

From the connection's begin to the answer that the bridge has confirmed. The crowd is a process of
its own (tools.bench.crowd): connections that say nothing and come again when closed, long headers,
goals at 50 a second, sockets that ask for snapshots. A stop that is not confirmed within 2 s counts
as lost.
"""

from __future__ import annotations

import os
import time
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

from pons.http import PlannerDown, PlannerProblem, call
from tools.bench.crowd import KINDS, CrowdProcess
from tools.bench.figures import none_in
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from tools.bench.context import BenchLab

NAME = "stop_at_the_door"
TITLE = "stop by HTTP while strangers crowd the door -> confirmed"
LONG_ONLY = False
GOAL = "p99 <= 150"
QUICK, LONG = 25, 100
LIMIT_S = 2.0
MOST_LOST = 20
"""So many lost ones say enough."""
PAUSE_S = 0.1


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take 25 stops under each crowd, in a long run 100."""
    runs = list(lab.slices("robot", 1, lambda _: _run(lab)))
    rows = []
    for name in ("nobody", *KINDS):
        took_ms = [value for run in runs for value in run[name]["took_ms"]]
        lost = sum(run[name]["lost"] for run in runs)
        did = "; ".join(str(run[name]["crowd"]) for run in runs)
        note = f"{lost} of {len(took_ms) + lost} not confirmed; {none_in(len(took_ms))}" if (
            lost
        ) else f"all {len(took_ms)} confirmed"  # fmt: skip
        rows.append(row_of(name, "ms", GOAL, took_ms, f"{note}; {did}", valid=lost == 0))
    return rows


def _run(lab: BenchLab) -> dict[str, Any]:
    count = lab.count(QUICK, LONG)
    with lab.folder() as home, BenchRobot(home, "two_room") as robot:
        robot.make_ready()
        found: dict[str, Any] = {}
        for name in ("nobody", *KINDS):
            lab.say(name)
            with ExitStack() as stack:
                crowd = stack.enter_context(CrowdProcess(robot.settings.port, name)) if (
                    name != "nobody"
                ) else None  # fmt: skip
                took_ms, lost = _stops(robot, count)
                said = crowd.end() if crowd is not None else {}
            rss_mb = _rss_mb(robot.pid("planner"))
            slowest = max(took_ms, default=0.0)
            lab.say(f"{name}: {len(took_ms)} confirmed, {lost} lost, slowest {slowest:.0f} ms")
            found[name] = {
                "took_ms": took_ms, "lost": lost,
                "crowd": {**said, "rss_mb": rss_mb, "load": round(os.getloadavg()[0], 1)},
            }  # fmt: skip
        return found


def _stops(robot: BenchRobot, count: int) -> tuple[list[float], int]:
    took_ms: list[float] = []
    lost = 0
    for _ in range(count):
        began_s = time.monotonic()
        try:
            answer = call(robot.settings, "POST", "/v1/stop", {"source": "bench"}, LIMIT_S)
        except (PlannerDown, PlannerProblem):
            answer = {}
        if answer.get("confirmed"):
            took_ms.append((time.monotonic() - began_s) * 1e3)
        else:
            lost += 1
        if lost >= MOST_LOST:
            break
        time.sleep(PAUSE_S)
    return took_ms, lost


def _rss_mb(pid: int) -> int:
    with open(f"/proc/{pid}/statm", encoding="ascii") as file:  # noqa: PTH123  # no path of ours
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1_000_000
