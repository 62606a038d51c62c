"""Three hundred calls that mean ill, and more: judged by the journal and what the bridge heard."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, cast

import httpx
import pytest
from mcp import Client, MCPError

from planner.api import build
from planner.orders.factory import standing_orders_of
from planner.people import Person, Role
from planner.plan import GoalState, StepPlan, Wait
from planner.settings import OrderSettings
from planner.state_database import StateDatabase
from pons.mcp.planner_door import TOKEN, PlannerDoor
from pons.mcp.server import build_server
from tests.planner.api.fakes import FakeServices, two_room
from tests.planner.api.served import BASE
from tests.planner.api.test_agents import ACCESS, SINCE, Everywhere
from tests.planner.api.test_real_missions import CONFIRMS, OPERATOR, VIEWER, Caller, later
from tests.planner.mission import live
from tests.planner.mission.live import KITCHEN, Together, begun_steps, read_transitions, run
from tests.pons.mcp.hostile_calls import OTHER, OWN, PERSON, HostileCall, hostile_calls
from wire import Stop, Waypoints

pytestmark = pytest.mark.timeout(600)
AGENTS = {
    f"agent-{number:08}": Person(f"a{number}", f"A{number}", Role.AGENT, SINCE)
    for number in range(60)
}
"""So many that the bound on each one's rate refuses nothing: what is tried here is the rest."""
CALLER, *CROWD = AGENTS
WRONG = ("", OPERATOR, VIEWER, "w" * 16)
FLOOD = 60
OPEN = (CONFIRMS, GoalState.NEEDS_CLARIFICATION, GoalState.QUEUED)


@dataclass
class Home:
    """Hold what the calls are made against, and the ids of the goals that stand there."""

    world: Together
    services: FakeServices
    door: PlannerDoor
    goals: dict[str, str]

    def call_of(self, call: HostileCall) -> dict[str, Any]:
        """Return the arguments with the goals' ids."""
        text = json.dumps(call.given)
        for name, goal in self.goals.items():
            text = text.replace(name, goal)
        return dict(json.loads(text))


@asynccontextmanager
async def besieged(home: Path) -> AsyncIterator[Home]:
    """Serve real missions whose model drives to the kitchen whatever is said; three goals wait."""
    stands = StepPlan(steps=(Wait(seconds=600.0),))
    script = (stands, KITCHEN)
    async with live.planner(home, two_room(), *script, by_grammar=False) as world:
        services, database = FakeServices(), StateDatabase(home)
        services.goals = cast("Any", world.missions)
        zone = OrderSettings(timezone="Europe/Berlin")
        services.orders = standing_orders_of(zone, home, database, world.missions)
        rules = replace(ACCESS, find_person=AGENTS.get)
        way = Everywhere(app=build(cast("Any", services), rules))
        door = PlannerDoor(BASE, way)
        async with httpx.AsyncClient(transport=way, base_url=BASE) as http:
            goals = {}
            for name, token, state in (
                (OTHER, CROWD[0], GoalState.RUNNING),
                (PERSON, OPERATOR, CONFIRMS),
                (OWN, CALLER, CONFIRMS),
            ):
                goals[name] = await Caller(http, token).give("wait ten minutes, please")
                await world.reach(goals[name], state)
            yield Home(world, services, door, goals)
        await door.close()
        database.close()


def assert_unmoved(home: Path, besieged: Home) -> None:
    """Hold bridge and journal to it that nothing moved, and that no role was broken."""
    heard = besieged.world.bridge.heard
    assert not [one for one in heard if isinstance(one, Waypoints | Stop)]
    assert besieged.world.bridge.answers == ()
    robot = besieged.services.robot
    assert [robot.asked, robot.steers, robot.offered, robot.drawn, robot.hints] == [[]] * 5
    written = read_transitions(home)
    states: dict[str, set[GoalState]] = {}
    for mission in written:
        states.setdefault(mission.id, set()).add(mission.state)
    planned = {GoalState.PLANNING}
    assert states[besieged.goals[OTHER]] <= planned | {GoalState.QUEUED, GoalState.RUNNING}
    assert states[besieged.goals[PERSON]] <= planned | {CONFIRMS}
    assert states[besieged.goals[OWN]] <= planned | {CONFIRMS}
    assert begun_steps(written) == {"wait"}


def test_three_hundred_hostile_calls_move_nothing_and_break_no_role(tmp_path: Path) -> None:
    counted: Counter[str] = Counter()
    wrong: list[tuple[HostileCall, str]] = []

    async def story() -> None:
        async with besieged(tmp_path) as home, Client(build_server(home.door)) as client:
            for number, call in enumerate(hostile_calls(WRONG)):
                TOKEN.set(CALLER if call.kind in ("yes", "foreign") else CROWD[number % 50 + 1])
                if call.token is not None:
                    TOKEN.set(call.token)
                said = await ask(client, call.tool, home.call_of(call))
                counted[call.kind] += 1
                if call.is_refused and said is not None:
                    wrong.append((replace(call, given={}), said))
                await end_agents_goals(home)
            TOKEN.set(CROWD[55])
            flood = [await ask(client, "order", {"text": "what a day"}) for _ in range(FLOOD)]
            counted["flood"] = FLOOD
            assert None in flood
            await later(home.world)
            await end_agents_goals(home)
            assert_unmoved(tmp_path, home)

    run(story())
    assert wrong == []
    assert sum(counted.values()) >= 300
    assert min(counted.values()) >= 10


async def ask(client: Client, tool: str, given: dict[str, Any]) -> str | None:
    """Call a tool; return what it said, None where it refused."""
    try:
        result = await client.call_tool(tool, given)
    except MCPError:
        return None
    return None if result.is_error else json.dumps(result.structured_content)


async def end_agents_goals(home: Home) -> None:
    """End what the agents gave, so that the bound on open goals refuses nothing, either."""
    kept = set(home.goals.values())
    for goal in home.world.missions.goals():
        if goal.id not in kept and goal.state in OPEN:
            await home.world.missions.cancel(goal.id)
