"""Stop a driving robot by API, CLI and the page's WebSocket while every core is busy.

From the moment the request is handed to its socket (by the CLI: from the moment at which its loaded
process is about to) to the first slower command that left the bridge for it. What holds the client
itself up meanwhile is in the figures.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from bisect import bisect_left
from contextlib import contextmanager
from random import Random
from typing import TYPE_CHECKING, Any

from pons.http import PlannerDown, PlannerProblem, call
from tools.bench.context import MeasurementFailure, until
from tools.bench.figures import none_in
from tools.bench.lateness import stress_cores
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import SLOW, BenchRobot
from tools.bench.stop_requests import WAYS, Note, notes_of, noting
from wire import Mode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.bench.context import BenchLab

NAME = "stop_under_load"
TITLE = "stop under full CPU load -> first slower command"
LONG_ONLY = True
GOAL, GOAL_MS = "p99 <= 150", 150.0
PER_SLICE = 20
ORDERS = ("go to the living room", "go to the kitchen")
OPEN = frozenset({"running", "planning", "paused"})
MOVING_MPS = 0.2
DRIVE_S = 20.0
WITHIN_S = 3.0
SLOWER_MPS = 1e-4


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take 60 of each in a long run."""
    rows = []
    for way in WAYS:
        runs = list(lab.slices(way, lab.count(1, 3), lambda index, way=way: _run(lab, way, index)))  # type: ignore[misc]  # the default binds the loop's way
        took_ms = [value for run in runs for value in run["took_ms"]]
        lost, moot = (sum(run[name] for run in runs) for name in ("lost", "moot"))
        late = sum(value > GOAL_MS for value in took_ms)
        speed = min((run["speed"] for run in runs), default=0.0)
        loads = ", ".join(f"{run['load']:.1f}" for run in runs)
        said = f"{late} of {len(took_ms)}" if late else none_in(len(took_ms))
        note = (
            f"over 150 ms: {said}; never slower: {lost}; stopped by another row first: {moot}; "
            f"load {loads}; slowest run's simulator {speed:.2f} x"
        )
        valid = speed >= SLOW and lost == 0
        rows.append(row_of(f"{way} -> slower", "ms", GOAL, took_ms, note, valid=valid))
    return rows


def _run(lab: BenchLab, way: str, index: int) -> dict[str, Any]:
    chance, way_of = Random(index), WAYS[way]
    sent: list[float] = []
    with lab.folder() as home, noting(home) as robot:
        robot.make_ready()
        robot.forget()
        for number in range(PER_SLICE):
            with load_cores():  # it ends by itself after 120 s, so not for the whole run
                lab.say(f"{way} {number + 1}/{PER_SLICE}")
                with way_of(robot) as stop:
                    _drive(robot, chance)
                    sent.append(stop())
                until(lambda: _is_held(robot), WITHIN_S, "held")
        load = os.getloadavg()[0]
        speed = robot.speed
        notes = notes_of(robot)
    took = [slower(notes, sent_s) for sent_s in sent]
    return {
        "took_ms": [value for value in took if isinstance(value, float)],
        "lost": took.count("lost"),
        "moot": took.count("moot"),
        "speed": speed,
        "load": load,
    }


def slower(notes: list[Note], sent_s: float) -> float | str:
    """Return how long after a moment the first slower command of a stop left [ms].

    ``moot`` where the robot was not driving then; ``lost`` where none left in time.
    """
    index = bisect_left(notes, sent_s, key=lambda note: note[0])
    if index == 0 or notes[index - 1][2] != Mode.ACTIVE:
        return "moot"
    for before, now in zip(notes[index - 1 :], notes[index:], strict=False):
        if now[0] - sent_s > WITHIN_S:
            break
        if now[2] != Mode.ACTIVE and abs(now[1]) < abs(before[1]) - SLOWER_MPS:
            return (now[0] - sent_s) * 1e3
    return "lost"


@contextmanager
def load_cores() -> Iterator[None]:
    """Keep every core busy: with stress-ng, else with a busy process for each."""
    if shutil.which("stress-ng") is not None:
        with stress_cores(True):
            yield
        return
    busy = [
        subprocess.Popen([sys.executable, "-c", "while True: pass"])
        for _ in os.sched_getaffinity(0)
    ]
    try:
        yield
    finally:
        for process in busy:
            process.kill()
            process.wait()


def _drive(robot: BenchRobot, chance: Random) -> None:
    """Give a goal, or resume the one that was stopped, until the robot drives at some moment."""
    end_s = time.monotonic() + DRIVE_S
    while not _moves(robot):
        if time.monotonic() > end_s:
            raise MeasurementFailure(f"driving: not within {DRIVE_S:.0f} s; {robot.describe()}")
        try:
            _ask(robot)
        except (PlannerDown, PlannerProblem):
            time.sleep(0.1)
        until_s = time.monotonic() + 1.0
        while time.monotonic() < until_s and not _moves(robot):
            time.sleep(0.01)
        time.sleep(chance.uniform(0.0, 0.3))


def _ask(robot: BenchRobot) -> None:
    status = robot.status
    if status is not None and status.mode in (Mode.ESTOPPED, Mode.FAULT):
        robot.operate("reset")
    if status is not None and status.mode is not Mode.ACTIVE:
        robot.operate("arm")  # refused where it is armed
    goals = call(robot.settings, "GET", "/v1/goals")["goals"]
    waiting = [goal for goal in goals if goal["state"] in OPEN]
    if not waiting:
        robot.say(ORDERS[len(goals) % 2])
    elif waiting[0]["state"] == "paused":
        call(robot.settings, "POST", f"/v1/goals/{waiting[0]['id']}/resume", {})


def _moves(robot: BenchRobot) -> bool:
    status = robot.status
    active = status is not None and status.mode is Mode.ACTIVE
    return active and status is not None and abs(status.measured.v_mps) > MOVING_MPS


def _is_held(robot: BenchRobot) -> bool:
    status = robot.status
    return status is not None and status.held is not None
