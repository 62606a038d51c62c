"""What is said to the planner itself is done at once, while the model hangs, and moves nothing."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

from planner.brain.scripted import Reply
from planner.language.sentence import parse
from planner.mission import BadState, JournalDown
from planner.mission.loop import Loop
from planner.plan import (
    ENDED,
    Ask,
    Bilingual,
    Clarify,
    Code,
    Goal,
    GoalState,
    GoTo,
    StepPlan,
)
from planner.site import Site, TaughtPlaces
from planner.site.known_places import KnownPlaces, Lesson
from tests.planner.mission import live
from tests.planner.mission.live import KITCHEN, LiveBridge, Together, run
from wire import Pose2, Status

ROOT = Path(__file__).resolve().parents[3]
SITE = Site.load(ROOT / "sites" / "two_room")
CORNER = StepPlan(steps=(GoTo(place="corner"),))
ASKS_FIRST = StepPlan(steps=(Ask(question="Shall I drive there?"), GoTo(place="kitchen")))
WHICH = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))
TO_KITCHEN = "please go to the kitchen"


class MappedBridge(LiveBridge):
    """Say on which map it is."""

    map_id = SITE.map_id

    def step(self) -> Status:
        self.pending = super().step().model_copy(update={"map_id": self.map_id})
        return self.pending


@asynccontextmanager
async def planner(home: Path, *replies: Reply, hangs: bool = False) -> AsyncIterator[Together]:
    memory = KnownPlaces(SITE, TaughtPlaces.in_home(home))
    bridge = MappedBridge(pose=Pose2(1.0, 4.2, 0.0))
    async with live.planner(home, memory, *replies, bridge=bridge, hangs=hangs) as together:
        yield together


async def say(together: Together, text: str) -> Goal:
    given = await together.missions.submit(text)
    return await together.reach(
        given.id, GoalState.SUCCEEDED, GoalState.REFUSED, GoalState.FAILED, GoalState.CANCELLED
    )


def told(goal: Goal) -> str:
    assert goal.outcome is not None
    return goal.outcome.message.en


def test_the_planner_answers_while_the_model_hangs(tmp_path: Path) -> None:
    async def story() -> None:
        async with planner(tmp_path, hangs=True) as together:
            hanging = await together.missions.submit(TO_KITCHEN)
            assert hanging.state is GoalState.PLANNING
            here = await say(together, "where are you?")
            assert told(here) == "I am in the living room, by the sofa."
            assert here.outcome is not None
            assert (here.outcome.code, here.outcome.message.zh[:4]) == (Code.ANSWERED, "我在客厅")
            assert TO_KITCHEN in told(await say(together, "what are you doing"))
            assert "does not tell how full" in told(await say(together, "how is your battery"))
            assert told(await say(together, "hold on")) == f"Paused: “{TO_KITCHEN}”."
            assert together.missions.goal(hanging.id).state is GoalState.PAUSED
            assert told(await say(together, "继续")) == f"I go on: “{TO_KITCHEN}”."
            assert together.missions.goal(hanging.id).state is GoalState.PLANNING
            assert told(await say(together, "算了")) == f"Cancelled: “{TO_KITCHEN}”."
            assert together.missions.goal(hanging.id).state is GoalState.CANCELLED
            assert told(await say(together, "never mind")) == "There is nothing to cancel."
            assert "nothing to do" in told(await say(together, "status"))
            assert together.bridge.waypoints == []

    run(story())


def test_a_goal_that_is_taken_back_makes_room_for_the_rest(tmp_path: Path) -> None:
    async def story() -> None:
        async with planner(tmp_path, KITCHEN, "no json at all") as together:
            first = await together.missions.submit(TO_KITCHEN)
            await together.reach(first.id, GoalState.RUNNING)
            await together.until(lambda: together.bridge.horizon is not None)
            second = await together.missions.submit("forget that, dance")
            assert together.missions.goal(first.id).state is GoalState.CANCELLED
            await together.reach(second.id, GoalState.REFUSED)
            assert [request.text for request in together.brain.asked][-1] == "forget that, dance"
            assert together.missions.goal(second.id).text == "forget that, dance"

    run(story())


@pytest.mark.parametrize("asks", [False, True])
def test_a_goal_that_is_taken_back_is_the_only_one_and_nobody_overtakes(
    tmp_path: Path, asks: bool
) -> None:
    sofa = StepPlan(steps=(GoTo(place="sofa"),))

    async def story() -> None:
        async with planner(tmp_path, KITCHEN, WHICH if asks else KITCHEN, sofa) as together:
            missions = together.missions
            first = await missions.submit(TO_KITCHEN)
            await together.reach(first.id, GoalState.RUNNING)
            other = await missions.submit("please go there")
            waits = GoalState.NEEDS_CLARIFICATION if asks else GoalState.QUEUED
            await together.reach(other.id, waits)
            instead = await missions.submit("forget that, go to the sofa")
            assert missions.goal(first.id).state is GoalState.CANCELLED
            await together.reach(instead.id, GoalState.SUCCEEDED)
            if not asks:
                await together.reach(other.id, GoalState.SUCCEEDED)
            assert missions.goal(other.id).reason == ("superseded" if asks else None)
            drove = dict.fromkeys(m.mission for m in together.bridge.waypoints if m.points)
            after = [instead.id] if asks else [instead.id, other.id]
            assert [goal for goal in drove if goal != first.id] == after

    run(story())


def test_a_taught_place_is_driven_to_and_a_forgotten_one_is_not(tmp_path: Path) -> None:
    async def story() -> None:
        async with planner(tmp_path, CORNER, CORNER) as together:
            kept = await say(together, "remember this as corner")
            assert told(kept) == "I will remember this place as “corner”."
            together.bridge.pose = Pose2(1.5, 1.9, 0.0)
            goal = await say(together, "please go to the corner")
            assert goal.outcome is not None
            assert (goal.outcome.code, told(goal)) == (Code.ARRIVED, "Arrived: corner.")
            assert together.brain.asked[-1].vocabulary.by_id["corner"].name.en == "corner"
            assert "forgotten" in told(await say(together, "forget the place corner"))
            goal = await say(together, "please go to the corner")
            assert goal.outcome is not None
            assert goal.outcome.code is Code.UNKNOWN_PLACE
            no = await say(together, "忘记沙发这个地方")
            assert no.outcome is not None
            assert no.outcome.code is Code.PLACE_NOT_KEPT
            assert "站点文件" in no.outcome.message.zh

    run(story())


def test_what_a_model_writes_teaches_nothing(tmp_path: Path) -> None:
    words = "remember this as corner"
    plans = (StepPlan.model_validate({"steps": [{"kind": "say", "text": words}]}),)

    async def story() -> None:
        async with planner(tmp_path, *plans) as together:
            goal = await say(together, "please speak")
            assert goal.state is GoalState.SUCCEEDED
            assert together.missions.memory.taught_places == ()

    run(story())


def test_questions_of_ones_own_do_not_clear_what_is_held(tmp_path: Path) -> None:
    async def story() -> None:
        async with planner(tmp_path) as together:
            running = await together.missions.submit(TO_KITCHEN)
            await together.reach(running.id, GoalState.RUNNING)
            await together.missions.stop("test")
            await say(together, "where are you?")
            assert together.missions.goal(running.id).state is GoalState.PAUSED
            assert together.bridge.held is not None

    run(story())


def test_an_answer_may_take_the_question_back(tmp_path: Path) -> None:
    asks = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))

    async def story() -> None:
        async with planner(tmp_path, asks) as together:
            goal = await together.missions.submit("please go there")
            await together.reach(goal.id, GoalState.NEEDS_CLARIFICATION)
            same = await together.missions.answer(goal.id, "where are you?")
            assert same.state is GoalState.NEEDS_CLARIFICATION
            taken_back = await together.missions.answer(goal.id, "never mind")
            assert taken_back.state is GoalState.CANCELLED
            with pytest.raises(BadState):  # nothing is asked any more
                await together.missions.answer(goal.id, "where are you?")

    run(story())


def test_a_place_that_is_forgotten_on_the_way_ends_the_goal_and_the_robot_stands(
    tmp_path: Path,
) -> None:
    async def story() -> None:
        async with planner(tmp_path, CORNER, KITCHEN, CORNER) as together:
            missions, bridge = together.missions, together.bridge
            await say(together, "remember this as corner")
            bridge.pose = Pose2(1.0, 1.0, 0.0)
            driven = await missions.submit("please go to the corner")
            await together.until(lambda: bridge.horizon is not None)
            kitchen = await missions.submit(TO_KITCHEN)
            queued = await missions.submit("then go to the corner")
            await together.reach(queued.id, GoalState.QUEUED)
            await missions.memory.forget("corner")
            for goal in (missions.goal(driven.id), missions.goal(queued.id)):
                assert (goal.state, goal.reason) == (GoalState.FAILED, "place_gone")
                assert goal.outcome is not None
                assert goal.outcome.code is Code.UNKNOWN_PLACE
                assert "“corner”" in goal.outcome.message.en
            await together.reach(kitchen.id, GoalState.SUCCEEDED)  # the next has the robot
            assert bridge.waypoints[-1].points == ()  # and then it stands

    run(story())


def test_a_place_that_is_moved_on_the_way_is_driven_to_where_it_is_now(tmp_path: Path) -> None:
    async def story() -> None:
        async with planner(tmp_path, CORNER) as together:
            missions, bridge = together.missions, together.bridge
            await say(together, "remember this as corner")
            bridge.pose = Pose2(1.0, 1.0, 0.0)
            goal = await missions.submit("please go to the corner")
            await together.until(lambda: bridge.horizon is not None)
            now = Pose2(1.0, 1.6, 0.0)
            await missions.memory.teach(Lesson("corner", pose=now))
            await together.reach(goal.id, GoalState.SUCCEEDED)
            assert abs(bridge.pose.y_m - now.y_m) < 0.1

    run(story())


@pytest.mark.parametrize("plan", [ASKS_FIRST, WHICH])
def test_what_is_said_to_the_planner_itself_is_no_answer(
    tmp_path: Path, plan: StepPlan | Clarify
) -> None:
    async def story() -> None:
        async with planner(tmp_path, plan, KITCHEN) as together:
            missions = together.missions
            goal = await missions.submit(TO_KITCHEN)
            await together.reach(goal.id, GoalState.NEEDS_CLARIFICATION)
            for said in ("hold on", "等一下", "pause for now", "remember this as corner", "status"):
                assert parse(said).stays_put, "so no operator's proof is asked for"
                assert (await missions.answer(goal.id, said)).state is GoalState.NEEDS_CLARIFICATION
            await together.until(lambda: len(missions.memory.taught_places) == 1)
            await together.until(lambda: all(g.state in ENDED for g in missions.goals()[1:]))
            assert missions.goal(goal.id).state is GoalState.NEEDS_CLARIFICATION
            assert together.bridge.waypoints == []

    run(story())


@pytest.mark.parametrize(("plan", "answers"), [(ASKS_FIRST, True), (WHICH, False)])
def test_go_on_answers_a_plans_own_question_and_no_other(
    tmp_path: Path, plan: StepPlan | Clarify, answers: bool
) -> None:
    async def story() -> None:
        async with planner(tmp_path, plan) as together:
            goal = await together.missions.submit(TO_KITCHEN)
            await together.reach(goal.id, GoalState.NEEDS_CLARIFICATION)
            await together.missions.answer(goal.id, "yes, go on")
            if answers:
                await together.reach(goal.id, GoalState.SUCCEEDED)
                return
            beside = together.missions.goals()[-1]
            assert (
                told(await together.reach(beside.id, GoalState.SUCCEEDED))[:16]
                == "There is nothing"
            )
            assert together.missions.goal(goal.id).state is GoalState.NEEDS_CLARIFICATION

    run(story())


@pytest.mark.parametrize("asks", [True, False])
def test_a_stop_within_an_answer_waits_for_no_disk_and_no_question(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, asks: bool
) -> None:
    async def full(_: object) -> None:
        raise JournalDown("disk full")

    async def story() -> None:
        async with planner(tmp_path, WHICH if asks else KITCHEN) as together:
            missions = together.missions
            goal = await missions.submit(TO_KITCHEN)
            await together.reach(
                goal.id, GoalState.NEEDS_CLARIFICATION if asks else GoalState.RUNNING
            )
            monkeypatch.setattr(Loop, "wait_written", full)
            answered = await missions.answer(goal.id, "forget that, stop")
            assert answered.state is GoalState.CANCELLED
            assert together.bridge.held is not None

    run(story())


def test_faster_tells_that_it_never_drives_faster_than_planned(tmp_path: Path) -> None:
    async def story() -> None:
        async with planner(tmp_path, KITCHEN) as together:
            goal = await together.missions.submit(TO_KITCHEN)
            await together.reach(goal.id, GoalState.RUNNING)
            assert "50 %" in told(await say(together, "slow down"))
            for _ in range(2):
                heard = await say(together, "faster")
                assert "at full speed" in told(heard)
                assert "%" not in told(heard)

    run(story())
