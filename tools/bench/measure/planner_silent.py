"""Kill and freeze the real planner while it drives: a handful beside the stub's hundreds.

After a kill another planner is started at once; until a person resumes, nothing may move. After a
short freeze the same planner goes on by itself.
"""

from __future__ import annotations

import signal
import time
from typing import TYPE_CHECKING, Any

from pons.http import call
from tools.bench.context import until
from tools.bench.figures import none_in
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import SLOW, BenchRobot
from wire import Mode

if TYPE_CHECKING:
    from tools.bench.context import BenchLab
    from wire import Status

NAME = "planner_silent"
TITLE = "the real planner silent -> HOLD2"
LONG_ONLY = False
GOAL = "each <= 31"
TICK_S = 0.01
ORDERS = ("go to the living room", "go to the kitchen")
WATCH_S = 1.0
FREEZE_S = 0.7
SPEEDS_MPS = (0.5, 0.2)


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take a few of each, slow and fast; every slice is one robot, one kill and one freeze."""
    runs = list(lab.slices("planner", lab.count(1, 20), lambda i: _run(lab, i)))
    ticks = [float(round(age / TICK_S)) for run in runs for age in run["ages_s"]]
    unasked = sum(run["unasked"] for run in runs)
    speed = min((run["speed"] for run in runs), default=0.0)
    asked = 2 * len(runs)
    note = f"{len(ticks)} of {asked} held; slowest run's simulator {speed:.2f} x"
    for fastest in SPEEDS_MPS[: len(runs)]:
        at = [round(a / TICK_S) for r in runs if r["fastest_mps"] == fastest for a in r["ages_s"]]
        note += f"; most {max(at, default=0)} at {fastest} m/s (n {len(at)})"
    return [
        row_of("real planner -> HOLD2", "ticks", GOAL, ticks, note, valid=speed >= SLOW),
        ReportRow("restarts unasked after a kill", "", "0",
            value=f"{unasked} of {len(runs)}" if unasked else none_in(len(runs))),
    ]  # fmt: skip


def _run(lab: BenchLab, index: int) -> dict[str, Any]:
    fastest_mps = SPEEDS_MPS[index % len(SPEEDS_MPS)]
    limits = {"max_speed_mps": fastest_mps}
    with lab.folder() as home, BenchRobot(home, "two_room", tapped=True, limits=limits) as robot:
        robot.make_ready()
        robot.forget()
        goal_id = robot.say(ORDERS[0])
        until(lambda: _moves(robot.status), 10.0, "driving")
        _freeze(robot)
        until(lambda: _moves(robot.status), 10.0, "driving again after a freeze")
        unasked = _kill(robot)
        robot.make_ready()  # a planner that took over 5 s to come back finds the bridge disarmed
        call(robot.settings, "POST", f"/v1/goals/{goal_id}/resume", {})
        until(lambda: _moves(robot.status), 10.0, "driving after a resume")
        speed = robot.speed
        noted = robot.end_bridge()
        held = [s["age_s"] for s in noted["silences"] if s["from"] == Mode.ACTIVE.value]
        return {"ages_s": held, "unasked": unasked, "speed": speed, "fastest_mps": fastest_mps}


def _freeze(robot: BenchRobot) -> None:
    planner = robot.children["planner"]
    planner.signal(signal.SIGSTOP)
    time.sleep(FREEZE_S)
    planner.signal(signal.SIGCONT)


def _kill(robot: BenchRobot) -> int:
    """Kill it, start another, and return whether anything moved before a person resumed."""
    planner = robot.children["planner"]
    planner.signal(signal.SIGKILL)
    until(lambda: planner.died(time.monotonic()) is not None, 5.0, "the planner's death")
    until(lambda: _stands(robot.status), 5.0, "standing after a kill")
    planner.start(time.monotonic())
    robot.await_planner()
    end_s = time.monotonic() + WATCH_S
    while time.monotonic() < end_s:
        if _moves(robot.status):
            return 1
        time.sleep(0.01)
    return 0


def _moves(status: Status | None) -> bool:
    return status is not None and abs(status.measured.v_mps) > 0.1


def _stands(status: Status | None) -> bool:
    return status is not None and abs(status.measured.v_mps) < 0.02
