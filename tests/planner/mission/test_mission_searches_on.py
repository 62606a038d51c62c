"""A search that ran out in a large home: what is offered, what a yes goes on with, and a no."""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from functools import cache

import pytest

from planner.mission.events import Reply, Tick
from planner.mission.state import Mission
from planner.plan import Code, ComeBack, Count, Find, GoalState, GoTo, If, Say, Step, StepPlan
from planner.site.site_view import SiteView
from planner.skills.skill_state import FindState
from tests.planner.mission.fakes import FACTS, outcome_of, room
from tests.planner.mission.lockstep import CUP, Seeing
from wire import Grant

APART_M = 16.0
ROOMS = ("hall", "r1", "r2", "r3", "r4")
HOME = SiteView(
    {
        **{name: room(name, APART_M * n) for n, name in enumerate(ROOMS)},
        "dock": FACTS.targets["dock"],
    },
    home="dock",
)
ASKS, DONE = GoalState.NEEDS_CLARIFICATION, (GoalState.SUCCEEDED, GoalState.FAILED)


def large_home() -> Seeing:
    world = Seeing()
    world.open_eyes()
    world.engine.book = replace(world.book, facts=HOME)
    world.run(0.2)
    return world


@pytest.fixture
def large() -> Seeing:
    return large_home()


def searching(world: Seeing, *steps: Step) -> str:
    goal = world.give(StepPlan(steps=steps))
    world.see_until(goal, ASKS, *DONE, limit_s=600.0)
    return goal


@cache
def _searched(step: Step) -> Seeing:
    world = large_home()
    assert searching(world, step) == "g1"
    return world


def searched(step: Step) -> Seeing:
    """Return a world of its own in which goal g1 has searched until it asked."""
    return deepcopy(_searched(step))


def told(mission: Mission) -> str:
    return outcome_of(mission).message.en


def grants(world: Seeing) -> set[str]:
    return {message.mission for message in world.bridge.heard if isinstance(message, Grant)}


@pytest.mark.parametrize("step", [Find(object="cup"), Count(object="cup")])
def test_a_yes_goes_on_in_the_rooms_that_were_left_and_under_a_grant_of_its_own(
    step: Step,
) -> None:
    large, goal = searched(step), "g1"
    mission = large.goal(goal)
    assert mission.state is ASKS
    left = [name for name in ROOMS if name not in mission.skill_state.rooms]  # type: ignore[union-attr]
    assert 0 < len(left) < len(ROOMS)
    assert all(name in told(mission).split("I did not look in")[1] for name in left)
    assert "Shall I look in the" in told(mission)
    assert mission.metres < 60.0
    assert grants(large) == {goal}
    before = len(large.routes)
    large.event(Reply(goal, "yes"))
    large.see_until(goal, ASKS, *DONE, limit_s=600.0)
    ended = large.goal(goal)
    assert ended.state is (GoalState.FAILED if step.kind == "find" else GoalState.SUCCEEDED)
    assert grants(large) == {goal, f"{goal}.1"}
    driven_to = {HOME_AT.get(ask.request.goal.x_m) for ask in large.routes[before:]} - {None}
    assert set(left) <= driven_to, "each room that was left"
    assert ended.steps[0].rooms == tuple(mission.skill_state.order)  # type: ignore[union-attr]
    assert "I did not look in" not in told(ended)
    assert ended.steps[0].count == (0 if step.kind == "count" else None)


HOME_AT = {target.pose.x_m: name for name, target in HOME.targets.items() if target.room}


@pytest.mark.parametrize("answer", ["no", "no, thanks"])
def test_a_no_ends_it_with_what_was_seen(answer: str) -> None:
    large, goal = searched(Find(object="cup")), "g1"
    large.event(Reply(goal, answer))
    large.see_until(goal, *DONE)
    ended = large.goal(goal)
    assert outcome_of(ended).code is Code.NOT_FOUND
    assert "I did not look in the" in told(ended)
    assert grants(large) == {goal}, "no word, no grant"


def test_who_does_not_answer_is_told_what_was_not_looked_at() -> None:
    large, goal = searched(Count(object="cup")), "g1"
    large.now_s += large.book.rules.answer_s + 1.0
    large.event(Tick())
    assert large.goal(goal).state is GoalState.FAILED
    assert "I did not look in the" in told(large.goal(goal))


def test_the_persons_else_is_taken_and_nobody_is_asked(large: Seeing) -> None:
    seek = If(when=Find(object="cup"), then=(Say(text="here"),), otherwise=(Say(text="gone"),))
    goal = searching(large, seek)
    ended = large.goal(goal)
    assert ended.state is GoalState.SUCCEEDED
    assert large.said == ["gone"]
    assert "I did not look in the" in told(ended)
    assert "So I do what you said for that case." in told(ended)


def test_the_way_that_the_else_drives_is_left(large: Seeing) -> None:
    """Come back: the search ends while the way back still fits into the grant."""
    back = If(when=Find(object="cup"), then=(Say(text="here"),), otherwise=(ComeBack(),))
    goal = searching(large, back)
    ended = large.goal(goal)
    assert ended.state is GoalState.SUCCEEDED, told(ended)
    assert ended.metres < 60.0
    assert large.bridge.pose.x_m < 1.0


@pytest.mark.parametrize(
    "steps", [(GoTo(place="hall"), Find(object="cup"), ComeBack()), (Find(object="cup"),)]
)
def test_nobody_is_asked_while_others_wait_or_the_robot_is_to_come_back(
    large: Seeing, steps: tuple[Step, ...]
) -> None:
    goal = large.give(StepPlan(steps=steps))
    large.run(0.2)
    if len(steps) == 1:
        large.give(StepPlan(steps=(Say(text="next"),)))
    large.see_until(goal, ASKS, *DONE, limit_s=600.0)
    assert large.goal(goal).state is GoalState.FAILED
    assert "I did not look in the" in told(large.goal(goal))


def test_what_is_found_after_a_yes_is_found() -> None:
    large, goal = searched(Find(object="cup")), "g1"
    last = HOME.targets[ROOMS[-1]].pose
    large.things = (replace(CUP, x_m=last.x_m, y_m=0.5, room=ROOMS[-1]),)
    large.event(Reply(goal, "yes"))
    large.see_until(goal, *DONE, limit_s=600.0)
    assert large.goal(goal).state is GoalState.SUCCEEDED


def test_a_search_that_asks_is_still_one_after_a_restart() -> None:
    large, goal = searched(Find(object="cup")), "g1"
    entry = next(e for e in reversed(large.disk_entries) if any(m.id == goal for m in e.missions))
    kept = next(m for m in entry.missions if m.id == goal)
    again = Mission.model_validate_json(kept.model_dump_json())
    assert isinstance(again.skill_state, FindState)
    assert again.skill_state.offered
