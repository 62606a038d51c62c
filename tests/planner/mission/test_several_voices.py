"""Several people at once: turns by the time of asking, and drives that somebody takes back."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.brain.scripted import Reply
from planner.mission.conversation import situation_of
from planner.mission.events import Planned, Stopped
from planner.mission.state import Mission
from planner.plan import AnswerPlan, Bilingual, Goal, GoalState, GoTo, PlanRole, StepPlan
from planner.site import Site
from tests.planner.mission.live import KITCHEN, SOFA, Together, planner, run
from tests.planner.mission.lockstep import Together as Lockstep
from tests.planner.mission.lockstep import go, talk
from wire import OpRequest

RUNNING, PAUSED, QUEUED = GoalState.RUNNING, GoalState.PAUSED, GoalState.QUEUED
CANCELLED, SUCCEEDED = GoalState.CANCELLED, GoalState.SUCCEEDED
CONFIRMS = GoalState.AWAITING_CONFIRMATION
CANCEL = StepPlan(does=PlanRole.CANCEL, steps=())
SMALL_TALK = AnswerPlan(text=Bilingual(en="I see.", zh="好的。"))
SOFA_INSTEAD = StepPlan(does=PlanRole.INSTEAD, steps=(GoTo(place="sofa"),))


@pytest.fixture
def world() -> Lockstep:
    made = Lockstep()
    made.run(0.5)
    return made


def test_goals_run_in_the_order_of_asking_though_thoughts_end_the_other_way(
    world: Lockstep,
) -> None:
    asked = [world.give(None) for _ in range(3)]
    for goal in reversed(asked):
        world.event(Planned(goal, talk(goal)))
        world.run(0.1)
    for goal in asked:
        world.run_until(goal, SUCCEEDED)
    assert world.said == asked


def test_a_goal_waits_for_an_older_thought_that_comes_to_nothing(world: Lockstep) -> None:
    older, newer = world.give(None), world.give(go("hall"))
    world.run(1.0)
    assert (world.goal(newer).state, world.book.running) == (QUEUED, None)
    world.event(Planned(older, SMALL_TALK))
    assert world.book.running == newer


def test_a_newer_thought_keeps_nobody_waiting(world: Lockstep) -> None:
    older = world.give(go("hall"))
    world.give(None)
    assert world.goal(older).state is RUNNING


def test_a_brain_is_told_what_others_asked_and_what_is_paused(world: Lockstep) -> None:
    stopped, waiting = world.give(go("hall")), world.give(go("dock"))
    world.event(Stopped("test"))
    thinking, own = world.give(None), world.give(None)
    told = situation_of(world.book, world.goal(own), world.now_s)
    assert told.thinking == (world.goal(thinking).text,)
    assert told.paused == (world.goal(stopped).text,)
    assert told.queue == (world.goal(waiting).text,)


async def _driving(world: Together, text: str = "go to the kitchen") -> Goal:
    goal = await world.missions.submit(text)
    await world.reach(goal.id, RUNNING)
    await world.until(lambda: world.bridge.horizon is not None)
    return goal


def _mission(world: Together, goal: Goal) -> Mission:
    return world.missions.loop.book.missions[goal.id]


@pytest.mark.parametrize("reply", [SMALL_TALK, CANCEL])
@pytest.mark.parametrize(
    "text",
    [
        "don't go there",
        "not the kitchen",
        "don't go to the kitchen",
        "别去厨房，宝宝在睡觉",
        "别去那儿",
        "等等，别去厨房",
    ],
)
def test_a_drive_that_is_denied_ends_and_does_not_go_on(
    tmp_path: Path, site: Site, text: str, reply: Reply
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, reply, by_grammar=False) as world:
            goal = await _driving(world)
            said = await world.missions.submit(text)
            await world.reach(said.id, SUCCEEDED)
            assert world.missions.goal(goal.id).state is CANCELLED
            assert world.bridge.horizon is None
            again = await world.missions.submit("go on")
            told = await world.reach(again.id, SUCCEEDED)
            assert told.outcome is not None
            assert "nothing" in told.outcome.message.en.lower()

    run(story())


def test_a_model_ends_the_goal_that_the_very_sentence_has_stopped(
    tmp_path: Path, site: Site
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, CANCEL, by_grammar=False) as world:
            goal = await _driving(world)
            said = await world.missions.submit("don't go in there")
            await world.reach(said.id, SUCCEEDED)
            assert world.missions.goal(goal.id).state is CANCELLED

    run(story())


@pytest.mark.parametrize("agrees", [True, False])
def test_after_a_no_to_a_models_plan_the_order_itself_is_offered(
    tmp_path: Path, site: Site, agrees: bool
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, SOFA, by_grammar=False) as world:
            goal = await world.missions.submit("go to the kitchen")
            await world.reach(goal.id, CONFIRMS)
            await world.missions.answer(goal.id, "no")
            offered = world.missions.goal(goal.id)
            assert offered.state is CONFIRMS
            assert offered.outcome is not None
            assert "kitchen" in offered.outcome.message.en
            await world.missions.answer(goal.id, "yes" if agrees else "no")
            ended = await world.reach(goal.id, SUCCEEDED, CANCELLED)
            assert ended.state is (SUCCEEDED if agrees else CANCELLED)
            kinds = [step.place for step in ended.plan.steps] if ended.plan else []
            assert kinds == ["kitchen"]

    run(story())


@pytest.mark.parametrize("text", ["good morning", "hello robot"])
def test_where_nothing_was_ordered_a_no_is_the_end(tmp_path: Path, site: Site, text: str) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, SOFA, by_grammar=False) as world:
            goal = await world.missions.submit(text)
            await world.reach(goal.id, CONFIRMS)
            await world.missions.answer(goal.id, "no")
            assert world.missions.goal(goal.id).state is CANCELLED

    run(story())


def test_a_cry_that_denies_no_way_keeps_the_drives_place(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, CANCEL, by_grammar=False) as world:
            goal = await _driving(world)
            said = await world.missions.submit("uh robot, there is a child, please stop")
            await world.reach(said.id, SUCCEEDED)
            assert world.missions.goal(goal.id).state is PAUSED

    run(story())


@pytest.mark.parametrize(
    "text", ["wait, not the kitchen, I meant the sofa", "等等，不是厨房，我说的是沙发"]
)
@pytest.mark.parametrize("plan", [SOFA, SOFA_INSTEAD])
def test_a_correction_under_way_is_driven_without_a_yes(
    tmp_path: Path, site: Site, text: str, plan: StepPlan
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, plan, by_grammar=False) as world:
            goal = await _driving(world)
            said = await world.missions.submit(text, act=OpRequest(id="a", source="test"))
            await world.reach(said.id, SUCCEEDED)
            assert world.missions.goal(goal.id).state is CANCELLED
            assert [a.id for a in world.bridge.answers if a.kind == "resume"] == ["a"]

    run(story())


@pytest.mark.parametrize("text", ["wait, not the kitchen", "no no no", "stop it, not there"])
def test_a_correction_that_the_person_did_not_say_waits_for_a_yes(
    tmp_path: Path, site: Site, text: str
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, SOFA_INSTEAD, by_grammar=False) as world:
            await _driving(world)
            said = await world.missions.submit(text)
            await world.reach(said.id, CONFIRMS, SUCCEEDED)
            assert _mission(world, said).state is not RUNNING

    run(story())
