"""Set a mission driving, and look whether it stands. Shared by the stories of missions."""

from __future__ import annotations

from planner.plan import GoalState
from tests.planner.mission.lockstep import Together, go
from wire import Mode

RUNNING, PAUSED, QUEUED = GoalState.RUNNING, GoalState.PAUSED, GoalState.QUEUED
SUCCEEDED, FAILED, CANCELLED = GoalState.SUCCEEDED, GoalState.FAILED, GoalState.CANCELLED


def driving(world: Together, *places: str) -> str:
    goal = world.give(go(*(places or ("kitchen",))))
    world.run(1.0)
    assert world.goal(goal).state is RUNNING
    assert world.bridge.mode is Mode.ACTIVE
    return goal


def standing_still(world: Together, seconds: float = 2.0) -> bool:
    before = world.bridge.pose
    world.run(seconds)
    return world.bridge.pose == before
