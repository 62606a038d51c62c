"""A sentence with a stop word stops by the real door: with a brain that hangs, and under a hold."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.plan import AnswerPlan, Bilingual, Clarify, Code, GoalState
from planner.site import Site
from tests.planner.mission.live import KITCHEN, Together, planner, run
from wire import HeldReason, OpRequest

RUNNING, PAUSED, SUCCEEDED = GoalState.RUNNING, GoalState.PAUSED, GoalState.SUCCEEDED
OVER = (SUCCEEDED, GoalState.NEEDS_CLARIFICATION, GoalState.CANCELLED)
"""A question is given up for the next one of the same source."""
ACT = OpRequest(id="a", source="test")
SMALL_TALK = AnswerPlan(text=Bilingual(en="hello", zh="你好"))
UNREAD = Clarify(code=Code.NOT_UNDERSTOOD, question=Bilingual(en="what?", zh="什么？"))


def resumed(world: Together) -> list[str]:
    """Return the ids of the acts that reached the bridge."""
    return [answer.id for answer in world.bridge.answers if answer.kind == "resume"]


@pytest.mark.parametrize("hangs", [False, True])
@pytest.mark.parametrize(
    "text", ["uh robot, there is a child, please stop", "別過來啦", "no no no"]
)
def test_it_stops_what_runs_whether_the_brain_answers_or_hangs(
    tmp_path: Path, site: Site, text: str, hangs: bool
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, UNREAD) as world:
            goal = await world.missions.submit("go to the kitchen")
            await world.reach(goal.id, RUNNING)
            world.brain.hangs = hangs
            said = await world.missions.submit(text)
            assert world.missions.goal(goal.id).state is PAUSED
            assert world.bridge.held is not None
            if not hangs:
                done = await world.reach(said.id, SUCCEEDED)
                assert done.outcome is not None
                assert done.outcome.code is Code.STOPPED

    run(story())


@pytest.mark.parametrize("reply", [SMALL_TALK, UNREAD])
def test_words_without_a_plan_bring_no_act_to_the_bridge(
    tmp_path: Path, site: Site, reply: AnswerPlan | Clarify
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, reply, reply) as world:
            world.bridge.hold(HeldReason.STOP)
            both = [await world.missions.submit(text, act=ACT) for text in ("hello", "what now")]
            for goal in both:
                await world.reach(goal.id, *OVER)
            assert resumed(world) == []
            assert world.bridge.held is not None

    run(story())


def test_a_plan_brings_the_act_that_came_with_its_words(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN) as world:
            world.bridge.hold(HeldReason.STOP)
            await world.until(lambda: (s := world.missions.link.status) is not None
                              and s.value.held is not None)  # fmt: skip
            await world.missions.submit("go to the kitchen", act=ACT)
            await world.until(lambda: resumed(world) == [ACT.id])

    run(story())
