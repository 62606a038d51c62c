"""Measure what a model's endpoint costs beside the call itself, and a stop while the model hangs.

The endpoint runs in a process of its own and answers at once. `plan` is a mission's own thinking
(prompt, call, validation) beside the bare httpx call with the same body, turn by turn; `in the
planner` is the real planner's own record, from a goal's acceptance to its plan.
"""

from __future__ import annotations

import asyncio
import json
import os
import time
from contextlib import ExitStack, contextmanager
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import httpx

from planner.brain import FallbackBrain, OfflineBrain, ThinkRequest
from planner.brain.endpoint import EndpointBrain, warm_up
from planner.brain.endpoint.dialect import Dialect, body_of
from planner.brain.prompt import Prompt
from planner.brain.prompt_tokens import tokens
from planner.brain.schema import schema_of
from planner.mission import AskBrain
from planner.mission.plan_request import thinker
from planner.plan import Language
from planner.settings import ModelSettings
from planner.site import Site
from planner.site.site_view import vocabulary_of
from pons.http import PlannerProblem, call
from pons.robot_processes import free_port
from pons.settings import CHECKOUT
from pons.supervisor import Child
from tools.bench.context import until
from tools.bench.instant_llm_process import counts, hang, instant
from tools.bench.report import ReportRow, row_of
from tools.bench.robot import SLOW, BenchRobot

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tools.bench.context import BenchLab

NAME = "endpoint"
TITLE = "a model behind an endpoint"
LONG_ONLY = False
ORDER = "first go to the living room, then the kitchen, wait ten seconds and come back"
CALLS = 200
WARM = 20
IN_PLANNER = 60
QUEUED = 50
STOPS = 10
"""Each needs QUEUED goals, and the planner takes two a second of one address."""
PATIENCE_S = 4.0
LOOK_S = 0.1
RATE_S = 0.5


def measure(lab: BenchLab) -> list[ReportRow]:
    """Take the call, the planner's record, the prompt, and the stops."""
    alone = list(lab.slices("plan", lab.count(1, 5), lambda _: _plans(lab)))
    whole = list(lab.slices("robot", lab.count(1, 3), lambda _: _robot(lab)))
    bare = [value for run in alone for value in run["bare_ms"]]
    plan = [value for run in alone for value in run["plan_ms"]]
    added = [both - call_ms for both, call_ms in zip(plan, bare, strict=True)]
    inside = [value for run in whole for value in run["inside_ms"]]
    stops = [value for run in whole for value in run["stop_ms"]]
    valid = min((run["slowest"] for run in whole), default=0.0) >= SLOW
    calls = [run["calls_per_goal"] for run in whole]
    refused = [run["refused"] for run in whole]
    said = f"{QUEUED - max(refused, default=0)} think, {max(refused, default=0)} get queue_full"
    return [
        row_of("bare httpx call", "ms", "", bare, "same body, same endpoint"),
        row_of("accepted -> validated plan", "ms", "p50 <= 8, p99 <= 25", plan, "thinking alone"),
        row_of("what thinking adds", "ms", "", added, "pair by pair"),
        row_of("accepted -> validated plan, in the planner", "ms", "p50 <= 8, p99 <= 25", inside,
               "by the goal's own record", valid=valid),
        ReportRow("model calls per goal", "", "1", value=", ".join(f"{one:.2f}" for one in calls)),
        ReportRow("prompt, default site", "tokens", "<= 1500", value=str(prompt_tokens())),
        row_of(f"stop -> cmd/stop, model hangs, {QUEUED} goals", "ms", "p99 <= 50", stops, said,
               valid=valid),
    ]  # fmt: skip


def prompt_tokens() -> int:
    """Return the tokens of the default site's prompt, at four characters each."""
    vocabulary = vocabulary_of(Site.load(CHECKOUT / "sites" / "home"))
    request = ThinkRequest(
        text=ORDER, vocabulary=vocabulary, room="living_room", language=Language.EN
    )
    return tokens(Prompt.load().messages(request))


@contextmanager
def mock_model(folder: Path) -> Iterator[str]:
    """Run the mock in a process; yield its base URL."""
    port = free_port()
    child = Child("mock", ["pons", "mock-llm", "--port", str(port)], folder / "mock.log")
    child.start(time.monotonic())
    try:
        until(lambda: _answers(port), 30.0, "the mock model", 0.05)
        yield f"http://127.0.0.1:{port}/v1"
    finally:
        child.stop(PATIENCE_S)


def _answers(port: int) -> bool:
    try:
        return httpx.get(f"http://127.0.0.1:{port}/mock", trust_env=False).status_code == 200
    except httpx.HTTPError:
        return False


def _plans(lab: BenchLab) -> dict[str, list[float]]:
    with lab.folder() as home, instant(home) as url:
        return asyncio.run(_pairs(home, url))


async def _pairs(home: Path, url: str) -> dict[str, list[float]]:
    """Take the bare call and the thought in turns, so that both meet the same minute."""
    settings = ModelSettings(url=url, name="mock")
    vocabulary = vocabulary_of(Site.load(CHECKOUT / "sites" / "home"))
    warm_up()
    model = EndpointBrain(settings, home)
    think = thinker(FallbackBrain(model, OfflineBrain()), vocabulary)
    request = ThinkRequest(text=ORDER, vocabulary=vocabulary, language=Language.EN)
    body = body_of(settings, Dialect(), Prompt.load().messages(request), schema_of(vocabulary))
    took: dict[str, list[float]] = {"bare_ms": [], "plan_ms": []}
    async with httpx.AsyncClient(trust_env=False) as bare:
        for number in range(WARM + CALLS):
            began_s = time.perf_counter()
            reply = await bare.post(f"{url}/chat/completions", json=body)
            json.loads(reply.json()["choices"][0]["message"]["content"])
            between_s = time.perf_counter()
            planned = await think(AskBrain(str(number), ORDER, Language.EN))
            ended_s = time.perf_counter()
            if planned.plan is None or planned.brain != model.tag:
                raise RuntimeError(f"the model did not plan: {planned}")
            if number >= WARM:
                took["bare_ms"].append((between_s - began_s) * 1e3)
                took["plan_ms"].append((ended_s - between_s) * 1e3)
    await model.close()
    return took


def _robot(lab: BenchLab) -> dict[str, Any]:
    """Measure in the real system."""
    with ExitStack() as stack:
        home = stack.enter_context(lab.folder())
        url = stack.enter_context(instant(home))
        stack.enter_context(_environment(PONS_MODEL_URL=url, PONS_MODEL="mock"))
        robot = BenchRobot(home, "two_room")
        bridge = robot.children["bridge"]
        bridge.arguments = ["tools.bench.stop_probe", *bridge.arguments[1:]]
        stack.enter_context(robot)
        robot.make_ready()
        robot.forget()
        before = counts(url)["calls"].get("mock", 0)
        inside_ms = [_planned_ms(robot) for _ in range(lab.count(IN_PLANNER, 4 * IN_PLANNER))]
        calls = counts(url)["calls"]["mock"] - before
        hang(url)
        asked_s, refused = [], 0
        for number in range(STOPS):
            lab.say(f"stop {number + 1}/{STOPS}")
            refused = max(refused, _fill(robot))
            asked_s.append(time.monotonic())
            call(robot.settings, "POST", "/v1/stop", {"source": "bench"})
            _empty(robot)
        robot.status  # noqa: B018  # drains what tells the simulator's speed
        slowest = robot.speed
        bridge.stop(PATIENCE_S)
        heard_s: list[float] = json.loads((home / "stops.json").read_text("utf-8"))
    first_s = [min(at for at in heard_s if at >= asked) for asked in asked_s]
    return {
        "inside_ms": inside_ms,
        "calls_per_goal": calls / len(inside_ms),
        "stop_ms": [(at - asked) * 1e3 for at, asked in zip(first_s, asked_s, strict=True)],
        "refused": refused,
        "slowest": slowest,
    }


def _give(robot: BenchRobot, body: dict[str, Any]) -> Any:
    """Give a goal as soon as the planner's rate for one address lets it in."""
    while True:
        try:
            return call(robot.settings, "POST", "/v1/goals", body)
        except PlannerProblem as refused:
            if refused.code != "too_many_goals":
                raise
        time.sleep(RATE_S)


def _planned_ms(robot: BenchRobot) -> float:
    """Give a goal that waits for a yes; return what its record says of the time until then."""
    given = {"text": ORDER.replace("first ", ""), "confirm": True}
    goal_id = str(_give(robot, given)["id"])
    time.sleep(LOOK_S)  # who looks all the time makes the planner late
    until(lambda: robot.goal(goal_id)["state"] == "awaiting_confirmation", 5.0, "a plan", LOOK_S)
    record = robot.goal(goal_id)
    if record["brain"]["name"] != "mock":
        raise RuntimeError(f"the model did not plan: {record['brain']}")
    robot.cancel(goal_id)
    created, updated = (datetime.fromisoformat(record[name]) for name in ("created", "updated"))
    return (updated - created).total_seconds() * 1e3


def _fill(robot: BenchRobot) -> int:
    """Give more goals than are taken while the model hangs; return how many were refused."""
    refused = 0
    for _ in range(QUEUED):
        try:
            _give(robot, {"text": ORDER})
        except PlannerProblem as full:
            if full.code != "queue_full":
                raise
            refused += 1
    return refused


def _empty(robot: BenchRobot) -> None:
    for goal in call(robot.settings, "GET", "/v1/goals?limit=60")["goals"]:
        if goal["state"] in ("paused", "queued", "planning"):
            robot.cancel(goal["id"])


@contextmanager
def _environment(**names: str) -> Iterator[None]:
    """Set names for the processes that are started within."""
    os.environ.update(names)
    try:
        yield
    finally:
        for name in names:
            del os.environ[name]
