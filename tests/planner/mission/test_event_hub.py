"""Who listens hears goals, words and what is left, and is told where it fell behind."""

from __future__ import annotations

import asyncio
from typing import Any

from planner.mission.event_hub import MAX_WAITING, Hub
from planner.plan import GoalState, GoTo, Say, StepPlan
from tests.planner.mission.live import Starter


async def test_listeners_hear_goals_words_and_first_waypoints(start: Starter) -> None:
    plan = StepPlan(steps=(Say(text="你好"), GoTo(place="kitchen")))
    async with start(plan) as world:
        heard: list[tuple[int, dict[str, Any]]] = []

        async def listen() -> None:
            async with world.missions.subscribe() as events:
                async for item in events:
                    heard.append(item)  # noqa: PERF401  # kept even if this is cancelled

        listening = asyncio.create_task(listen())
        await asyncio.sleep(0)
        await world.give("say hello, then go to the kitchen", GoalState.SUCCEEDED)
        await world.missions.close()
        await listening
        kinds = [event["type"] for _, event in heard]
        assert {"goal", "status", "say", "first_waypoint"} <= set(kinds)
        assert kinds.count("say") == 1
        seqs = [seq for seq, _ in heard]
        assert seqs == sorted(set(seqs))


async def test_a_listener_that_falls_behind_is_told_so() -> None:
    hub = Hub()
    slow = hub.subscribe()
    for number in range(MAX_WAITING + 3):
        hub.publish({"type": "x", "number": number})
    seq, first = await anext(slow)
    assert first == {"type": "gap", "missed": MAX_WAITING}
    assert (await anext(slow))[0] == seq
    hub.close()
    assert [event["number"] async for _, event in slow] == [MAX_WAITING + 1, MAX_WAITING + 2]


async def test_progress_comes_as_events_and_falls(start: Starter) -> None:
    async with start() as world:
        subscription = world.missions.subscribe()
        goal = await world.give("go to the kitchen", GoalState.SUCCEEDED)
        subscription.close()
        events = [event async for _, event in subscription]
        left_m = [e["left_m"] for e in events if e["type"] == "progress"]
        assert all(e["goal"] == goal.id for e in events if e["type"] == "progress")
        assert len(left_m) >= 3
        assert left_m == sorted(left_m, reverse=True)
        assert left_m[-1] < 0.5 < left_m[0]
