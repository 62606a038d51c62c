"""What follows a stop in the same breath is kept behind a yes, or is said not to be done."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner.brain.scripted import Reply
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Goal,
    GoalState,
    PlanRole,
    Refuse,
    StepPlan,
)
from planner.site import Site
from tests.planner.mission.live import KITCHEN, SOFA, Together, planner, run
from wire import Stop

RUNNING, PAUSED, CONFIRMS = GoalState.RUNNING, GoalState.PAUSED, GoalState.AWAITING_CONFIRMATION
SUCCEEDED, CANCELLED = GoalState.SUCCEEDED, GoalState.CANCELLED
TIME = Bilingual(en="It is ten.", zh="十点了。")
NO_ARM = Refuse(code=Code.NO_CAPABILITY, reason=Bilingual(en="I have no arm.", zh="我没有手。"))
UNREAD = Clarify(code=Code.NOT_UNDERSTOOD, question=Bilingual(en="What?", zh="什么？"))


async def stop_a_drive(world: Together, text: str, *states: GoalState) -> tuple[Goal, Goal]:
    """Say something in mid-drive; return the goal of before and the sentence's own."""
    goal = await world.missions.submit("go to the kitchen")
    await world.reach(goal.id, RUNNING)
    await world.until(lambda: world.bridge.horizon is not None)
    said = await world.missions.submit(text)
    assert world.bridge.horizon is None, "the stop comes first"
    assert any(isinstance(each, Stop) for each in world.bridge.heard), "and the bridge has heard it"
    said = await world.reach(said.id, *states)
    return world.missions.goal(goal.id), said


@pytest.mark.parametrize(
    "text",
    ["stop, then go to the sofa", "stop following me and go to the sofa", "stop! go to the sofa",
     "停下，然后去沙发", "别跟着我了，去沙发"],
)  # fmt: skip
def test_an_order_behind_a_stop_drives_after_a_yes(tmp_path: Path, site: Site, text: str) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, SOFA) as world:
            before, said = await stop_a_drive(world, text, CONFIRMS)
            assert before.state is PAUSED
            assert said.outcome is not None
            assert text in said.outcome.message.en
            assert world.bridge.horizon is None, "nothing drives before the yes"
            await world.missions.confirm(said.id)
            assert (await world.reach(said.id, RUNNING)).plan is not None

    run(story())


@pytest.mark.parametrize(
    ("text", "reply", "told"),
    [
        ("stop, and then bring me a coffee", NO_ARM, "I have no arm."),
        ("stop. what time is it?", AnswerPlan(text=TIME), "It is ten."),
        ("stop, there is a child", UNREAD, "I have not done “there is a child”"),
        ("停下，然后去火星", UNREAD, "“去火星”"),
        ("wait, the grommet wants polishing", UNREAD, "“the grommet wants polishing”"),
        ("stop, where are you?", UNREAD, "I am "),
    ],
)
def test_what_is_not_done_behind_a_stop_is_told(
    tmp_path: Path, site: Site, text: str, reply: Reply, told: str
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, reply, by_grammar=False) as world:
            before, said = await stop_a_drive(world, text, SUCCEEDED)
            assert before.state is PAUSED
            assert said.outcome is not None
            assert said.outcome.code is Code.STOPPED
            assert told in said.outcome.message.en
            assert said.outcome.message.en.startswith("Stop")

    run(story())


@pytest.mark.parametrize(
    "text",
    ["stop", "please stop, thank you", "stop here and wait", "don't come closer", "停下！别动！",
     "stop looking for the cup and the ball", "stop, stop, stop"],
)  # fmt: skip
def test_a_mere_stop_is_told_as_before_and_no_brain_is_asked_of_a_plain_one(
    tmp_path: Path, site: Site, text: str
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, UNREAD) as world:
            _, said = await stop_a_drive(world, text, SUCCEEDED)
            assert said.outcome is not None
            assert said.outcome.message.en in (
                "Stopped.", "Stopping: the bridge has confirmed it.",
            )  # fmt: skip

    run(story())


@pytest.mark.parametrize("text", ["stop following me, go on with the others", "停下，继续做别的"])
@pytest.mark.parametrize("reply", [UNREAD, StepPlan(does=PlanRole.CANCEL, steps=())])
def test_go_on_behind_a_stop_never_goes_on_with_what_was_stopped(
    tmp_path: Path, site: Site, text: str, reply: Reply
) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, SOFA, reply, by_grammar=False) as world:
            goal = await world.missions.submit("go to the kitchen")
            await world.reach(goal.id, RUNNING)
            other = await world.missions.submit("go to the sofa")
            await world.reach(other.id, GoalState.QUEUED)
            said = await world.reach((await world.missions.submit(text)).id, SUCCEEDED)
            assert world.missions.goal(goal.id).state is CANCELLED
            assert said.outcome is not None
            assert "Say “go on”, and I do “go to the sofa”." in said.outcome.message.en
            again = await world.missions.submit("go on")
            await world.reach(again.id, SUCCEEDED)
            await world.reach(other.id, RUNNING)

    run(story())


def test_a_stop_typed_into_an_answer_keeps_what_follows_it(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        asks = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))
        async with planner(tmp_path, site, asks, SOFA, by_grammar=False) as world:
            goal = await world.missions.submit("go to the room")
            await world.reach(goal.id, GoalState.NEEDS_CLARIFICATION)
            await world.missions.answer(goal.id, "stop, then go to the sofa")
            assert any(isinstance(each, Stop) for each in world.bridge.heard)
            newest = world.missions.goals()[0]
            assert (await world.reach(newest.id, CONFIRMS)).text == "stop, then go to the sofa"

    run(story())
