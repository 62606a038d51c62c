"""Run the missions on a real event loop against a bridge that answers in real time."""

from __future__ import annotations

import asyncio
import sqlite3
from collections.abc import AsyncIterator, Callable, Coroutine
from contextlib import AbstractAsyncContextManager, asynccontextmanager
from itertools import count
from math import hypot
from pathlib import Path
from typing import Any

from planner.brain import Brain
from planner.brain.image_questions import Looker
from planner.brain.scripted import Reply, ScriptedBrain
from planner.bridge_client import Link
from planner.mission import Clocks, JournalSync, MissionJournal, Missions
from planner.mission.journal_records import read_mission
from planner.mission.perception_requests import nothing_spent
from planner.mission.state import Mission
from planner.navigation import RouteFailure, RouteRequest, RouteResult
from planner.perception.interfaces import Eyes
from planner.plan import Goal, GoalState, GoTo, StepPlan, StepState
from planner.site import Site
from planner.site.known_places import KnownPlaces
from planner.skills.perception import NO_PICTURES, PictureLimits
from tests.planner.mission.fakes import PERIOD_S, FakeBridge, straight
from wire import Pose2, RobotDescription, Status

POLL_S = 0.002
"""The bridge goes on at each poll: with the planner's own 5 ms tests would mostly sleep."""
KITCHEN = StepPlan(steps=(GoTo(place="kitchen"),))
SOFA = StepPlan(steps=(GoTo(place="sofa"),))


class LiveBridge(FakeBridge):
    """Go on by one status at each poll; the clock of the test goes with it."""

    frozen = False

    def status(self) -> Status | None:
        return None if self.frozen else self.step()

    def now_s(self) -> float:
        return 1000.0 + self.seq * PERIOD_S


class StraightRouter:
    """Answer with straight lines, or with a failure."""

    def __init__(self, failure: str | None = None) -> None:
        self.failure = failure

    async def route(self, request: RouteRequest) -> RouteResult:
        await asyncio.sleep(0)
        if self.failure is not None:
            raise RouteFailure(self.failure)
        way_m = hypot(request.goal.x_m - request.start.x_m, request.goal.y_m - request.start.y_m)
        return RouteResult(straight(request.start, request.goal), way_m, 0.0, False, 0.0)


class Together:
    """Hold one planner's door and the bridge behind it."""

    def __init__(self, missions: Missions, bridge: LiveBridge, brain: ScriptedBrain) -> None:
        self.missions, self.bridge, self.brain = missions, bridge, brain

    async def until(self, fits: Callable[[], bool], limit_s: float = 20.0) -> None:
        async with asyncio.timeout(limit_s):
            while not fits():  # noqa: ASYNC110  # what is waited for is many things
                await asyncio.sleep(0.002)

    async def reach(self, goal_id: str, *states: GoalState) -> Goal:
        await self.until(lambda: self.missions.goal(goal_id).state in states)
        return self.missions.goal(goal_id)

    async def give(self, text: str, *states: GoalState, **more: Any) -> Goal:
        """Submit a sentence; return its goal once it is in one of these states."""
        return await self.reach((await self.missions.submit(text, **more)).id, *states)

    async def drive(self, text: str = "go to the kitchen") -> Goal:
        """Submit a sentence; return its goal once the robot drives."""
        goal = await self.give(text, GoalState.RUNNING)
        await self.until(lambda: self.bridge.horizon is not None)
        return goal


Starter = Callable[..., AbstractAsyncContextManager[Together]]
"""Starts missions as ``planner`` does, in a home and a site of the test's own."""


@asynccontextmanager
async def planner(
    home: Path,
    site: Site | KnownPlaces,
    *replies: Reply,
    bridge: LiveBridge | None = None,
    hangs: bool = False,
    router: StraightRouter | None = None,
    prefix: str = "g",
    eyes: Eyes | None = None,
    looker: Looker | None = None,
    pictures: PictureLimits = NO_PICTURES,
    by_grammar: bool = True,
    thinker: Brain | None = None,
) -> AsyncIterator[Together]:
    """Start missions; they think by the script of replies, or by a brain that is given."""
    bridge = bridge or LiveBridge(pose=Pose2(1.0, 4.2, 0.0))
    brain = ScriptedBrain(replies or (KITCHEN,), hangs=hangs, by_grammar=by_grammar)
    numbers = count(1)
    robot = RobotDescription()
    missions = Missions(
        site=site,
        robot=robot,
        link=Link(bridge, robot, clock=bridge.now_s),
        router=router or StraightRouter(),
        brain=thinker or brain,
        disk=JournalSync(MissionJournal.in_home(home)),
        planner_id=f"planner-{prefix}",
        clocks=Clocks(bridge.now_s, lambda: 1.7e9, lambda: f"{prefix}{next(numbers)}", POLL_S),
    )
    if eyes is not None:
        missions.see(eyes, looker)
        missions.loop.bound_search(pictures, nothing_spent)
    await missions.start()
    together = Together(missions, bridge, brain)
    try:
        await together.until(lambda: bridge.owner == missions.planner_id)
        yield together
        assert missions.loop.failure is None
    finally:
        await missions.close()


def read_transitions(home: Path) -> list[Mission]:
    """Return each state that each goal was in, oldest first, from the journal on the disk."""
    with sqlite3.connect(f"file:{home}/missions.db?mode=ro", uri=True) as disk:
        rows = disk.execute("SELECT record FROM transitions ORDER BY seq").fetchall()
    return [read_mission(record) for (record,) in rows]


def begun_steps(missions: list[Mission]) -> set[str]:
    """Return the kinds of all steps that were ever begun."""
    waits = (StepState.PENDING, StepState.SKIPPED)
    return {step.kind for each in missions for step in each.steps if step.state not in waits}


def run(work: Coroutine[Any, Any, None]) -> None:
    asyncio.run(work)
