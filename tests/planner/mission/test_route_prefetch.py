"""Check that a plan is shown as it is written, and that its first way is searched ahead of it."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from dataclasses import dataclass, field, replace
from typing import Any

import pytest

from planner.brain.streamed_draft import Draft
from planner.mission.event_hub import Subscription
from planner.mission.plan_request import TELL_S, Hearing
from planner.mission.state import MissionState
from planner.mission.tasks import KEPT_S, RouteAhead
from planner.navigation import RouteFailure, RoutePoint, RouteRequest, RouteResult
from planner.plan import GoalState, GoTo, ReturnHome, Step, Wait
from tests.planner.mission.fakes import FACTS, status
from tests.planner.mission.live import KITCHEN as KITCHEN_PLAN
from tests.planner.mission.live import Starter, StraightRouter
from wire import Pose2, Twist2

HERE = Pose2(0.0, 0.0, 0.0)
KITCHEN = FACTS.targets["kitchen"].pose
DOCK = FACTS.targets["dock"].pose
STANDING = MissionState(FACTS, status=status(), status_s=0.0)
GO: tuple[Step, ...] = (GoTo(place="kitchen"),)


@dataclass
class Search:
    """Find every way, and remember what was asked."""

    fails: bool = False
    asked: list[RouteRequest] = field(default_factory=list)

    async def route(self, request: RouteRequest) -> RouteResult:
        self.asked.append(request)
        await asyncio.sleep(0)
        if self.fails and len(self.asked) == 1:
            raise RouteFailure("no_route")
        goal = request.goal
        return RouteResult((RoutePoint(goal.x_m, goal.y_m, 0.5),), 1.0, 0.0, False, 0.0)


@dataclass
class Clock:
    """Tell the time that a test sets."""

    now_s: float = 0.0

    def __call__(self) -> float:
        return self.now_s


@dataclass(frozen=True)
class Standstill:
    """Hold one state of the missions."""

    book: MissionState


async def asked_after(
    search: Search,
    steps: tuple[Step, ...],
    request: RouteRequest,
    book: MissionState,
    late_s: float,
) -> int:
    """Expect, then ask; return how many routes were there already."""
    clock = Clock()
    ahead = RouteAhead(search, Standstill(book), clock)
    ahead.expect(steps)
    await asyncio.sleep(0)
    clock.now_s = late_s
    result = await ahead.route(request)
    assert result.points[0].x_m == request.goal.x_m
    await ahead.close()
    return ahead.used


@pytest.mark.parametrize(
    ("steps", "request_", "searches", "used"),
    [
        (GO, RouteRequest(HERE, KITCHEN), 1, 1),
        (GO, RouteRequest(Pose2(0.05, 0.0, 2.0), KITCHEN), 1, 1),
        ((ReturnHome(),), RouteRequest(HERE, DOCK), 1, 1),
        (GO, RouteRequest(HERE, DOCK), 2, 0),
        (GO, RouteRequest(Pose2(0.5, 0.0, 0.0), KITCHEN), 2, 0),
        (GO, RouteRequest(HERE, KITCHEN, ((1.0, 1.0),)), 2, 0),
        (GO, RouteRequest(HERE, KITCHEN, straight=True), 2, 0),
        ((Wait(seconds=1.0), *GO), RouteRequest(HERE, KITCHEN), 1, 0),
        ((GoTo(place="nowhere"),), RouteRequest(HERE, KITCHEN), 1, 0),
        ((), RouteRequest(HERE, KITCHEN), 1, 0),
    ],
)
def test_what_was_searched_ahead_serves_the_same_way_alone(
    steps: tuple[Step, ...], request_: RouteRequest, searches: int, used: int
) -> None:
    search = Search()
    assert asyncio.run(asked_after(search, steps, request_, STANDING, 1.0)) == used
    assert len(search.asked) == searches


@pytest.mark.parametrize(
    "book",
    [
        MissionState(FACTS),
        replace(STANDING, status=status(base_in_map=None)),
        replace(STANDING, status=status(measured=Twist2(0.3, 0.0))),
        replace(STANDING, running="g0"),
        replace(STANDING, queue=("g0",)),
    ],
)
def test_nothing_is_searched_ahead_where_the_start_is_unknown(book: MissionState) -> None:
    search = Search()
    assert asyncio.run(asked_after(search, GO, RouteRequest(HERE, KITCHEN), book, 0.0)) == 0
    assert len(search.asked) == 1


def test_an_old_way_and_a_failure_are_searched_again() -> None:
    for search, late_s in ((Search(), KEPT_S + 1.0), (Search(fails=True), 0.0)):
        asked = RouteRequest(HERE, KITCHEN)
        assert asyncio.run(asked_after(search, GO, asked, STANDING, late_s)) == 0
        assert len(search.asked) == 2


def test_a_draft_is_told_at_once_then_now_and_then_and_its_steps_are_expected() -> None:
    told: list[dict[str, Any]] = []
    expected: list[tuple[Step, ...]] = []
    clock = Clock()
    hear = Hearing(told.append, expected.append, clock).of("g1")
    for number in range(10):
        clock.now_s = number * TELL_S / 4
        hear(Draft(text="{" * (number + 1), steps=GO if number > 4 else ()))
    assert [event["text"] for event in told] == ["{", "{" * 5, "{" * 9]
    assert told[-1] == {
        "type": "thinking",
        "goal": "g1",
        "text": "{" * 9,
        "steps": [{"kind": "go_to", "place": "kitchen"}],
    }
    assert expected == [GO]


class CountingRouter(StraightRouter):
    """Count the ways that were searched."""

    searched = 0

    async def route(self, request: RouteRequest) -> RouteResult:
        self.searched += 1
        return await super().route(request)


@pytest.mark.parametrize(("drafted", "searches"), [("kitchen", 1), ("living_room", 2)])
async def test_a_draft_is_shown_and_the_robot_moves_by_the_whole_plan_alone(
    start: Starter, drafted: str, searches: int
) -> None:
    """A draft that names another place than the plan in the end leads nowhere."""
    router, draft = CountingRouter(), Draft(text="{", steps=(GoTo(place=drafted),))
    async with start(KITCHEN_PLAN, router=router) as together:
        together.brain.drafts, together.brain.delay_s = (draft,), 0.02
        async with together.missions.subscribe() as changes:
            goal = await together.missions.submit("go to the kitchen")
            done = await together.reach(goal.id, GoalState.SUCCEEDED)
            shown = [change async for _, change in until_running(changes)]
        assert done.plan is not None
        assert [step.place for step in done.plan.steps] == ["kitchen"]
        assert [each["text"] for each in shown if each["type"] == "thinking"] == ["{"]
    assert router.searched == searches


async def until_running(changes: Subscription) -> AsyncIterator[tuple[int, dict[str, Any]]]:
    async for change in changes:
        yield change
        if change[1]["type"] == "goal" and change[1]["goal"]["state"] == "running":
            return
