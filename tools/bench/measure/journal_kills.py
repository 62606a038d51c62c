"""Kill planners at random writes of their journal; count goals that are lost and effects repeated.

180 kills on a stub: the planner's real missions, runner and SQLite file, a robot on paper. 20 on
the real planner, by a watch on its journal's log: killed within a millisecond of a random change;
there goals, ways and unasked motion are counted, words and legs are not.
"""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from math import hypot
from random import Random
from threading import Thread
from typing import TYPE_CHECKING, Any

from pons.http import PlannerDown, PlannerProblem, call
from tools.bench.context import MeasurementFailure, until
from tools.bench.figures import none_in
from tools.bench.report import ReportRow
from tools.bench.robot import BenchRobot
from wire import wrap

if TYPE_CHECKING:
    from pathlib import Path

    from tools.bench.context import BenchLab
    from wire import Pose2

NAME = "journal_kills"
TITLE = "SIGKILL at random writes of the journal"
LONG_ONLY = False
KILLS_A_SLICE = 10
STUB_S = 300.0
TWICE = ("said_twice", "goals_twice", "legs_twice", "way_twice", "unasked")
ORDERS = ("turn left 90 degrees", "turn right 45 degrees", "turn left 90 degrees")
TURN_RAD = 135.0 / 57.29578
OFF_RAD, OFF_M = 0.35, 0.3
MOST_WRITES = 12
"""Changes of the log in a goal or two."""
ENDED = ("succeeded", "failed", "refused", "cancelled")


def measure(lab: BenchLab) -> list[ReportRow]:
    """Kill the stub by tens, the real planner one by one."""
    stub = [one for told in lab.slices("stub", lab.count(1, 18), lambda i: _stub(lab, i))
            for one in told]  # fmt: skip
    real = list(lab.slices("planner", lab.count(1, 20), lambda i: _planner(lab, i)))
    return [*_rows("stub", stub), *_rows("real planner", real)]


def _rows(what: str, told: list[dict[str, Any]]) -> list[ReportRow]:
    kills, accepted = sum(t["kills"] for t in told), sum(t["accepted"] for t in told)
    lost, crashed = sum(t["lost"] for t in told), [c for t in told for c in t["crashed"]]
    counted = [name for name in TWICE if all(name in t for t in told)]
    twice = {name: sum(t[name] for t in told) for name in counted}
    note = f"{kills} kills, {accepted} goals accepted"
    if crashed:
        note += f"; {len(crashed)} lives ended otherwise: {crashed[0]}"
    each = ", ".join(f"{name} {count}" for name, count in twice.items())
    return [
        ReportRow(
            f"accepted goals lost, {what}",
            "",
            "0",
            value=str(lost) if lost else none_in(kills),
            note=note,
            valid=kills > 0 and not crashed,
        ),
        ReportRow(
            f"side effects repeated, {what}",
            "",
            "0",
            value=str(sum(twice.values())) if any(twice.values()) else none_in(kills),
            note=each,
            valid=kills > 0 and not crashed,
        ),
    ]


def _stub(lab: BenchLab, index: int) -> list[dict[str, Any]]:
    with lab.folder() as folder:
        command = [sys.executable, "-m", "tools.bench.journal_life", str(folder), str(index)]
        done = subprocess.run(
            [*command, str(KILLS_A_SLICE)],
            capture_output=True,
            text=True,
            timeout=STUB_S,
            check=False,
        )
        if done.returncode != 0:
            raise MeasurementFailure(f"the stub ended with {done.returncode}: {done.stderr[-300:]}")
        told: list[dict[str, Any]] = json.loads(done.stdout)
        return told


def _planner(lab: BenchLab, index: int) -> dict[str, Any]:
    """Give three goals, kill the planner once among its writes, and let a person go on."""
    random = Random(index)
    with lab.folder() as home, BenchRobot(home, "two_room") as robot:
        robot.make_ready()
        began = _pose(robot)
        accepted: dict[str, str] = {}
        wal = home / "missions.db-wal"
        seen, at = _changed_ns(wal), random.randint(1, MOST_WRITES)
        giving = Thread(target=_give, args=(robot, accepted))
        giving.start()
        killed = _kill_at(robot, wal, seen, at)
        giving.join()
        unasked = _restart(robot) if killed else 0
        _give(robot, accepted)
        _go_on(robot, set(accepted.values()))
        goals = {g["id"]: g for g in call(robot.settings, "GET", "/v1/goals")["goals"]}
        kept = [i for i in accepted.values() if goals.get(i, {}).get("state") == "succeeded"]
        ended = _pose(robot)
        turned_off = abs(wrap(ended.yaw_rad - began.yaw_rad - TURN_RAD)) > OFF_RAD
        moved = hypot(ended.x_m - began.x_m, ended.y_m - began.y_m) > OFF_M
        return {
            "kills": int(killed), "crashed": [], "accepted": len(accepted),
            "lost": len(accepted) - len(kept),
            "goals_twice": max(0, len(goals) - len(ORDERS)), "way_twice": int(turned_off or moved),
            "unasked": unasked,
        }  # fmt: skip


def _give(robot: BenchRobot, accepted: dict[str, str]) -> None:
    """Give every goal that was not answered for yet, as a client does that asks again."""
    for number, text in enumerate(ORDERS):
        key = f"order {number}"
        if key in accepted:
            continue
        try:
            goal = call(robot.settings, "POST", "/v1/goals", {"text": text},
                        headers={"Idempotency-Key": key})  # fmt: skip
        except (PlannerDown, PlannerProblem):
            return
        accepted[key] = str(goal["id"])


def _kill_at(robot: BenchRobot, wal: Path, seen: int, at: int) -> bool:
    """Kill the planner at the so-manieth change of its log since ``seen``; tell whether it came."""
    grown, last, end_s = 0, seen, time.monotonic() + 20.0
    while time.monotonic() < end_s:
        now = _changed_ns(wal)
        if now != last:
            last, grown = now, grown + 1
            if grown >= at:
                robot.children["planner"].signal(signal.SIGKILL)
                return True
        time.sleep(0.0005)
    return False


def _restart(robot: BenchRobot) -> int:
    """Start another planner; return whether anything turned before a person acted."""
    planner = robot.children["planner"]
    until(lambda: planner.died(time.monotonic()) is not None, 5.0, "the planner's death")
    until(lambda: _stands(robot), 5.0, "standing after a kill")
    planner.start(time.monotonic())
    robot.await_planner()
    still, end_s = _pose(robot), time.monotonic() + 1.0
    while time.monotonic() < end_s:
        if abs(wrap(_pose(robot).yaw_rad - still.yaw_rad)) > 0.1:
            return 1
        time.sleep(0.02)
    robot.make_ready()
    return 0


def _go_on(robot: BenchRobot, goals: set[str], limit_s: float = 90.0) -> None:
    """Resume whatever is paused or kept waiting until all goals have ended."""
    end_s = time.monotonic() + limit_s
    states: dict[str, dict[str, Any]] = {}
    while time.monotonic() < end_s:
        states = {i: robot.goal(i) for i in goals}
        if all(g["state"] in ENDED for g in states.values()):
            return
        if any(g.get("reason") == "disarmed" for g in states.values()):
            robot.make_ready()  # a machine that stalls us all for long disarms the bridge
        for i, goal in states.items():
            if goal["state"] == "paused" or goal.get("reason") == "held":
                _resume(robot, i)
        time.sleep(0.2)
    where = [f"{g['state']} {g.get('reason')}" for g in states.values()]
    raise MeasurementFailure(f"goals did not end: {where}; {robot.describe()}")


def _resume(robot: BenchRobot, goal_id: str) -> None:
    try:
        call(robot.settings, "POST", f"/v1/goals/{goal_id}/resume", {})
    except PlannerProblem as refused:
        if refused.code != "bad_state":  # it went on while we looked at another
            raise


def _pose(robot: BenchRobot) -> Pose2:
    until(lambda: (s := robot.status) is not None and s.base_in_map is not None, 10.0, "a pose")
    status = robot.status
    if status is None or status.base_in_map is None:
        raise MeasurementFailure("the bridge lost its pose")
    return status.base_in_map


def _stands(robot: BenchRobot) -> bool:
    status = robot.status
    return status is not None and abs(status.measured.w_radps) < 0.05


def _changed_ns(path: Path) -> int:
    try:
        return path.stat().st_mtime_ns
    except OSError:
        return 0
