"""What a goal tells at its end is what was: each step that was begun, and none that was not."""

from __future__ import annotations

from typing import Any

import pytest

from planner.mission.events import Cancel, Reply
from planner.mission.replan import SAME_AGAIN
from planner.plan import (
    AnswerPlan,
    Ask,
    Bilingual,
    Code,
    Decide,
    GoTo,
    MoveStraight,
    Patrol,
    ReturnHome,
    Say,
    Step,
    Turn,
    Wait,
    say_same,
)
from tests.planner.mission.driving import CANCELLED, FAILED, SUCCEEDED
from tests.planner.mission.fakes import FACTS
from tests.planner.mission.lockstep import go
from tests.planner.mission.rethinking import Rethinking
from tests.planner.mission.test_mission_rethinks import plan, rethinking

DINNER = Say(text="dinner is ready")


def shut(world: Rethinking, *places: str) -> Rethinking:
    """Leave no way to some places."""
    poses = [FACTS.targets[place].pose for place in places]
    world.way = lambda ask: "no_route" if ask.goal in poses else None
    return world


def told(world: Rethinking, goal: str, *, state: Any = SUCCEEDED, code: Code | None = None) -> str:
    """Let a goal end, and return its sentence."""
    outcome = world.run_until(goal, state).outcome
    assert outcome is not None
    assert code is None or outcome.code is code
    return outcome.message.en


@pytest.mark.parametrize(
    ("steps", "code", "en"),
    [
        ((GoTo(place="kitchen"),), Code.ARRIVED, "Arrived: kitchen."),
        ((GoTo(place="kitchen"), ReturnHome()), Code.ARRIVED, "Arrived: kitchen, then dock."),
        ((GoTo(place="kitchen"), DINNER), Code.ARRIVED,
         "Arrived: kitchen. I said “dinner is ready”."),
        ((DINNER,), Code.DONE, "I said “dinner is ready”."),
        ((Wait(seconds=0.2), GoTo(place="hall")), Code.ARRIVED,
         "I waited 0.2 seconds. Arrived: hall."),
        ((Patrol(places=("kitchen", "hall")),), Code.ARRIVED,
         "Visited one after the other: kitchen, hall."),
    ],
)  # fmt: skip
def test_each_step_is_accounted_for(steps: tuple[Step, ...], code: Code, en: str) -> None:
    world = rethinking(plan(*steps))
    assert told(world, world.give(None), code=code) == en


def test_after_a_drive_that_failed_nobody_has_arrived() -> None:
    world = shut(rethinking(plan(GoTo(place="kitchen"), DINNER), plan(DINNER)), "kitchen")
    goal = world.give(None)
    assert told(world, goal, code=Code.DONE) == (
        "I found no way to the kitchen. Instead: I said “dinner is ready”."
    )
    message = world.goal(goal).outcome
    assert message is not None
    assert message.message.zh == "找不到去kitchen的路。改为：我说了“dinner is ready”。"


def test_who_has_been_to_a_place_and_finds_no_way_back_has_not_arrived() -> None:
    world = rethinking(go("kitchen", "hall", "kitchen"), plan(DINNER))
    goal = world.give(None)
    while world.goal(goal).step < 1:
        world.run()
    shut(world, "kitchen")
    assert told(world, goal, code=Code.DONE) == (
        "Been to: kitchen. Arrived: hall. I found no way to the kitchen. "
        "Instead: I said “dinner is ready”."
    )


def test_a_drive_that_was_never_begun_says_nothing_about_an_arrival() -> None:
    world = rethinking(go("hall", "dock", "kitchen", "dock"), AnswerPlan(text=say_same("no")))
    goal = world.give(None)
    shut(world, "kitchen")
    assert told(world, goal, state=FAILED) == (
        "Arrived: hall, then dock. I found no way to the kitchen. Not done: going to the dock."
    )


def test_another_place_that_was_gone_to_instead_is_told_so() -> None:
    world = shut(rethinking(go("kitchen", "hall"), go("hall")), "kitchen")
    assert told(world, world.give(None), code=Code.ARRIVED) == (
        "I found no way to the kitchen. Instead: Arrived: hall."
    )


def test_what_was_answered_is_told_whatever_a_brain_says_after_it() -> None:
    first = plan(GoTo(place="kitchen"), Ask(question="tea?"), Decide(question="what then?"))
    world = rethinking(first, AnswerPlan(text=say_same("I was told.")))
    goal = world.give(None)
    while not world.goal(goal).outcome:
        world.run()
    world.event(Reply(goal, "green tea"))
    assert told(world, goal, code=Code.ANSWERED) == (
        "Arrived: kitchen. I asked “tea?”, and the answer was “green tea”. I was told."
    )


def test_what_failed_and_what_was_left_undone_are_named() -> None:
    first = plan(DINNER, GoTo(place="kitchen"), Turn(angle_rad=1.0), MoveStraight(distance_m=0.5),
                 Patrol(places=("hall", "kitchen")), Ask(question="tea?"))  # fmt: skip
    world = shut(rethinking(first, None), "kitchen")
    world.thoughts[1] = first  # the same again
    assert told(world, world.give(None), state=FAILED, code=Code.NO_ROUTE) == (
        "I said “dinner is ready”. I found no way to the kitchen. Not done: turning 57° to the "
        "left, driving 0.5 m forward, visiting hall, kitchen, asking “tea?”."
    )


def test_a_patrol_that_ends_on_its_way_names_the_stops_it_made() -> None:
    world = rethinking(
        plan(Patrol(places=("hall", "kitchen", "dock"))), AnswerPlan(text=say_same("no"))
    )
    goal = world.give(None)
    shut(world, "dock")
    en = told(world, goal, state=FAILED)
    assert en == "Visited one after the other: hall, kitchen. I found no way to the dock."


def test_a_cancelled_goal_tells_what_it_said_before() -> None:
    world = rethinking(plan(DINNER, GoTo(place="kitchen")))
    goal = world.give(None)
    while not world.goal(goal).metres and world.bridge.pose.x_m < 1.0:
        world.run()
    world.event(Cancel(goal))
    assert told(world, goal, state=CANCELLED) == "I said “dinner is ready”. Cancelled."


def test_thoughts_that_are_used_up_are_no_distance_and_no_time() -> None:
    again = [plan(Wait(seconds=0.1 * n), Decide(question="?")) for n in range(1, 6)]
    world = rethinking(*again)
    goal = world.give(None)
    en = told(world, goal, state=FAILED, code=Code.OUT_OF_BUDGET)
    assert world.goal(goal).reason == "thoughts"
    assert en.endswith("I have used up what I may for this: 3 thoughts under way.")
    assert "distance" not in en


def test_the_same_steps_again_are_named_in_both_languages() -> None:
    again = plan(Wait(seconds=0.1), Decide(question="?"))
    world = rethinking(again, again)
    goal = world.give(None)
    en = told(world, goal, state=FAILED, code=Code.BAD_PLAN)
    outcome = world.goal(goal).outcome
    assert outcome is not None
    assert SAME_AGAIN.en in en
    assert SAME_AGAIN.zh in outcome.message.zh
    assert SAME_AGAIN.en not in outcome.message.zh


def test_a_cause_is_told_to_a_later_thought_too() -> None:
    """The first failure's words outlive the second's."""
    first, second = go("kitchen", "dock"), go("dock")
    world = shut(rethinking(first, second, plan(DINNER)), "kitchen", "dock")
    world.run_until(world.give(None), SUCCEEDED)
    details: list[Bilingual] = [each.detail for each in world.asked[2].observed]
    assert [d.en for d in details] == [
        "I found no way to the kitchen.",
        "I found no way to the dock.",
    ]
