"""Measure from a goal's acceptance to its first waypoint at the bridge, and on to the wheels.

Real processes. The clock starts before the HTTP request is sent, so its parsing and the journal are
inside; it ends in the bridge process when the first horizon with points arrives, whatever its tick.
The second figure starts when the tick that reads a horizon was due and ends when its command has
been handed to the transport.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from tools.bench.context import until
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import SLOW, BenchRobot
from wire import Mode

if TYPE_CHECKING:
    from tools.bench.context import BenchLab
    from wire import Status

NAME = "goal_to_waypoint"
TITLE = "goal accepted -> first waypoint -> wheel command"
LONG_ONLY = False
GOAL = "p50 <= 30, p99 <= 120"
GOAL_WHEEL = "p50 <= 1000, p99 <= 3000"
ORDERS = {
    "two_room": ("go to the living room", "去厨房"),
    "home": ("go to the kitchen", "去卧室"),
}
GOALS = 20
SETTLE_S = 10.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Give goals on both sites; each is cancelled as soon as the robot follows it."""
    rows: list[ReportRow] = []
    for site in ORDERS:
        first_ms: list[float] = []
        wheel_us: list[float] = []
        slowest: list[float] = []
        for data in lab.slices(site, lab.count(2, 5), lambda i, site=site: _slice(lab, site, i)):  # type: ignore[misc]  # the default binds the loop's site
            first_ms += data["first_ms"]
            wheel_us += data["wheel_us"]
            slowest.append(data["speed"])
        valid = min(slowest, default=0.0) >= SLOW
        note = f"offline brain; slowest run's simulator {min(slowest, default=0.0):.2f} x"
        rows += [
            row_of(f"goal -> first waypoint, {site}", "ms", GOAL, first_ms, note, valid=valid),
            row_of(
                f"waypoint -> wheel, beyond its tick, {site}", "us", GOAL_WHEEL, wheel_us,
                "from the tick's due time", valid=valid,
            ),
        ]  # fmt: skip
    return rows


def _slice(lab: BenchLab, site: str, index: int) -> dict[str, Any]:
    with lab.folder() as home, BenchRobot(home, site, tapped=True) as robot:
        robot.make_ready()
        robot.forget()
        asked_s: dict[str, float] = {}
        for number in range(GOALS):
            lab.say(f"{site} {index + 1}, goal {number + 1}/{GOALS}")
            text = ORDERS[site][number % 2]
            began_s = time.monotonic()
            goal_id = robot.say(text)
            asked_s[goal_id] = began_s
            until(lambda goal_id=goal_id: _follows(robot.status, goal_id), SETTLE_S, text)  # type: ignore[misc]  # the default binds the loop's goal
            time.sleep(0.25)
            robot.cancel(goal_id)
            until(lambda: _rests(robot.status), SETTLE_S, "standing after cancel")
        noted = robot.end_bridge()
        arrived_s = noted["first_waypoint_s"]
        return {
            "first_ms": [(arrived_s[g] - asked_s[g]) * 1e3 for g in asked_s if g in arrived_s],
            "wheel_us": noted["wheel_us"],
            "speed": robot.speed,
        }


def _follows(status: Status | None, goal_id: str) -> bool:
    leg = status.leg if status is not None else None
    return leg is not None and leg.mission == goal_id and leg.following


def _rests(status: Status | None) -> bool:
    return status is not None and status.mode is Mode.HOLD and abs(status.measured.v_mps) < 0.02
