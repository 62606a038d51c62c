"""Who listens hears what is left of a step, and the record says the same."""

from __future__ import annotations

from pathlib import Path

from planner.plan import GoalState
from planner.site import Site
from tests.planner.mission.live import planner, run


def test_progress_comes_as_events_and_falls(tmp_path: Path, site: Site) -> None:
    async def story() -> None:
        async with planner(tmp_path, site) as world:
            subscription = world.missions.subscribe()
            goal = await world.missions.submit("go to the kitchen")
            await world.reach(goal.id, GoalState.SUCCEEDED)
            subscription.close()
            events = [event async for _, event in subscription]
            left_m = [e["left_m"] for e in events if e["type"] == "progress"]
            assert all(e["goal"] == goal.id for e in events if e["type"] == "progress")
            assert len(left_m) >= 3
            assert left_m == sorted(left_m, reverse=True)
            assert left_m[-1] < 0.5 < left_m[0]

    run(story())
