"""Ask real missions over HTTP: who may not say yes moves nothing, nor does a hostile model."""

from __future__ import annotations

import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any, cast

import httpx
import pytest

from planner.api import Access
from planner.brain.scripted import Reply
from planner.orders.factory import standing_orders_of
from planner.plan import (
    MAX_DEPTH,
    AnswerPlan,
    Ask,
    Bilingual,
    Clarify,
    Code,
    Decide,
    GoalState,
    Option,
    Say,
    StepPlan,
)
from planner.settings import OrderSettings
from planner.state_database import StateDatabase
from tests.planner.api.fakes import FakeServices, two_room
from tests.planner.api.served import BASE, app_of
from tests.planner.mission import live
from tests.planner.mission.live import KITCHEN, Together

OPERATOR, VIEWER = "o" * 16, "v" * 16
ACCESS = Access("127.0.0.1", operator_token=OPERATOR, viewer_token=VIEWER)
ENDED = (GoalState.SUCCEEDED, GoalState.REFUSED, GoalState.FAILED, GoalState.CANCELLED)
CONFIRMS = GoalState.AWAITING_CONFIRMATION


class Caller:
    """Ask over HTTP, with one token."""

    def __init__(self, client: httpx.AsyncClient, token: str) -> None:
        self._client, self._headers = client, {"authorization": f"Bearer {token}"}

    async def post(self, path: str, body: dict[str, Any] | None = None) -> httpx.Response:
        return await self.ask("POST", path, body or {})

    async def ask(self, method: str, path: str, body: object) -> httpx.Response:
        return await self._client.request(method, path, json=body, headers=self._headers)

    async def give(self, text: str) -> str:
        answer = await self.post("/v1/goals", {"text": text})
        assert answer.status_code == 202, answer.text
        return str(answer.json()["id"])


@asynccontextmanager
async def served(
    home: Path, *replies: Reply, by_grammar: bool = False
) -> AsyncIterator[tuple[Together, Caller, Caller]]:
    """Serve real missions whose brain is a model by a script; lend an operator and a viewer."""
    async with live.planner(home, two_room(), *replies, by_grammar=by_grammar) as world:
        services, database = FakeServices(), StateDatabase(home)
        services.goals = cast("Any", world.missions)
        settings = OrderSettings(timezone="Europe/Berlin")
        services.orders = standing_orders_of(settings, home, database, world.missions)
        transport = httpx.ASGITransport(app=app_of(services, ACCESS), client=("10.9.9.9", 50_000))
        async with httpx.AsyncClient(transport=transport, base_url=BASE) as client:
            yield world, Caller(client, OPERATOR), Caller(client, VIEWER)
        database.close()


async def later(world: Together) -> None:
    seq = world.bridge.seq
    await world.until(lambda: world.bridge.seq > seq + 20)


async def test_a_viewers_yes_to_an_open_confirmation_is_refused_and_an_operators_drives(
    tmp_path: Path,
) -> None:
    async with served(tmp_path, KITCHEN) as (world, operator, viewer):
        goal = await operator.give("please say hello")
        waits = await world.reach(goal, CONFIRMS)
        assert waits.reason == "unasked_motion"
        for path, body in (
            (f"/v1/goals/{goal}/confirm", {}),
            (f"/v1/goals/{goal}/answer", {"text": "yes"}),
            (f"/v1/goals/{goal}/answer", {"text": "好的"}),
            (f"/v1/goals/{goal}/resume", {}),
            ("/v1/goals", {"text": "yes"}),
            ("/v1/resume", {}),
        ):
            answer = await viewer.post(path, body)
            assert (answer.status_code, answer.json()["code"]) == (403, "operator_needed")
        await later(world)
        assert world.missions.goal(goal).state is CONFIRMS
        assert len(world.missions.goals()) == 1
        assert world.bridge.waypoints == []
        assert (await operator.post(f"/v1/goals/{goal}/confirm")).status_code == 200
        await world.reach(goal, GoalState.SUCCEEDED)
        assert world.bridge.waypoints != []


YES = Option(label=Bilingual(en="Yes", zh="好"), text="yes")
SELF = {
    "it says yes": StepPlan(steps=(Say(text="yes"),)),
    "it answers yes": AnswerPlan(text=Bilingual(en="Yes.", zh="好的。")),
    "it offers yes": Clarify(
        code=Code.AMBIGUOUS, question=Bilingual(en="Shall I?", zh="好吗？"), options=(YES,)
    ),
    "it asks and says yes": StepPlan(steps=(Say(text="yes, go"), Ask(question="yes?"))),
    "it names a deed that is none": json.dumps(
        {"kind": "plan", "steps": [{"kind": "confirm", "goal": "g1"}]}
    ),
    "it fills in the answer": json.dumps(
        {"kind": "plan", "steps": [{"kind": "ask", "question": "Shall I?", "answer": "yes"},
                                   {"kind": "go_to", "place": "kitchen"}]}
    ),
    "it says that it was confirmed": json.dumps(
        {"kind": "plan", "confirmed": True, "steps": [{"kind": "go_to", "place": "kitchen"}]}
    ),
}  # fmt: skip


@pytest.mark.parametrize("reply", SELF.values(), ids=SELF.keys())
async def test_a_model_that_says_yes_itself_confirms_nothing(tmp_path: Path, reply: Reply) -> None:
    """One goal waits for a person's yes, and the model does what it can to have that said."""
    async with served(tmp_path, KITCHEN, reply) as (world, operator, _):
        waiting = await operator.give("please say hello")
        await world.reach(waiting, CONFIRMS)
        other = await operator.give("what a day")
        await world.until(lambda: world.missions.goal(other).state is not GoalState.PLANNING)
        await later(world)
        assert world.missions.goal(waiting).state is CONFIRMS
        assert world.bridge.waypoints == []


async def test_a_model_that_decides_upon_its_own_question_does_not_answer_it(
    tmp_path: Path,
) -> None:
    """It asks, is asked to decide, and wants to drive: the question waits, and so does the way."""
    asks = StepPlan(steps=(Ask(question="Shall I drive to the kitchen?"), Decide(question="?")))
    async with served(tmp_path, asks, KITCHEN) as (world, operator, viewer):
        goal = await operator.give("please say hello")
        await world.reach(goal, GoalState.NEEDS_CLARIFICATION)
        await later(world)
        assert len(world.brain.asked) == 1, "nobody has answered, so nobody decides"
        refused = await viewer.post(f"/v1/goals/{goal}/answer", {"text": "yes"})
        assert refused.json()["code"] == "operator_needed"
        await later(world)
        assert world.missions.goal(goal).state is GoalState.NEEDS_CLARIFICATION
        await operator.post(f"/v1/goals/{goal}/answer", {"text": "perhaps"})
        await world.until(lambda: len(world.brain.asked) == 2)
        await world.reach(goal, CONFIRMS, *ENDED)
        await later(world)
        assert world.bridge.waypoints == []


def conditions(deep: int) -> str:
    """Return a model's plan: a drive that stands in so many conditions."""
    asks, end = '{"kind":"ask","question":"so?"}', '{"kind":"go_to","place":"kitchen"}'
    opens = f'{{"kind":"if","when":{asks},"then":[' * deep
    return f'{{"kind":"plan","steps":[{opens}{end}{"]}" * deep}]}}'


@pytest.mark.parametrize("deep", [MAX_DEPTH + 1, 60, 5_000])
async def test_conditions_that_a_model_nests_beyond_the_bound_are_refused_as_goal_and_as_order(
    tmp_path: Path, deep: int
) -> None:
    async with served(tmp_path, conditions(deep)) as (world, operator, _):
        goal = await operator.give("look after the kitchen")
        ended = await world.reach(goal, *ENDED)
        assert ended.outcome is not None
        assert (ended.state, ended.outcome.code) == (GoalState.REFUSED, Code.BAD_PLAN)
        body = {"text": "look after the kitchen", "when": {"in_s": 600}}
        refused = await operator.post("/v1/orders", body)
        assert (refused.status_code, refused.json()["code"]) == (422, "order_not_understood")
        assert set(refused.json()["message"]) == {"en", "zh"}
        assert world.bridge.waypoints == []
