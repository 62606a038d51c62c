"""A model plans for the real robot: what it gets right is driven, what it gets wrong never is."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator
from contextlib import closing
from datetime import date
from pathlib import Path

import pytest
from websockets.sync.client import connect

from planner.budget.ledger import Ledger
from planner.budget.totals import Expense
from planner.settings import FILE
from tests.e2e.polling import until
from tests.e2e.robot import Robot
from tests.e2e.system import ENDED, Json, new_home
from tests.pons.mock_llm.bad_replies import HOSTILE_COUNT
from tests.pons.mock_llm.faults import BadSwitches
from tests.pons.mock_llm.mocks import RunningMock, running_mock

pytestmark = [pytest.mark.e2e, pytest.mark.nightly(keep=3)]

TIMEOUT_S = 2.0
SETTINGS = f"""
[model]
url = "{{url}}"
name = "mock"
key = "sk-e2e-0123456789"
timeout_s = {TIMEOUT_S}
rest_s = 0.5
"""
NONSENSE = "colourless green ideas"
"""Neither the offline brain nor anything it offers moves on this."""
SHORT = "wait 0.2 seconds"
TRIALS_S = 3.0
IDLE_S = 1.0


@pytest.fixture(scope="module")
def mock() -> Iterator[RunningMock]:
    """Serve one mock model for the module."""
    with running_mock() as served:
        yield served


@pytest.fixture(scope="module")
def thinker(mock: RunningMock) -> Iterator[Robot]:
    """Run one robot that thinks with the mock model."""
    with new_home() as folder:
        (Path(folder) / FILE).write_text(SETTINGS.format(url=mock.url), "utf-8")
        made = Robot(Path(folder))
        made.start()
        yield made
        made.close()


@pytest.fixture
def robot(thinker: Robot, mock: RunningMock) -> Robot:
    """Return the robot at rest, its model well and believed again."""
    mock.set()
    thinker.rest()
    until(lambda: _by_model(thinker), TRIALS_S + 10.0, "the model being asked again")
    return thinker


def _by_model(robot: Robot) -> bool:
    """Give two goals; the breaker closes after two good answers."""
    brains = [ended(robot, robot.system.give(SHORT))["brain"] for _ in range(2)]
    return all(brain["fallback_from"] is None for brain in brains)


def ended(robot: Robot, goal: Json) -> Json:
    return robot.system.until_goal(goal["id"], *ENDED, "needs_clarification", limit_s=15.0)


def test_a_plan_by_a_model_is_driven_to_its_end(robot: Robot, mock: RunningMock) -> None:
    before = mock.report()["calls"]
    place = robot.elsewhere()
    goal = robot.arrive(place, robot.system.give(f"去{place.name.zh}"))
    assert goal["brain"]["name"] == "mock"
    assert goal["brain"]["prompt"].startswith("plan/")
    assert goal["brain"]["fallback_from"] is None
    assert mock.report()["calls"] == before + 1


def test_an_idle_robot_with_a_page_open_asks_nothing(robot: Robot, mock: RunningMock) -> None:
    before = mock.report()["calls"]
    metered = robot.system.http("GET", "/v1/usage").body
    end_s = time.monotonic() + IDLE_S
    with connect(f"ws://127.0.0.1:{robot.system.port}/v1/events") as socket:
        shown = json.loads(socket.recv())["usage"]
        while time.monotonic() < end_s:
            assert json.loads(socket.recv())["kind"] != "usage"
    assert shown["today"] == metered["today"]
    after = robot.system.http("GET", "/v1/usage").body
    assert (after["today"], after["idle_calls"]) == (metered["today"], 0)
    counted = (mock.report()["calls"], after["calls_since_start"])
    assert counted == (before, metered["calls_since_start"])  # an unanswered call counts once


def spend_elsewhere(robot: Robot, calls: int) -> None:
    """Count calls as another program of the same home does."""
    day = date.fromisoformat(robot.system.http("GET", "/v1/usage").body["day"])
    with closing(Ledger.in_home(robot.system.home)) as ledger:
        ledger.settle(day, "elsewhere", Expense(calls=calls))


def test_a_spent_budget_is_told_and_the_offline_brain_plans(
    robot: Robot, mock: RunningMock
) -> None:
    """Another program of the same home spends what there is; the robot keeps to it at once."""
    spend_elsewhere(robot, 2000)
    before = mock.report()["calls"]
    waits = ended(robot, robot.system.give(SHORT))
    assert (waits["state"], waits["brain"]["fallback_reason"]) == ("succeeded", "out_of_budget")
    assert "midnight UTC" in waits["brain"]["fallback_message"]["en"]
    lost = ended(robot, robot.system.give(NONSENSE))
    assert lost["outcome"]["code"] == "out_of_budget"
    assert "都用完了" in lost["outcome"]["message"]["zh"]
    assert robot.system.http("GET", "/v1/usage").body["refused"]["code"] == "out_of_budget"
    assert mock.report()["calls"] == before
    spend_elsewhere(robot, -2000)


def test_a_stop_works_while_the_model_hangs(robot: Robot, mock: RunningMock) -> None:
    mock.set(fault="hang")
    goal = robot.system.give("go to the kitchen")
    assert goal["state"] == "planning"
    asked_s = time.monotonic()
    reply = robot.system.http("POST", "/v1/stop")
    assert reply.body["confirmed"] is True
    assert time.monotonic() - asked_s < TIMEOUT_S
    assert robot.system.until_goal(goal["id"], "paused", limit_s=1.0)["reason"] == "stop"
    robot.judge.assert_never_moves(TIMEOUT_S + 0.5)
    assert robot.system.goal(goal["id"])["state"] == "paused"


@pytest.mark.parametrize(
    ("switches", "why"),
    [
        (BadSwitches(fault="hang"), "timeout"),
        (BadSwitches(fault="garbage"), "bad_plan"),
        (BadSwitches(fault="status", status=429, retry_after="60"), "rate_limited"),
        (BadSwitches(fault="status", status=500), "server_error"),
        (BadSwitches(fault="hallucinate"), "bad_plan"),
        (BadSwitches(fault="huge"), "too_large"),
        (BadSwitches(fault="redirect"), "redirect"),
    ],
    ids=lambda value: value if isinstance(value, str) else value.fault,
)
def test_a_model_that_fails_is_replaced_or_the_goal_ends_typed(
    robot: Robot, mock: RunningMock, switches: BadSwitches, why: str
) -> None:
    began_s = time.monotonic()
    mock.set(**switches.model_dump())
    waits = ended(robot, robot.system.give(SHORT))
    assert (waits["state"], waits["brain"]["name"]) == ("succeeded", "offline")
    assert (waits["brain"]["fallback_from"], waits["brain"]["fallback_reason"]) == ("mock", why)
    assert waits["brain"]["fallback_message"]["zh"].endswith("。")
    lost = ended(robot, robot.system.give(NONSENSE))
    assert lost["state"] in ("failed", "refused")
    assert lost["reason"] in ("model_unavailable", "bad_plan")
    assert lost["brain"]["fallback_from"] == "mock"
    robot.judge.assert_stood(began_s)


def test_a_hallucinated_place_is_repaired(robot: Robot, mock: RunningMock) -> None:
    mock.set(fault="hallucinate", times=1)
    goal = robot.system.give("go to the kitchen", confirm=True)
    asked = robot.system.until_goal(goal["id"], "awaiting_confirmation", limit_s=10.0)
    assert asked["brain"]["name"] == "mock"
    assert [step["place"] for step in asked["plan"]["steps"]] == ["kitchen"]


def test_no_hostile_plan_moves_anything(robot: Robot, mock: RunningMock) -> None:
    began_s = time.monotonic()
    mock.set(fault="hostile")
    for _ in range((HOSTILE_COUNT + 1) // 2):  # each goal sees two of them
        goal = ended(robot, robot.system.give(NONSENSE))
        assert (goal["state"], goal["reason"]) == ("refused", "bad_plan"), goal
        assert goal["plan"] is None
    robot.judge.assert_stood(began_s)
