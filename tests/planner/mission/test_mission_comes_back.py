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
from tests.planner.mission.fakes import FACTS, outcome_of
from tests.planner.mission.seeing import ANNA, Seeing
from wire import Pose2

SEEK, KITCHEN = Find(object="cup", place="kitchen"), GoTo(place="kitchen")


OK, LOST, LEFT_OUT = StepState.SUCCEEDED, StepState.FAILED, StepState.SKIPPED


@pytest.fixture
def away() -> Seeing:
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


def test_nothing_found_is_told_where_the_order_was_given(away: Seeing) -> None:
    goal = give(away, SEEK, Say(text="here it is"), ComeBack(), Say(text="I found it"))
    while states(away.goal(goal))[0] is not LOST:
        away.see(0.2)
    assert away.bridge.pose.x_m > 2.0
    assert (away.goal(goal).state, away.goal(goal).replans) == (RUNNING, 1)
    away.see_until(goal, FAILED)
    mission = away.goal(goal)
    assert near(away, 0.4, -0.3)
    assert states(mission) == [LOST, LEFT_OUT, OK, LEFT_OUT]
    assert (mission.reason, away.said) == ("not_found", [])
    assert outcome_of(mission).code is Code.NOT_FOUND
    assert outcome_of(mission).message.en == (
        "I saw no cup. I looked in the kitchen. Arrived: where you gave the order. "
        "Not done: saying “here it is”, saying “I found it”."
    )
    assert "没有看到杯子" in outcome_of(mission).message.zh
    assert "我到了：下达指令的地方。" in outcome_of(mission).message.zh
    assert outcome_of(mission).message.zh.endswith("没有做：说“here it is”、说“I found it”。")
    reached = outcome_of(mission).reached
    assert reached is not None
    assert reached.room == "hall"


@pytest.mark.parametrize(
    ("steps", "after", "at"),
    [
        ((SEEK, KITCHEN, ReturnHome()), [LOST, LEFT_OUT, OK], (0.0, 0.5)),
        ((SEEK, ComeBack(), ReturnHome()), [LOST, OK, LEFT_OUT], (0.4, -0.3)),
    ],
)
def test_the_first_way_back_is_driven_and_nothing_else(
    away: Seeing, steps: tuple[Step, ...], after: list[StepState], at: tuple[float, float]
) -> None:
    goal = give(away, *steps)
    away.see_until(goal, FAILED)
    assert (states(away.goal(goal)), near(away, *at)) == (after, True)


def test_who_lost_a_person_comes_back(away: Seeing) -> None:
    away.things = (ANNA,)
    goal = give(away, Follow(object="me"), ComeBack())
    away.see(4.0)
    assert not near(away, 0.4, -0.3)
    away.things = ()
    away.see_until(goal, FAILED)
    outcome = outcome_of(away.goal(goal))
    assert (outcome.code, near(away, 0.4, -0.3)) == (Code.LOST_PERSON, True)


@pytest.mark.parametrize(("why", "step"), [("camera_silent", SEEK), ("no_route", KITCHEN)])
def test_any_other_failure_leaves_the_robot_where_it_stands(
    away: Seeing, why: str, step: Step
) -> None:
    goal = give(away, GoTo(place="dock"), step, ComeBack())
    while not near(away, 0.0, 0.5):
        away.see(0.2)
    if why == "no_route":
        away.way = lambda _: why
    else:
        away.blind = why
    away.see_until(goal, FAILED)
    mission = away.goal(goal)
    assert (mission.reason, states(mission)) == (why, [OK, LOST, LEFT_OUT])
    assert near(away, 0.0, 0.5)


def test_a_way_back_that_is_shut_is_told_after_what_was_looked_for(away: Seeing) -> None:
    goal = give(away, SEEK, ComeBack(), ReturnHome())
    while not away.goal(goal).returning:
        away.see(0.2)
    away.way = lambda _: "no_route"
    away.see_until(goal, FAILED)
    mission = away.goal(goal)
    assert states(mission) == [LOST, LOST, LEFT_OUT]
    assert (mission.reason, mission.steps[1].reason) == ("not_found", "no_route")
    assert outcome_of(mission).code is Code.NOT_FOUND
    assert outcome_of(mission).message.en.startswith("I saw no cup.")
    assert outcome_of(mission).message.en.endswith(
        "I found no way to where you gave the order. Not done: going to the dock."
    )


@pytest.mark.parametrize("crash", [False, True])
def test_the_way_back_keeps_its_place_over_a_pause_and_a_crash(away: Seeing, crash: bool) -> None:
    goal = give(away, SEEK, Say(text="never"), ComeBack())
    while not away.goal(goal).returning:
        away.see(0.2)
    away.see(1.0)
    world = away.restart() if crash else away
    if not crash:
        world.event(Pause(goal))
    world.run(0.2)
    assert world.goal(goal).state is PAUSED
    world.event(Resume(goal))
    world.act()
    mission = world.run_until(goal, FAILED)
    assert (states(mission), world.said) == ([LOST, LEFT_OUT, OK], [])
    assert hypot(world.bridge.pose.x_m - 0.4, world.bridge.pose.y_m + 0.3) < 0.1
    assert outcome_of(mission).code is Code.NOT_FOUND
    assert FACTS.targets["kitchen"].name.en in outcome_of(mission).message.en
