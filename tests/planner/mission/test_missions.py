"""The door of the missions on a real event loop: goals, stops, keys, errors, listeners."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest
import sqlalchemy as sa

from planner.brain.errors import BrainDown
from planner.mission import (
    BadState,
    IdempotencyConflict,
    JournalDown,
    NothingToResume,
    QueueFull,
    UnknownGoal,
)
from planner.mission.event_hub import MAX_WAITING, Hub
from planner.mission.events import Journalled
from planner.mission.loop import Loop
from planner.plan import Bilingual, Clarify, Code, GoalState, GoTo, Say, StepPlan
from planner.site import Site
from tests.planner.mission.live import (
    KITCHEN,
    SOFA,
    StraightRouter,
    planner,
    run,
)
from wire import Mode, OpRequest


def test_a_sentence_ends_where_it_says(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site) as world:
            goal = await world.missions.submit("go to the kitchen")
            assert goal.state in (GoalState.PLANNING, GoalState.RUNNING)
            done = await world.reach(goal.id, GoalState.SUCCEEDED)
            assert done.outcome is not None
            assert done.outcome.reached is not None
            assert done.outcome.reached.room == "kitchen"
            assert world.brain.asked[0].room == "living_room"
            assert len(world.missions.first_waypoint_s) == 1
            assert world.missions.goals()[0] == done
            assert world.missions.snapshot()["goals"][0]["id"] == goal.id

    run(story())


def test_stop_is_never_asked_of_a_brain_and_pauses(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site) as world:
            goal = await world.missions.submit("go to the kitchen")
            await world.until(lambda: world.bridge.mode is Mode.ACTIVE)
            stopped = await world.missions.submit("停下！")
            assert (stopped.state, stopped.language) == (GoalState.SUCCEEDED, "zh")
            assert stopped.outcome is not None
            assert stopped.outcome.code is Code.STOPPED
            assert world.missions.goal(goal.id).reason == "stop"
            assert len(world.brain.asked) == 1
            assert world.bridge.held is not None
            act = OpRequest(id="act-1", source="test")
            await world.missions.resume(act=act)
            await world.reach(goal.id, GoalState.SUCCEEDED)

    run(story())


def test_a_stop_that_nobody_confirms_says_so(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site) as world:
            world.bridge.deaf = True
            stopped = await world.missions.submit("stop")
            assert (stopped.state, stopped.reason) == (GoalState.FAILED, "bridge_silent")

    run(story())


def test_stop_and_cancel_end_thinking_at_once(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, hangs=True) as world:
            first = await world.missions.submit("go to the kitchen")
            second = await world.missions.submit("go to the sofa")
            assert (await world.missions.cancel(first.id)).state is GoalState.CANCELLED
            result = await world.missions.stop("test")
            assert result.is_echoed
            assert world.missions.goal(second.id).reason == "stop"
            thinking = [t for t in asyncio.all_tasks() if "_understand" in repr(t)]
            assert all(t.cancelling() or t.done() for t in thinking)

    run(story())


def test_a_key_is_one_goal_even_across_a_restart(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site) as world:
            first = await world.missions.submit("go to the kitchen", idempotency_key="k1")
            again = await world.missions.submit("go to the kitchen", idempotency_key="k1")
            assert again.id == first.id
            with pytest.raises(IdempotencyConflict) as error:
                await world.missions.submit("go to the sofa", idempotency_key="k1")
            assert first.id in error.value.message.en
            bridge = world.bridge
        bridge.lose_owner()
        async with planner(tmp_path, site, bridge=bridge, prefix="h") as world:
            again = await world.missions.submit("go to the kitchen", idempotency_key="k1")
            assert again.id == first.id

    run(story())


def test_a_new_process_takes_up_paused_and_moves_only_when_told(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site) as world:
            goal = await world.missions.submit("go to the kitchen")
            await world.until(lambda: world.bridge.mode is Mode.ACTIVE)
            bridge = world.bridge
        bridge.lose_owner()
        moved = len(bridge.moved_epochs)
        async with planner(tmp_path, site, bridge=bridge, prefix="h") as world:
            assert world.missions.goal(goal.id).reason == "planner_restarted"
            seq = bridge.seq
            await world.until(lambda: bridge.seq > seq + 60)
            assert len(bridge.moved_epochs) == moved
            act = OpRequest(id="act-1", source="test")
            await world.missions.resume(goal.id, act=act)
            await world.reach(goal.id, GoalState.SUCCEEDED)

    run(story())


def test_errors_name_what_came_and_what_exists(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, hangs=True) as world:
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

    run(story())


def test_brains_that_fail_end_in_typed_outcomes(tmp_path: Path, site: Site) -> None:
    replies = ("not json", BrainDown("gone"), ValueError("a bug"),
               StepPlan(steps=(GoTo(place="cellar"),)))  # fmt: skip

    async def story() -> None:
        async with planner(tmp_path, site, *replies) as world:
            ended = []
            for _ in replies:
                goal = await world.missions.submit("go to the cellar")
                done = await world.reach(goal.id, GoalState.REFUSED, GoalState.FAILED)
                assert done.outcome is not None
                ended.append((done.state.value, done.outcome.code.value))
            assert ended == [
                ("refused", "bad_plan"),
                ("failed", "model_unavailable"),
                ("failed", "model_unavailable"),
                ("refused", "unknown_place"),
            ]

    run(story())


def test_a_question_is_answered_and_a_yes_is_waited_for(tmp_path: Path, site: Site) -> None:
    question = Clarify(code=Code.AMBIGUOUS, question=Bilingual(en="Which?", zh="哪个？"))

    async def story() -> None:
        async with planner(tmp_path, site, question, KITCHEN) as world:
            goal = await world.missions.submit("go there", confirm=True)
            await world.reach(goal.id, GoalState.NEEDS_CLARIFICATION)
            await world.missions.answer(goal.id, "the kitchen")
            await world.reach(goal.id, GoalState.AWAITING_CONFIRMATION)
            assert world.brain.asked[1].text == "the kitchen"
            await world.missions.confirm(goal.id)
            await world.reach(goal.id, GoalState.SUCCEEDED)

    run(story())


def test_pause_move_and_replace(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, KITCHEN, SOFA, SOFA, SOFA) as world:
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

    run(story())


def test_no_route_is_a_typed_end(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site, router=StraightRouter("no_route")) as world:
            goal = await world.missions.submit("go to the kitchen")
            done = await world.reach(goal.id, GoalState.FAILED)
            assert done.outcome is not None
            assert done.outcome.code is Code.NO_ROUTE
            assert "厨房" in done.outcome.message.zh

    run(story())


def test_without_a_journal_no_goal_is_taken(
    tmp_path: Path, site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("planner.mission.journal_sync.SAFE_WITHIN_S", 0.2)

    async def story() -> None:
        async with planner(tmp_path, site) as world:
            engine = sa.create_engine(f"sqlite:///{tmp_path / 'missions.db'}")
            with engine.begin() as connection:
                connection.execute(sa.text("drop table missions"))
            engine.dispose()
            with pytest.raises(JournalDown, match="missions"):
                await world.missions.submit("go to the sofa")
            assert world.missions.journal_trouble is not None
            assert world.bridge.waypoints == []

    run(story())


def test_listeners_hear_goals_words_and_first_waypoints(tmp_path: Path, site: Site) -> None:
    plan = StepPlan(steps=(Say(text="你好"), GoTo(place="kitchen")))

    async def story() -> None:
        async with planner(tmp_path, site, plan) as world:
            heard: list[tuple[int, dict[str, Any]]] = []

            async def listen() -> None:
                async with world.missions.subscribe() as events:
                    async for item in events:
                        heard.append(item)  # noqa: PERF401  # kept even if this is cancelled

            listening = asyncio.create_task(listen())
            await asyncio.sleep(0)
            goal = await world.missions.submit("say hello, then go to the kitchen")
            await world.reach(goal.id, GoalState.SUCCEEDED)
            await world.missions.close()
            await listening
            kinds = [event["type"] for _, event in heard]
            assert {"goal", "status", "say", "first_waypoint"} <= set(kinds)
            assert kinds.count("say") == 1
            seqs = [seq for seq, _ in heard]
            assert seqs == sorted(set(seqs))

    run(story())


def test_a_listener_that_falls_behind_is_told_so() -> None:
    async def story() -> None:
        hub = Hub()
        slow = hub.subscribe()
        for number in range(MAX_WAITING + 3):
            hub.publish({"type": "x", "number": number})
        seq, first = await anext(slow)
        assert first == {"type": "gap", "missed": MAX_WAITING}
        assert (await anext(slow))[0] == seq
        hub.close()
        assert [event["number"] async for _, event in slow] == [MAX_WAITING + 1, MAX_WAITING + 2]

    run(story())


@pytest.mark.parametrize("handler", ["_on_routed", "event"])
def test_a_fault_of_ours_ends_the_loop_aloud(
    tmp_path: Path, site: Site, monkeypatch: pytest.MonkeyPatch, handler: str
) -> None:
    def broken(loop: Loop, *answer: object) -> None:
        if handler == "_on_routed" or isinstance(answer[0], Journalled):
            raise ZeroDivisionError("a fault of ours")
        ours(loop, *answer)

    ours = getattr(Loop, handler)

    async def story() -> None:
        monkeypatch.setattr(Loop, handler, broken)
        async with planner(tmp_path, site) as world:
            asyncio.get_running_loop().set_exception_handler(lambda loop, context: None)
            await world.missions.submit("go to the kitchen")
            await world.until(lambda: world.missions.failure is not None)
            assert isinstance(world.missions.failure, ZeroDivisionError)
            assert world.bridge.waypoints == []
            raise Done

    with pytest.raises(Done):
        run(story())


class Done(Exception):
    """Leave a planner that is known to have failed."""
