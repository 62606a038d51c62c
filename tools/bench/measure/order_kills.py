"""Kill whole planners around the moment at which standing orders are due; judge from outside.

The real planner beside bridge and simulator. Each round gives three orders for one instant by HTTP
(an errand, a reminder, one that drives), kills the planner by SIGKILL between 0.2 s before that
instant and 0.3 s after it, or at a random write around it, starts another and asks its API: each
run was given as exactly one goal, or is told as missed. In every fourth round the second planner is
killed too, while it starts.
"""

from __future__ import annotations

import signal
import time
from collections import Counter
from contextlib import suppress
from random import Random
from typing import TYPE_CHECKING, Any

from pons.http import PlannerDown, PlannerProblem, call
from tools.bench.context import MeasurementFailure, until
from tools.bench.figures import none_in
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import BenchRobot

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from tools.bench.context import BenchLab

NAME = "order_kills"
TITLE = "SIGKILL of the planner around the moment at which standing orders are due"
LONG_ONLY = False
ROUNDS = 6
"""Of one robot."""
AHEAD_S = 2.5
"""Orders are due so long after the first of a round was given."""
BEFORE_S, AFTER_S = 0.2, 0.3
MOST_WRITES, LATE_S = 6, 0.003
"""A kill by writes strikes at one of so many, up to 3 ms after it."""
SETTLED_S = 25.0
"""A planner that starts waits 10 s at most for the bridge's word."""
OPEN = ("begun", "given")
ENDED = ("succeeded", "failed", "refused", "cancelled")


def measure(lab: BenchLab) -> list[ReportRow]:
    """Kill planners, six to a robot."""
    slices = lab.slices("planner", lab.count(1, 8), lambda i: _rounds(lab, i))
    rounds = [one for told in slices for one in told]
    return rows_of(rounds)


def rows_of(rounds: Sequence[Mapping[str, Any]]) -> list[ReportRow]:
    """Return the table of all rounds."""
    verdicts = Counter(v for told in rounds for v in told["verdicts"])
    kills, runs = sum(told["kills"] for told in rounds), sum(verdicts.values())
    ends = ", ".join(f"{name} {count}" for name, count in sorted(verdicts.items()))
    ok = kills > 0

    def row(what: str, *wrong: str) -> ReportRow:
        count = sum(verdicts[name] for name in wrong)
        value = str(count) if count else none_in(runs)
        return ReportRow(what, "", "0", value=value, note=ends, valid=ok)

    offsets = [told["offset_s"] for told in rounds if told["offset_s"] is not None]
    return [
        row("runs given twice", "doubled"),
        row("runs missed silently", "silent", "unsettled"),
        row("runs whose history and goals disagree", "contradicted"),
        row_of("killed after the due moment", "s", "-", offsets, f"{kills} kills in {len(rounds)}"),
    ]


def judge_run(history: Sequence[Mapping[str, Any]], goals: Sequence[Mapping[str, Any]]) -> str:
    """Say what came of one order's only run, by its history and the goals of its words.

    Returns:
        ``fired``, ``missed: REASON``; or ``doubled``, ``silent``, ``unsettled``, ``contradicted``.
    """
    runs = sum(firing["count"] for firing in history)
    if len(goals) > 1 or runs > 1:
        return "doubled"
    if not history:
        return "contradicted" if goals else "silent"
    (firing,) = history
    match firing["state"], len(goals):
        case ("begun", _):
            return "unsettled"
        case ("given" | "ended", 1) if firing["goal"] == goals[0]["id"]:
            return "fired"
        case ("missed", 0) if firing["reason"]:
            return f"missed: {firing['reason']}"
    return "contradicted"


def _rounds(lab: BenchLab, index: int) -> list[dict[str, Any]]:
    random = Random(index)
    with lab.folder() as home, BenchRobot(home, "two_room") as robot:
        robot.make_ready()
        return [_round(robot, random, home, number) for number in range(ROUNDS)]


def _round(robot: BenchRobot, random: Random, home: Path, number: int) -> dict[str, Any]:
    _ready(robot)
    due_unix_s = time.time() + AHEAD_S
    words = [f"say hello {number}", "", f"turn left {20 + number} degrees"]
    when = {"at": time.strftime("%Y-%m-%dT%H:%M:%S", time.gmtime(due_unix_s))
            + f"{due_unix_s % 1:.6f}"[1:] + "Z"}  # fmt: skip
    bodies = [{"text": text, "when": when} for text in words if text]
    bodies.append({"reminder": f"the cake {number}", "when": when})
    orders = [call(robot.settings, "POST", "/v1/orders", body) for body in bodies]
    by_write = bool(number % 2)
    if by_write:
        time.sleep(max(0.0, due_unix_s - BEFORE_S / 4 - time.time()))
        _kill_at_write(robot, home, random)
    else:
        offset_s = -BEFORE_S + (BEFORE_S + AFTER_S) * random.random()
        time.sleep(max(0.0, due_unix_s + offset_s - time.time()))
        robot.children["planner"].signal(signal.SIGKILL)
    killed_unix_s, kills = time.time(), 1
    _begin_another(robot)
    if number % 4 == 3:
        time.sleep(random.uniform(0.3, 2.5))
        robot.children["planner"].signal(signal.SIGKILL)
        kills += 1
        _begin_another(robot)
    robot.await_planner()
    with suppress(MeasurementFailure):  # what never comes is the verdict: silent, or unsettled
        until(lambda: all(_is_settled(robot, order) for order in orders), SETTLED_S, "runs", 0.1)
    goals = call(robot.settings, "GET", "/v1/goals?limit=200")["goals"]
    verdicts = [
        judge_run(_history(robot, order), [g for g in goals if g["text"] == order["order"]])
        for order in orders
    ]
    return {
        "kills": kills, "by_write": by_write, "offset_s": killed_unix_s - due_unix_s,
        "verdicts": verdicts,
    }  # fmt: skip


def _ready(robot: BenchRobot) -> None:
    """End what is open, and clear the hold that a planner's start leaves, as a person would."""
    robot.make_ready()
    for goal in call(robot.settings, "GET", "/v1/goals")["goals"]:
        if goal["state"] not in ENDED:
            robot.cancel(goal["id"])

    def free() -> bool:
        status = robot.status
        if status is not None and status.held is not None:
            robot.operate("resume")
        return status is not None and status.held is None and status.owner is not None

    until(free, 20.0, "a robot that nothing holds", 0.1)


def _kill_at_write(robot: BenchRobot, home: Path, random: Random) -> None:
    """Kill the planner at a random one of its writes from now on, or a moment later."""
    at, late_s = random.randint(1, MOST_WRITES), random.choice((0.0, random.uniform(0.0, LATE_S)))
    last, grown, end_s = _changed_ns(home), 0, time.monotonic() + 1.0
    while grown < at and time.monotonic() < end_s:
        now = _changed_ns(home)
        grown, last = grown + (now != last), now
        time.sleep(0.0002)
    time.sleep(late_s)
    robot.children["planner"].signal(signal.SIGKILL)


def _changed_ns(home: Path) -> int:
    """Return a number that changes with each write of orders or journal."""
    total = 0
    for name in ("state.sqlite-wal", "missions.db-wal"):
        try:
            total += (home / name).stat().st_mtime_ns
        except OSError:
            continue
    return total


def _begin_another(robot: BenchRobot) -> None:
    planner = robot.children["planner"]
    until(lambda: planner.died(time.monotonic()) is not None, 5.0, "the planner's death")
    planner.start(time.monotonic())


def _is_settled(robot: BenchRobot, order: Mapping[str, Any]) -> bool:
    history = _history(robot, order)
    return bool(history) and all(firing["state"] != "begun" for firing in history)


def _history(robot: BenchRobot, order: Mapping[str, Any]) -> list[dict[str, Any]]:
    try:
        shown = call(robot.settings, "GET", f"/v1/orders/{order['id']}?limit=50")
    except PlannerDown as down:
        raise MeasurementFailure(str(down)) from None
    except PlannerProblem as refused:
        if refused.code != "unknown_order":
            raise
        return []
    history: list[dict[str, Any]] = shown["history"]
    return history
