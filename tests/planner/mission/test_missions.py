"""The door of the missions on a real event loop: goals, stops, keys, and what they do at once."""

from __future__ import annotations

import asyncio
import sqlite3
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, closing
from pathlib import Path

import pytest

from planner.brain.errors import BrainDown
from planner.brain.scripted import Reply
from planner.language.sentence import parse
from planner.mission.errors import (
    BadState,
    IdempotencyConflict,
    JournalDown,
    NothingToResume,
    QueueFull,
    UnknownGoal,
)
from planner.mission.events import Journalled
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
    PlanRole,
    StepPlan,
)
from planner.site import Site, TaughtPlaces
from planner.site.known_places import KnownPlaces, Lesson
from tests.planner.mission import live
from tests.planner.mission.fakes import outcome_of
from tests.planner.mission.live import KITCHEN, SOFA, LiveBridge, Starter, StraightRouter, Together
from wire import Mode, OpRequest, Pose2, Status


async def test_a_sentence_ends_where_it_says(start: Starter) -> None:
    async with start() as world:
        goal = await world.missions.submit("go to the kitchen")
        assert goal.state in (GoalState.PLANNING, GoalState.RUNNING)
        done = await world.reach(goal.id, GoalState.SUCCEEDED)
        reached = outcome_of(done).reached
        assert reached is not None
        assert reached.room == "kitchen"
        assert world.brain.asked[0].room == "living_room"
        assert len(world.missions.loop.accepted.seconds) == 1
        assert world.missions.goals()[0] == done
        assert world.missions.snapshot()["goals"][0]["id"] == goal.id


async def test_stop_is_never_asked_of_a_brain_and_pauses(start: Starter) -> None:
    async with start() as world:
        goal = await world.missions.submit("go to the kitchen")
        await world.until(lambda: world.bridge.mode is Mode.ACTIVE)
        stopped = await world.missions.submit("停下！")
        assert (stopped.state, stopped.language) == (GoalState.SUCCEEDED, "zh")
        assert outcome_of(stopped).code is Code.STOPPED
        assert world.missions.goal(goal.id).reason == "stop"
        assert len(world.brain.asked) == 1
        assert world.bridge.held is not None
        act = OpRequest(id="act-1", source="test")
        await world.missions.resume(act=act)
        await world.reach(goal.id, GoalState.SUCCEEDED)


async def test_a_stop_that_nobody_confirms_says_so(start: Starter) -> None:
    async with start() as world:
        world.bridge.deaf = True
        stopped = await world.missions.submit("stop")
        assert (stopped.state, stopped.reason) == (GoalState.FAILED, "bridge_silent")


async def test_stop_and_cancel_end_thinking_at_once(start: Starter) -> None:
    async with start(hangs=True) as world:
        first = await world.missions.submit("go to the kitchen")
        second = await world.missions.submit("go to the sofa")
        assert (await world.missions.cancel(first.id)).state is GoalState.CANCELLED
        result = await world.missions.stop("test")
        assert result.is_echoed
        assert world.missions.goal(second.id).reason == "stop"
        thinking = [t for t in asyncio.all_tasks() if "_understand" in repr(t)]
        assert all(t.cancelling() or t.done() for t in thinking)


async def test_a_key_is_one_goal_even_across_a_restart(start: Starter) -> None:
    async with start() as world:
        first = await world.missions.submit("go to the kitchen", idempotency_key="k1")
        again = await world.missions.submit("go to the kitchen", idempotency_key="k1")
        assert again.id == first.id
        with pytest.raises(IdempotencyConflict) as error:
            await world.missions.submit("go to the sofa", idempotency_key="k1")
        assert first.id in error.value.message.en
        bridge = world.bridge
    bridge.lose_owner()
    async with start(bridge=bridge, prefix="h") as world:
        again = await world.missions.submit("go to the kitchen", idempotency_key="k1")
        assert again.id == first.id


async def test_a_new_process_takes_up_paused_and_moves_only_when_told(start: Starter) -> None:
    async with start() as world:
        goal = await world.missions.submit("go to the kitchen")
        await world.until(lambda: world.bridge.mode is Mode.ACTIVE)
        bridge = world.bridge
    bridge.lose_owner()
    moved = len(bridge.moved_epochs)
    async with start(bridge=bridge, prefix="h") as world:
        assert world.missions.goal(goal.id).reason == "planner_restarted"
        seq = bridge.seq
        await world.until(lambda: bridge.seq > seq + 60)
        assert len(bridge.moved_epochs) == moved
        act = OpRequest(id="act-1", source="test")
        await world.missions.resume(goal.id, act=act)
        await world.reach(goal.id, GoalState.SUCCEEDED)


async def test_errors_name_what_came_and_what_exists(start: Starter) -> None:
    async with start(hangs=True) as world:
        with pytest.raises(NothingToResume):
            await world.missions.resume()
        goal = await world.missions.submit("go to the kitchen")
        for call in (world.missions.cancel, world.missions.pause, world.missions.move):
            with pytest.raises(UnknownGoal, match=goal.id):
                await call("nope")
        with pytest.raises(BadState, match="planning"):
            await world.missions.confirm(goal.id)
        with pytest.raises(BadState, match="needs_clarification"):
            await world.missions.answer(goal.id, "the big one")
        for _ in range(32):
            await world.missions.submit("go to the kitchen")
        with pytest.raises(QueueFull, match="33"):
            await world.missions.submit("go to the kitchen")
        assert len(world.missions.goals(limit=5)) == 5


async def test_brains_that_fail_end_in_typed_outcomes(start: Starter) -> None:
    replies = ("not json", BrainDown("gone"), ValueError("a bug"),
               StepPlan(steps=(GoTo(place="cellar"),)))  # fmt: skip
    async with start(*replies) as world:
        ended = []
        for _ in replies:
            goal = await world.missions.submit("go to the cellar")
            done = await world.reach(goal.id, GoalState.REFUSED, GoalState.FAILED)
            ended.append((done.state.value, outcome_of(done).code.value))
        assert ended == [
            ("refused", "bad_plan"),
            ("failed", "model_unavailable"),
            ("failed", "model_unavailable"),
            ("refused", "unknown_place"),
        ]


async def test_a_question_is_answered_and_a_yes_is_waited_for(start: Starter) -> None:
    question = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))
    async with start(question, KITCHEN) as world:
        goal = await world.give("go there", GoalState.NEEDS_CLARIFICATION, confirm=True)
        await world.missions.answer(goal.id, "the kitchen")
        await world.reach(goal.id, GoalState.AWAITING_CONFIRMATION)
        assert world.brain.asked[1].text == "the kitchen"
        await world.missions.confirm(goal.id)
        await world.reach(goal.id, GoalState.SUCCEEDED)


async def test_pause_move_and_replace(start: Starter) -> None:
    async with start(KITCHEN, SOFA, SOFA, SOFA) as world:
        missions = world.missions
        first, second, third = [await missions.submit(f"see to {i}, please") for i in range(3)]
        await world.reach(third.id, GoalState.QUEUED)
        assert (await missions.move(third.id, second.id)).position == 0
        assert (await missions.pause(first.id)).reason == "operator"
        fourth = await missions.submit("please see to this", replace=True)
        await world.reach(fourth.id, GoalState.SUCCEEDED)
        assert missions.goal(third.id).reason == "held"
        await missions.resume()
        for goal in (first, third, second):
            await world.reach(goal.id, GoalState.SUCCEEDED)


async def test_no_route_is_a_typed_end(start: Starter) -> None:
    async with start(router=StraightRouter("no_route")) as world:
        goal = await world.missions.submit("go to the kitchen")
        done = await world.reach(goal.id, GoalState.FAILED)
        assert outcome_of(done).code is Code.NO_ROUTE
        assert "厨房" in outcome_of(done).message.zh


async def test_without_a_journal_no_goal_is_taken(
    start: Starter, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("planner.mission.journal_sync.SAFE_WITHIN_S", 0.2)
    async with start() as world:
        with closing(sqlite3.connect(tmp_path / "missions.db")) as connection:
            connection.execute("drop table missions")
        with pytest.raises(JournalDown, match="missions"):
            await world.missions.submit("go to the sofa")
        assert world.missions.loop.trouble is not None
        assert world.bridge.waypoints == []


@pytest.mark.parametrize("handler", ["_on_routed", "event"])
async def test_a_fault_of_ours_ends_the_loop_aloud(
    start: Starter, monkeypatch: pytest.MonkeyPatch, handler: str
) -> None:
    def broken(loop: Loop, *answer: object) -> None:
        if handler == "_on_routed" or isinstance(answer[0], Journalled):
            raise ZeroDivisionError("a fault of ours")
        ours(loop, *answer)

    ours = getattr(Loop, handler)
    monkeypatch.setattr(Loop, handler, broken)

    async def story() -> None:
        async with start() as world:
            asyncio.get_running_loop().set_exception_handler(lambda loop, context: None)
            await world.missions.submit("go to the kitchen")
            await world.until(lambda: world.missions.loop.failure is not None)
            assert isinstance(world.missions.loop.failure, ZeroDivisionError)
            assert world.bridge.waypoints == []
            raise Done

    with pytest.raises(Done):
        await story()


class Done(Exception):
    """Leave a planner that is known to have failed."""


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
    return outcome_of(goal).message.en


async def test_the_planner_answers_while_the_model_hangs(tmp_path: Path) -> None:
    async with planner(tmp_path, hangs=True) as together:
        hanging = await together.missions.submit(TO_KITCHEN)
        assert hanging.state is GoalState.PLANNING
        here = await say(together, "where are you?")
        assert told(here) == "I am in the living room, by the sofa."
        assert (outcome_of(here).code, outcome_of(here).message.zh[:4]) == (
            Code.ANSWERED,
            "我在客厅",
        )
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


async def test_forget_that_means_what_was_added_too_and_a_denial_no_other_place(
    tmp_path: Path,
) -> None:
    added = StepPlan(steps=(GoTo(place="sofa"),), does=PlanRole.AFTER)
    async with planner(tmp_path, KITCHEN, added) as together:
        first = await together.give(TO_KITCHEN, GoalState.RUNNING)
        second = await together.give("and have a look at the sofa", GoalState.QUEUED)
        assert told(await say(together, "never mind")).count("Cancelled: ") == 2
        for goal in (first, second):
            assert together.missions.goal(goal.id).state is GoalState.CANCELLED
    async with planner(tmp_path / "other", KITCHEN) as together:
        kept = await together.give(TO_KITCHEN, GoalState.RUNNING)
        await say(together, "hold on")
        assert told(await say(together, "别去客厅，宝宝睡着了")) == "There is nothing to cancel."
        assert together.missions.goal(kept.id).state is GoalState.PAUSED
        assert told(await say(together, "别去厨房，宝宝睡着了")).startswith("Cancelled: ")


async def test_a_goal_that_is_taken_back_makes_room_for_the_rest(tmp_path: Path) -> None:
    async with planner(tmp_path, KITCHEN, "no json at all") as together:
        first = await together.give(TO_KITCHEN, GoalState.RUNNING)
        await together.until(lambda: together.bridge.horizon is not None)
        second = await together.missions.submit("forget that, dance")
        assert together.missions.goal(first.id).state is GoalState.CANCELLED
        await together.reach(second.id, GoalState.REFUSED)
        assert [request.text for request in together.brain.asked][-1] == "forget that, dance"
        assert together.missions.goal(second.id).text == "forget that, dance"


@pytest.mark.parametrize("asks", [False, True])
async def test_a_goal_that_is_taken_back_is_the_only_one_and_nobody_overtakes(
    tmp_path: Path, asks: bool
) -> None:
    sofa = StepPlan(steps=(GoTo(place="sofa"),))
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


async def test_a_taught_place_is_driven_to_and_a_forgotten_one_is_not(tmp_path: Path) -> None:
    async with planner(tmp_path, CORNER, CORNER) as together:
        kept = await say(together, "remember this as corner")
        assert told(kept) == "I will remember this place as “corner”."
        together.bridge.pose = Pose2(1.5, 1.9, 0.0)
        goal = await say(together, "please go to the corner")
        assert (outcome_of(goal).code, told(goal)) == (Code.ARRIVED, "Arrived: corner.")
        assert together.brain.asked[-1].vocabulary.by_id["corner"].name.en == "corner"
        assert "forgotten" in told(await say(together, "forget the place corner"))
        goal = await say(together, "please go to the corner")
        assert goal.outcome is not None
        assert outcome_of(goal).code is Code.UNKNOWN_PLACE
        no = await say(together, "忘记沙发这个地方")
        assert outcome_of(no).code is Code.PLACE_NOT_KEPT
        assert "站点文件" in outcome_of(no).message.zh


async def test_what_a_model_writes_teaches_nothing(tmp_path: Path) -> None:
    words = "remember this as corner"
    plans = (StepPlan.model_validate({"steps": [{"kind": "say", "text": words}]}),)
    async with planner(tmp_path, *plans) as together:
        goal = await say(together, "please speak")
        assert goal.state is GoalState.SUCCEEDED
        assert together.missions.memory.taught_places == ()


async def test_questions_of_ones_own_do_not_clear_what_is_held(tmp_path: Path) -> None:
    async with planner(tmp_path) as together:
        running = await together.give(TO_KITCHEN, GoalState.RUNNING)
        await together.missions.stop("test")
        await say(together, "where are you?")
        assert together.missions.goal(running.id).state is GoalState.PAUSED
        assert together.bridge.held is not None


async def test_an_answer_may_take_the_question_back(tmp_path: Path) -> None:
    asks = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))
    async with planner(tmp_path, asks) as together:
        goal = await together.give("please go there", GoalState.NEEDS_CLARIFICATION)
        same = await together.missions.answer(goal.id, "where are you?")
        assert same.state is GoalState.NEEDS_CLARIFICATION
        taken_back = await together.missions.answer(goal.id, "never mind")
        assert taken_back.state is GoalState.CANCELLED
        with pytest.raises(BadState):  # nothing is asked any more
            await together.missions.answer(goal.id, "where are you?")


async def test_a_place_that_is_forgotten_on_the_way_ends_the_goal_and_the_robot_stands(
    tmp_path: Path,
) -> None:
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
            assert outcome_of(goal).code is Code.UNKNOWN_PLACE
            assert "“corner”" in outcome_of(goal).message.en
        await together.reach(kitchen.id, GoalState.SUCCEEDED)  # the next has the robot
        assert bridge.waypoints[-1].points == ()  # and then it stands


async def test_a_place_that_is_moved_on_the_way_is_driven_to_where_it_is_now(
    tmp_path: Path,
) -> None:
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


@pytest.mark.parametrize("plan", [ASKS_FIRST, WHICH])
async def test_what_is_said_to_the_planner_itself_is_no_answer(
    tmp_path: Path, plan: StepPlan | Clarify
) -> None:
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


@pytest.mark.parametrize(("plan", "answers"), [(ASKS_FIRST, True), (WHICH, False)])
async def test_go_on_answers_a_plans_own_question_and_no_other(
    tmp_path: Path, plan: StepPlan | Clarify, answers: bool
) -> None:
    async with planner(tmp_path, plan) as together:
        goal = await together.give(TO_KITCHEN, GoalState.NEEDS_CLARIFICATION)
        await together.missions.answer(goal.id, "yes, go on")
        if answers:
            await together.reach(goal.id, GoalState.SUCCEEDED)
            return
        beside = together.missions.goals()[-1]
        assert told(await together.reach(beside.id, GoalState.SUCCEEDED))[:16] == "There is nothing"
        assert together.missions.goal(goal.id).state is GoalState.NEEDS_CLARIFICATION


@pytest.mark.parametrize("asks", [True, False])
async def test_a_stop_within_an_answer_waits_for_no_disk_and_no_question(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, asks: bool
) -> None:
    async def full(_: object) -> None:
        raise JournalDown("disk full")

    async with planner(tmp_path, WHICH if asks else KITCHEN) as together:
        missions = together.missions
        goal = await missions.submit(TO_KITCHEN)
        await together.reach(goal.id, GoalState.NEEDS_CLARIFICATION if asks else GoalState.RUNNING)
        monkeypatch.setattr(Loop, "wait_written", full)
        answered = await missions.answer(goal.id, "forget that, stop")
        assert answered.state is GoalState.CANCELLED
        assert together.bridge.held is not None


async def test_faster_tells_that_it_never_drives_faster_than_planned(tmp_path: Path) -> None:
    async with planner(tmp_path, KITCHEN) as together:
        await together.give(TO_KITCHEN, GoalState.RUNNING)
        assert "50 %" in told(await say(together, "slow down"))
        for _ in range(2):
            heard = await say(together, "faster")
            assert "at full speed" in told(heard)
            assert "%" not in told(heard)
