"""Measure how soon a plan shows while a model writes it, and how soon the robot is led after it.

Real processes; the mock model writes 30 tokens a second. The first figure starts before the goal's
HTTP request and ends when a listening page has the first words. The others start when the mock has
sent the plan's last token: one ends when the page has the whole way of the first step, which it is
told at most 20 ms after it was routed, the other when the first horizon with points is at the
bridge, for which the bridge must have granted the mission.
"""

from __future__ import annotations

import json
import time
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

import httpx
from websockets.sync.client import ClientConnection, connect

from tools.bench.context import MeasurementFailure, until
from tools.bench.endpoint import mock_model
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import SLOW, BenchRobot
from wire import Mode

if TYPE_CHECKING:
    from tools.bench.context import BenchLab
    from wire import Status

NAME = "streaming"
TITLE = "a plan as it is written"
LONG_ONLY = False
TOKENS_PER_S = 30.0
GOAL_FIRST = "each <= 300"
GOAL_ROUTED = "each <= 50"
ORDERS = (
    "go to the living room, then wait five seconds and come back",
    "去厨房，等三秒，然后回来",
)
GOALS = 20
SETTLE_S = 10.0


def measure(lab: BenchLab) -> list[ReportRow]:
    """Give 40 goals, in a long run 100; each is cancelled as soon as the robot follows it."""
    runs = list(lab.slices("robot", lab.count(2, 5), lambda index: _slice(lab, index)))
    first = [value for run in runs for value in run["first_ms"]]
    routed = [value for run in runs for value in run["routed_ms"]]
    led = [value for run in runs for value in run["led_ms"]]
    slowest = min((run["speed"] for run in runs), default=0.0)
    valid = slowest >= SLOW
    note = f"{TOKENS_PER_S:g} tokens/s; slowest run's simulator {slowest:.2f} x"
    return [
        row_of("goal -> first word of the plan shown", "ms", GOAL_FIRST, first, note, valid=valid),
        row_of("last token -> routed, as the page sees it", "ms", "", routed,
               "judged, journalled and routed in between", valid=valid),
        row_of("last token -> first waypoint at the bridge", "ms", GOAL_ROUTED, led, "and granted",
               valid=valid),
    ]  # fmt: skip


def _slice(lab: BenchLab, index: int) -> dict[str, Any]:
    with ExitStack() as stack:
        home = stack.enter_context(lab.folder())
        url = stack.enter_context(mock_model(home))
        (home / "settings.toml").write_text(f'[model]\nurl = "{url}"\nname = "mock"\n')
        robot = stack.enter_context(BenchRobot(home, "two_room", tapped=True))
        robot.make_ready()
        httpx.post(f"{url}/chat/completions", json={"messages": []}, trust_env=False)  # it loads
        _mock(url, "POST", tokens_per_s=TOKENS_PER_S)
        robot.forget()
        address = f"ws://{robot.settings.host}:{robot.settings.port}/v1/events"
        page = stack.enter_context(connect(address, max_queue=None))
        first_ms: list[float] = []
        path_s: list[float] = []
        goals: list[str] = []
        for number in range(GOALS):
            lab.say(f"run {index + 1}, goal {number + 1}/{GOALS}")
            began_s = time.monotonic()
            goals.append(robot.say(ORDERS[number % len(ORDERS)]))
            first_ms.append((_shown_s(page, "thinking", goals[-1]) - began_s) * 1e3)
            path_s.append(_shown_s(page, "path", goals[-1]))
            until(lambda: _follows(robot.status, goals[-1]), SETTLE_S, goals[-1])
            robot.cancel(goals[-1])
            until(lambda: _rests(robot.status), SETTLE_S, "standing after cancel")
        wrote_s: list[float] = _mock(url, "GET")["wrote_s"]
        at_bridge_s: dict[str, float] = robot.end_bridge()["first_waypoint_s"]
        if len(wrote_s) != len(goals):
            raise MeasurementFailure(
                f"{len(goals)} goals, but {len(wrote_s)} streams were written to the end"
            )
        return {
            "first_ms": first_ms,
            "routed_ms": [(b - a) * 1e3 for a, b in zip(wrote_s, path_s, strict=True)],
            "led_ms": [
                (at_bridge_s[goal] - at_s) * 1e3 for goal, at_s in zip(goals, wrote_s, strict=True)
            ],
            "speed": robot.speed,
        }


def _mock(url: str, method: str, **switches: Any) -> dict[str, Any]:
    address = url.replace("/v1", "/mock")
    reply = httpx.request(method, address, json=switches or None, trust_env=False)
    found: dict[str, Any] = reply.raise_for_status().json()
    return found


def _shown_s(page: ClientConnection, kind: str, goal: str) -> float:
    """Return when the page had the first word or the way of a goal [s, monotonic]."""
    end_s = time.monotonic() + SETTLE_S
    while time.monotonic() < end_s:
        frame = json.loads(page.recv(SETTLE_S))
        about = frame.get("change" if kind == "thinking" else "path")
        if frame["kind"] == kind and about is not None and about["goal"] == goal:
            return time.monotonic()
    raise MeasurementFailure(f"nothing of kind {kind} was shown of goal {goal}")


def _follows(status: Status | None, goal: str) -> bool:
    leg = status.leg if status is not None else None
    return leg is not None and leg.mission == goal and leg.following


def _rests(status: Status | None) -> bool:
    return status is not None and status.mode is Mode.HOLD and abs(status.measured.v_mps) < 0.02
