"""Who is sent to look and to come back comes back with nothing, too: that way alone is driven."""

from __future__ import annotations

from math import hypot

import pytest

from planner.mission.events import Pause, Resume
from planner.mission.state import Mission
from planner.plan import (
    Code,
    ComeBack,
    Find,
    Follow,
    GoTo,
    ReturnHome,
    Say,
    Step,
    StepPlan,
    StepState,
)
from tests.planner.mission.driving import FAILED, PAUSED, RUNNING
from tests.planner.mission.fakes import FACTS
from tests.planner.mission.seeing import ANNA, Seeing
from wire import Pose2

CUP, KITCHEN = Find(object="cup", place="kitchen"), GoTo(place="kitchen")
OK, LOST, LEFT_OUT = StepState.SUCCEEDED, StepState.FAILED, StepState.SKIPPED


@pytest.fixture
def seeing() -> Seeing:
    world = Seeing()
    world.open_eyes()
    world.bridge.pose = Pose2(0.4, -0.3, 0.0)
    world.run(0.2)
    return world


def give(world: Seeing, *steps: Step) -> str:
    """Give a goal to a brain that has no second idea."""
    return world.give(StepPlan(steps=steps))


def states(mission: Mission) -> list[StepState]:
    return [step.state for step in mission.steps]


def near(world: Seeing, x_m: float, y_m: float) -> bool:
    return hypot(world.bridge.pose.x_m - x_m, world.bridge.pose.y_m - y_m) < 0.1


def test_nothing_found_is_told_where_the_order_was_given(seeing: Seeing) -> None:
    goal = give(seeing, CUP, Say(text="here it is"), ComeBack(), Say(text="I found it"))
    while states(seeing.goal(goal))[0] is not LOST:
        seeing.see(0.2)
    assert seeing.bridge.pose.x_m > 2.0
    assert (seeing.goal(goal).state, seeing.goal(goal).replans) == (RUNNING, 1)
    seeing.see_until(goal, FAILED)
    mission = seeing.goal(goal)
    assert near(seeing, 0.4, -0.3)
    assert states(mission) == [LOST, LEFT_OUT, OK, LEFT_OUT]
    assert (mission.reason, seeing.said) == ("not_found", [])
    assert mission.outcome is not None
    assert mission.outcome.code is Code.NOT_FOUND
    assert mission.outcome.message.en == (
        "I saw no cup. I looked in the kitchen. Arrived: where you gave the order. "
        "Not done: saying “here it is”, saying “I found it”."
    )
    assert "没有看到杯子" in mission.outcome.message.zh
    assert "我到了：下达指令的地方。" in mission.outcome.message.zh
    assert mission.outcome.message.zh.endswith("没有做：说“here it is”、说“I found it”。")
    assert mission.outcome.reached is not None
    assert mission.outcome.reached.room == "hall"


@pytest.mark.parametrize(
    ("steps", "after", "at"),
    [
        ((CUP, KITCHEN, ReturnHome()), [LOST, LEFT_OUT, OK], (0.0, 0.5)),
        ((CUP, ComeBack(), ReturnHome()), [LOST, OK, LEFT_OUT], (0.4, -0.3)),
    ],
)
def test_the_first_way_back_is_driven_and_nothing_else(
    seeing: Seeing, steps: tuple[Step, ...], after: list[StepState], at: tuple[float, float]
) -> None:
    goal = give(seeing, *steps)
    seeing.see_until(goal, FAILED)
    assert (states(seeing.goal(goal)), near(seeing, *at)) == (after, True)


def test_who_lost_a_person_comes_back(seeing: Seeing) -> None:
    seeing.things = (ANNA,)
    goal = give(seeing, Follow(object="me"), ComeBack())
    seeing.see(4.0)
    assert not near(seeing, 0.4, -0.3)
    seeing.things = ()
    seeing.see_until(goal, FAILED)
    outcome = seeing.goal(goal).outcome
    assert outcome is not None
    assert (outcome.code, near(seeing, 0.4, -0.3)) == (Code.LOST_PERSON, True)


@pytest.mark.parametrize(("why", "step"), [("camera_silent", CUP), ("no_route", KITCHEN)])
def test_any_other_failure_leaves_the_robot_where_it_stands(
    seeing: Seeing, why: str, step: Step
) -> None:
    goal = give(seeing, GoTo(place="dock"), step, ComeBack())
    while not near(seeing, 0.0, 0.5):
        seeing.see(0.2)
    if why == "no_route":
        seeing.way = lambda _: why
    else:
        seeing.blind = why
    seeing.see_until(goal, FAILED)
    mission = seeing.goal(goal)
    assert (mission.reason, states(mission)) == (why, [OK, LOST, LEFT_OUT])
    assert near(seeing, 0.0, 0.5)


def test_a_way_back_that_is_shut_is_told_after_what_was_looked_for(seeing: Seeing) -> None:
    goal = give(seeing, CUP, ComeBack(), ReturnHome())
    while not seeing.goal(goal).returning:
        seeing.see(0.2)
    seeing.way = lambda _: "no_route"
    seeing.see_until(goal, FAILED)
    mission = seeing.goal(goal)
    assert states(mission) == [LOST, LOST, LEFT_OUT]
    assert (mission.reason, mission.steps[1].reason) == ("not_found", "no_route")
    assert mission.outcome is not None
    assert mission.outcome.code is Code.NOT_FOUND
    assert mission.outcome.message.en.startswith("I saw no cup.")
    assert mission.outcome.message.en.endswith(
        "I found no way to where you gave the order. Not done: going to the dock."
    )


@pytest.mark.parametrize("crash", [False, True])
def test_the_way_back_keeps_its_place_over_a_pause_and_a_crash(seeing: Seeing, crash: bool) -> None:
    goal = give(seeing, CUP, Say(text="never"), ComeBack())
    while not seeing.goal(goal).returning:
        seeing.see(0.2)
    seeing.see(1.0)
    world = seeing.restart() if crash else seeing
    if not crash:
        world.event(Pause(goal))
    world.run(0.2)
    assert world.goal(goal).state is PAUSED
    world.event(Resume(goal))
    world.act()
    mission = world.run_until(goal, FAILED)
    assert (states(mission), world.said) == ([LOST, LEFT_OUT, OK], [])
    assert hypot(world.bridge.pose.x_m - 0.4, world.bridge.pose.y_m + 0.3) < 0.1
    assert mission.outcome is not None
    assert mission.outcome.code is Code.NOT_FOUND
    assert FACTS.targets["kitchen"].name.en in mission.outcome.message.en
