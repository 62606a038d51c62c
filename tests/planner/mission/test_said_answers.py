"""A plain yes or no that is said as a goal answers the one question that a step asks; else none."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.language.yes_no import consents
from planner.mission import QueueFull
from planner.mission.state import MAX_OPEN
from planner.plan import (
    Clarify,
    Code,
    GoalState,
    StepPlan,
)
from planner.site import Site
from tests.planner.mission.live import KITCHEN, planner, run
from tests.planner.mission.saying import (
    ASKS,
    CANCELLED,
    CONFIRMS,
    DRIVES,
    PAUSED,
    REFUSED,
    RUNNING,
    SUCCEEDED,
    TWICE,
    WHICH,
    answer_of,
    asking,
    asking_on_the_way,
    heard,
    later,
    told,
)
from wire import OpRequest


@pytest.mark.parametrize("text", ["yes", "Yes, please.", "好的", "no", "不要"])
def test_it_answers_the_one_question_and_is_told_so(tmp_path: Path, site: Site, text: str) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES) as world:
            goal = await asking(world)
            said = await world.missions.submit(text)
            assert told(said) == (
                SUCCEEDED, Code.ANSWERED, "Taken as the answer for “please see to it”."
            )  # fmt: skip
            assert answer_of(world, goal) == text
            assert heard(world) == ["please see to it"], "no brain is asked"
            await world.reach(goal.id, SUCCEEDED if consents(text) else CANCELLED)
        async with planner(tmp_path, site, prefix="h") as after:
            assert after.missions.goal(said.id) == said
            assert answer_of(after, goal) == text

    run(story())


@pytest.mark.parametrize("said", ["maybe", "yes?", "yes, but slowly", "the red one", "yes, hm"])
def test_any_other_sentence_is_a_new_goal(tmp_path: Path, site: Site, said: str) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES, WHICH) as world:
            goal = await asking(world)
            await world.reach((await world.missions.submit(said)).id, ASKS)
            assert heard(world)[-1] == said
            assert (world.missions.goal(goal.id).state, answer_of(world, goal)) == (ASKS, None)

    run(story())


@pytest.mark.parametrize("text", ["yes", "no"])
@pytest.mark.parametrize("other", [DRIVES, WHICH, KITCHEN])
def test_where_two_may_be_meant_it_answers_neither_names_both_and_clears_no_hold(
    tmp_path: Path, site: Site, text: str, other: StepPlan | Clarify
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES, other) as world:
            first = await asking(world)
            second = await world.missions.submit("mind it", confirm=other is not DRIVES)
            before = await world.reach(second.id, ASKS, CONFIRMS)
            await world.missions.stop("test")
            act = OpRequest(id="a", source="test")
            said = await world.missions.submit(text, act=act)
            state, code, words = told(said)
            assert (state, said.reason, code) == (REFUSED, "ambiguous", Code.AMBIGUOUS)
            assert "“please see to it”, “mind it”" in words
            assert (world.missions.goal(first.id).state, answer_of(world, first)) == (ASKS, None)
            assert world.missions.goal(second.id) == before
            await later(world)
            assert world.bridge.held is not None
            assert heard(world) == ["please see to it", "mind it"]

    run(story())


@pytest.mark.parametrize("text", ["yes", "no"])
def test_a_plan_that_waited_before_the_step_asked_may_be_meant_too(
    tmp_path: Path, site: Site, text: str
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, DRIVES) as world:
            plan = await world.missions.submit("go to the kitchen", confirm=True)
            await world.reach(plan.id, CONFIRMS)
            await later(world)
            goal = await asking(world)
            assert told(await world.missions.submit(text))[:2] == (REFUSED, Code.AMBIGUOUS)
            assert answer_of(world, goal) is None
            assert world.missions.goal(plan.id).state is CONFIRMS
            assert world.bridge.waypoints == []

    run(story())


def test_what_a_brain_asked_before_is_not_meant(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, WHICH, DRIVES) as world:
            unclear = await world.missions.submit("hm", source="somebody else")
            await world.reach(unclear.id, ASKS)
            await later(world)
            goal = await asking(world)
            await world.missions.submit("yes")
            await world.reach(goal.id, SUCCEEDED)
            assert world.missions.goal(unclear.id).state is ASKS

    run(story())


@pytest.mark.parametrize(("confirm", "replace"), [(True, False), (False, True)])
def test_what_is_heard_unsurely_or_replaces_a_goal_answers_nothing(
    tmp_path: Path, site: Site, confirm: bool, replace: bool
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES, WHICH) as world:
            goal = await asking(world)
            said = await world.missions.submit("yes", confirm=confirm, replace=replace)
            await world.reach(said.id, ASKS)
            assert (world.missions.goal(goal.id).state, answer_of(world, goal)) == (ASKS, None)

    run(story())


@pytest.mark.parametrize(
    ("text", "becomes"), [("no, stop", PAUSED), ("别动", PAUSED), ("don't go there", CANCELLED)]
)
def test_an_order_about_what_runs_is_obeyed_and_is_no_answer(
    tmp_path: Path, site: Site, text: str, becomes: GoalState
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES, KITCHEN) as world:
            goal, driving = await asking_on_the_way(world)
            await world.missions.submit(text)
            await world.reach(driving.id, becomes)
            assert (world.missions.goal(goal.id).state, answer_of(world, goal)) == (ASKS, None)

    run(story())


def test_after_a_stop_it_is_the_persons_act_as_any_answer_is(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES) as world:
            goal = await asking(world)
            await world.missions.stop("test")
            await world.missions.submit("yes", act=OpRequest(id="a", source="test"))
            await world.reach(goal.id, SUCCEEDED)

    run(story())


def test_a_no_ends_nothing_that_runs(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES, KITCHEN) as world:
            goal, driving = await asking_on_the_way(world)
            await world.missions.submit("no")
            assert answer_of(world, goal) == "no"
            assert world.missions.goal(driving.id).state is RUNNING
            await world.reach(driving.id, SUCCEEDED)

    run(story())


def test_what_is_said_about_one_goal_answers_no_other(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, WHICH, DRIVES, WHICH) as world:
            unclear = await world.missions.submit("hm", source="somebody else")
            await world.reach(unclear.id, ASKS)
            goal = await asking(world)
            await world.missions.answer(unclear.id, "yes")
            await world.reach(unclear.id, ASKS)
            assert heard(world)[-1] == "yes"
            await world.missions.answer(unclear.id, "forget that, go there")
            await world.until(lambda: heard(world)[-1] == "forget that, go there")
            assert (world.missions.goal(goal.id).state, answer_of(world, goal)) == (ASKS, None)

    run(story())


def test_the_same_request_again_answers_no_second_question(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, TWICE) as world:
            goal = await asking(world)
            said = await world.missions.submit("yes", idempotency_key="k")
            await world.reach(goal.id, ASKS)
            assert (await world.missions.submit("yes", idempotency_key="k")).id == said.id
            plan = world.missions.goal(goal.id).plan
            assert plan is not None
            assert [step.answer for step in plan.steps] == ["yes", None]

    run(story())


def test_a_full_queue_keeps_no_answer_out(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, DRIVES, *[KITCHEN] * MAX_OPEN) as world:
            goal = await asking(world)
            world.bridge.frozen = True
            for _ in range(MAX_OPEN - 1):
                await world.missions.submit("go to the kitchen")
            await world.missions.submit("yes")
            assert answer_of(world, goal) == "yes"
            with pytest.raises(QueueFull):
                await world.missions.submit("go to the kitchen")

    run(story())
