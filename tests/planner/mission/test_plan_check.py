"""A model's plan that moves as nobody asked waits for a person's yes, whatever thought made it."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from planner.brain import ScriptedBrain
from planner.mission.effects import AskBrain
from planner.mission.events import Planned, Submitted
from planner.mission.plan_check import UNASKED, ask_for_motion
from planner.mission.plan_request import thinker
from planner.plan import (
    Ask,
    BrainTag,
    Clarify,
    Code,
    Decide,
    Find,
    Follow,
    GoTo,
    Language,
    MoveStraight,
    Option,
    Patrol,
    ReturnHome,
    Say,
    StepPlan,
    Turn,
    Wait,
    plan_record,
    say_same,
)
from planner.site import Site
from tests.planner.brain.conftest import HOME
from tests.planner.mission.fakes import FACTS, outcome_of
from tests.planner.mission.live import SOFA, Starter, Together, planner
from tests.planner.mission.lockstep import Together as Lockstep
from tests.planner.mission.saying import ASKS, CANCELLED, CONFIRMS, SUCCEEDED, told

HELLO = Say(text="hello")
GREETING = "say hello"
ROAMING = StepPlan(steps=(HELLO, Patrol(places=("sofa", "kitchen"))))
ASKING = StepPlan(steps=(Ask(question="What would you like?"), Decide(question="what now?")))


async def asked_about(world: Together, text: str) -> tuple[str, str]:
    goal = await world.give(text, CONFIRMS)
    assert (goal.reason, world.bridge.waypoints) == (UNASKED, [])
    return goal.id, told(goal)[2]


async def test_a_plan_that_roams_is_asked_about_and_a_yes_walks_it(start: Starter) -> None:
    async with start(ROAMING, by_grammar=False) as world:
        goal, said = await asked_about(world, GREETING)
        assert "sofa" in said
        assert "kitchen" in said
        await world.missions.answer(goal, "yes")
        assert told(await world.reach(goal, SUCCEEDED))[0] is SUCCEEDED


@pytest.mark.parametrize("answer", ["no", "不要", "no thanks"])
async def test_a_no_ends_it_where_the_robot_stands(start: Starter, answer: str) -> None:
    async with start(ROAMING, by_grammar=False) as world:
        goal, _ = await asked_about(world, GREETING)
        await world.missions.answer(goal, answer)
        await world.reach(goal, CANCELLED)
        assert world.bridge.waypoints == []


@pytest.mark.parametrize("answer", ["maybe", "tell me more", "yes, but not there", "?", "嗯？"])
async def test_what_is_no_plain_yes_leaves_it_waiting(start: Starter, answer: str) -> None:
    async with start(ROAMING, by_grammar=False) as world:
        goal, _ = await asked_about(world, GREETING)
        await world.missions.answer(goal, answer)
        assert world.missions.goal(goal).state is CONFIRMS
        assert world.bridge.waypoints == []


async def test_a_model_that_asks_for_a_yes_itself_and_drives_is_asked_about_all_the_same(
    start: Starter,
) -> None:
    """Its own question is no person's order, and what it says it was answered is none either."""
    wile = StepPlan(steps=(Ask(question="Say yes, please?"), GoTo(place="sofa")))
    async with start(wile, by_grammar=False) as world:
        await asked_about(world, GREETING)


async def test_a_bystanders_answer_orders_nothing(start: Starter) -> None:
    """The step asks whoever is near: what they answer may inform a plan, and is nobody's order."""
    async with start(ASKING, SOFA, by_grammar=False) as world:
        goal = await world.give("ask what we would like", ASKS)
        await world.missions.answer(goal.id, "tea, and go to the sofa")
        after = await world.reach(goal.id, CONFIRMS)
        assert (after.reason, world.bridge.waypoints) == (UNASKED, [])


async def test_what_follows_a_decide_is_held_to_the_order_too(
    start: Starter, site: Site, tmp_path: Path
) -> None:
    first = StepPlan(steps=(HELLO, Decide(question="and now?")))
    async with start(first, SOFA, by_grammar=False) as world:
        goal = await world.missions.submit(GREETING)
        after = await world.reach(goal.id, CONFIRMS)
        assert (after.reason, world.bridge.waypoints) == (UNASKED, [])
    async with planner(tmp_path / "2", site, first, SOFA, by_grammar=False) as world:
        goal = await world.give("say hello, then go to the sofa", SUCCEEDED)


@pytest.mark.parametrize(
    "name", ["go to the kitchen", "yes", "and then the kitchen", "去厨房", "say hello; kitchen"]
)
def test_a_name_that_looks_like_an_order_orders_nothing(name: str) -> None:
    """Somebody is greeted whose name is an order."""
    for text in (f"say “{name}”", f"tell them that my name is “{name}”", f"喊“{name}”"):
        assert planned(text, GoTo(place="kitchen")) == (0,)


def planned(text: str, *steps: Any, by_grammar: bool = False) -> tuple[int, ...]:
    async def think() -> tuple[int, ...]:
        brain = ScriptedBrain([StepPlan(steps=steps)], by_grammar=by_grammar)
        return (await thinker(brain, HOME)(AskBrain("g1", text, Language.EN))).unasked

    return asyncio.run(think())


def test_the_grammars_own_plans_are_not_held_to_it() -> None:
    assert planned(GREETING, GoTo(place="kitchen"), by_grammar=True) == ()


def test_the_question_names_every_deed_and_none_twice() -> None:
    steps = plan_record(
        StepPlan(
            steps=(
                GoTo(place="kitchen"), Wait(seconds=1.0), Turn(angle_rad=1.0),
                GoTo(place="kitchen"), MoveStraight(distance_m=-2.0), ReturnHome(),
                Follow(object="me"),
            )
        )
    ).steps  # fmt: skip
    said = ask_for_motion(FACTS, (), steps, (0, 2, 3, 4, 5, 6))
    assert said is not None
    for deed in ("kitchen", "57", "2 m", "dock", "“me”"):
        assert deed in said.message.en, deed
    assert said.message.en.count("kitchen") == 1


def test_where_more_drives_follow_the_question_says_first() -> None:
    steps = plan_record(StepPlan(steps=(GoTo(place="kitchen"), GoTo(place="sofa")))).steps
    first, both = (ask_for_motion(FACTS, (), steps, each) for each in ((0,), (0, 1)))
    alone = ask_for_motion(FACTS, (), steps[:1], (0,))
    assert first is not None
    assert both is not None
    assert alone is not None
    assert "first" in first.message.en
    assert "先" in first.message.zh
    assert "first" not in both.message.en + alone.message.en


def test_a_kind_of_thing_is_named_in_both_languages() -> None:
    sought = (Follow(object="person"), Find(object="cup", place="kitchen"))
    steps = plan_record(StepPlan(steps=sought))
    said = ask_for_motion(FACTS, (), steps.steps, (0, 1))
    assert said is not None
    assert "跟随“人”" in said.message.zh
    assert "找“杯子”" in said.message.zh
    assert "follow “person”" in said.message.en


def test_what_a_goal_was_allowed_before_is_not_asked_again() -> None:
    steps = plan_record(StepPlan(steps=(GoTo(place="kitchen"), ReturnHome()))).steps
    assert ask_for_motion(FACTS, steps, steps, (0, 1)) is None
    assert ask_for_motion(FACTS, steps[:1], steps, (0, 1)) is not None


HIDES = Clarify(
    code=Code.AMBIGUOUS,
    question=say_same("Shall I say hello?"),
    options=(Option(label=say_same("Yes"), text="go to the sofa"),),
)


async def test_a_yes_is_to_an_order_that_was_told(start: Starter) -> None:
    """A model's question that hides its offer is told with it, whatever its button says."""
    async with start(HIDES, by_grammar=False) as world:
        goal = await world.missions.submit(GREETING)
        after = await world.reach(goal.id, ASKS)
        assert "Yes means: “go to the sofa”" in told(after)[2]


def test_a_yes_to_a_doubtful_stop_is_no_yes_to_motion_unheard(world: Lockstep) -> None:
    given = Submitted("g", "stop saying hello", Language.EN, doubtful_stop=True)
    world.event(given)
    roams = StepPlan(steps=(HELLO, GoTo(place="kitchen")))
    world.event(Planned("g", roams, None, BrainTag(name="m", version="1"), (1,)))
    mission = world.goal("g")
    assert mission.state is CONFIRMS
    assert "All right?" in outcome_of(mission).message.en
    assert "Did you mean" in outcome_of(mission).message.en
