"""Where a model points is driven to upon a person's yes alone, whatever happens while it waits."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.mission.events import Cancel, Pause, Reply, Resume, Tick, Told
from planner.mission.observations import list_observations
from planner.mission.reducer import asked_about_picture
from planner.mission.skills import Eyesight, ImageAnswer
from planner.mission.skills.skill_state import GoToObjectState
from planner.plan import Code, GoalState, GoTo, GoToObject, StepPlan, StepState
from tests.planner.mission.driving import CANCELLED, FAILED, PAUSED, SUCCEEDED, standing_still
from tests.planner.mission.lockstep import go
from tests.planner.mission.seeing import Seeing
from wire import CameraConfig

ASKS = GoalState.NEEDS_CLARIFICATION
PLAN = StepPlan(steps=(GoToObject(object="guitar"), GoTo(place="dock")))
AT = (4.0, 0.5, 0.4)
TOLD = "I think “guitar” is 4.0 m away, straight ahead (in the kitchen). Shall I drive there?"


def sees(world: Seeing) -> Seeing:
    eyes = Eyesight(CameraConfig(), ("cup",), model=True)
    world.engine.book = replace(world.book, eyes=eyes)
    world.run(0.2)
    return world


def pointing(world: Seeing, *, written: bool = True) -> str:
    """Give a goal to what only a model knows, and let it point; then the disk is slow, or not."""
    goal = world.give(PLAN)
    while (ticket := asked_about_picture(world.book)) is None:
        world.see(0.2)
    world.disk = written
    world.event(Told(goal, ticket, ImageAnswer(at=AT)))
    return goal


def again(world: Seeing) -> Seeing:
    """Return a new planner on the same disk, its eyes open."""
    after = world.restart()
    seeing = Seeing(bridge=after.bridge, now_s=after.now_s, plans=after.plans, planner_id="p2")
    seeing.engine, seeing.disk_entries = after.engine, [*world.disk_entries, *after.disk_entries]
    return sees(seeing)


@pytest.fixture
def world() -> Seeing:
    return sees(Seeing())


def test_it_stands_and_asks_and_drives_upon_a_yes(world: Seeing) -> None:
    goal = pointing(world)
    mission = world.goal(goal)
    assert (mission.state, mission.reason, world.said) == (ASKS, "asked", [TOLD])
    assert mission.outcome is not None
    assert (mission.outcome.code, mission.outcome.message.en) == (Code.ASKED, TOLD)
    assert standing_still(world, 30.0)
    world.event(Reply(goal, "Yes, please."))
    world.see_until(goal, SUCCEEDED)
    step = world.goal(goal).steps[0]
    assert (step.state, step.answer) == (StepState.SUCCEEDED, "Yes, please.")
    assert step.reached is not None
    assert step.reached.x_m == pytest.approx(3.2, abs=0.15)
    assert world.said == [TOLD]
    seen = list_observations(world.book.facts, world.goal(goal))[0]
    assert (seen.step, seen.result) == ("go_to_object", "succeeded")


@pytest.mark.parametrize("replies", [("no",), ("what?", "hm"), ("what?", "不要")])
def test_without_a_plain_yes_it_ends_where_it_stands(
    world: Seeing, replies: tuple[str, ...]
) -> None:
    goal = pointing(world)
    for reply in replies:
        assert world.goal(goal).state is ASKS
        world.event(Reply(goal, reply))
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "point_declined")
    assert mission.outcome is not None
    assert mission.outcome.code is Code.POINT_REFUSED
    assert [s.state for s in mission.steps] == [StepState.FAILED, StepState.SKIPPED]
    assert standing_still(world)
    assert len(world.said) == len(replies), "a second question is said, too"


def test_nobody_answers_and_nothing_moves(world: Seeing) -> None:
    goal = pointing(world)
    world.run(world.book.rules.answer_s + 1.0, every_s=0.25)
    world.event(Tick())
    mission = world.goal(goal)
    assert (mission.state, mission.reason) == (FAILED, "no_answer")
    assert mission.outcome is not None
    assert TOLD in mission.outcome.message.en
    assert standing_still(world)


@pytest.mark.parametrize("written", [True, False])
def test_a_crash_neither_drives_nor_loses_the_question(written: bool) -> None:
    before = sees(Seeing())
    goal = pointing(before, written=written)
    after = again(before)
    after.act()
    if not written:
        assert (after.goal(goal).state, after.goal(goal).reason) == (PAUSED, "planner_restarted")
        after.event(Resume(goal))
    after.see(3.0)
    mission = after.goal(goal)
    assert (mission.state, after.said) == (ASKS, []), "perhaps said before"
    assert isinstance(mission.skill_state, GoToObjectState)
    assert mission.skill_state.pointed == AT
    if written:
        assert mission.outcome is not None
        assert mission.outcome.message.en == TOLD
    assert standing_still(after)
    after.event(Reply(goal, "yes"))
    after.see_until(goal, SUCCEEDED)


def test_a_yes_given_before_a_crash_waits_for_a_person_and_asks_nothing_twice(
    world: Seeing,
) -> None:
    goal = pointing(world)
    world.event(Reply(goal, "yes"))
    world.see(1.0)
    after = again(world)
    after.act()
    assert after.goal(goal).state is PAUSED
    assert standing_still(after, 5.0)
    after.event(Resume(goal))
    after.see_until(goal, SUCCEEDED)
    assert after.said == []


def test_a_yes_to_a_point_of_another_map_is_none(world: Seeing) -> None:
    world.engine.book = replace(world.book, facts=replace(world.book.facts, map_id="m1"))
    goal = pointing(world)
    world.event(Reply(goal, "yes"))
    after = again(world)
    after.act()
    after.event(Resume(goal))
    while (ticket := asked_about_picture(after.book)) is None:
        after.see(0.2)
    assert after.goal(goal).steps[0].answer == "yes"
    after.event(Told(goal, ticket, ImageAnswer(at=(2.0, 0.0, 0.4))))
    assert (after.goal(goal).state, after.goal(goal).steps[0].answer) == (ASKS, None)
    assert standing_still(after)


def test_a_pause_before_the_question_was_said_keeps_it(world: Seeing) -> None:
    goal = pointing(world, written=False)
    world.event(Pause(goal))
    world.disk = True
    world.sync()
    assert world.goal(goal).state is PAUSED
    assert standing_still(world)
    world.event(Resume(goal))
    world.see(1.0)
    assert world.goal(goal).state is ASKS
    assert standing_still(world)


def test_other_goals_drive_meanwhile_and_the_point_stays(world: Seeing) -> None:
    goal = pointing(world)
    other = world.give(go("kitchen"))
    world.run_until(other, SUCCEEDED)
    assert world.goal(goal).state is ASKS
    world.event(Reply(goal, "好的"))
    world.see_until(goal, SUCCEEDED)
    step = world.goal(goal).steps[0]
    assert step.reached is not None
    assert step.reached.x_m == pytest.approx(3.2, abs=0.9), "about the same point of the map"


def test_the_question_can_be_cancelled(world: Seeing) -> None:
    goal = pointing(world)
    world.event(Cancel(goal))
    assert world.goal(goal).state is CANCELLED
    assert standing_still(world)
