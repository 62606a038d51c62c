"""Rehearse orders in a lockstep world, then drive them, to compare."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from math import hypot
from typing import TYPE_CHECKING

from planner.rehearsal import Rehearsal, Rehearser

if TYPE_CHECKING:
    from planner.navigation import RouteRequest, RouteResult
    from planner.navigation.obstacle_memory import ObstacleMemory
    from planner.navigation.router import Router
    from tools.lockstep import LockstepWorld


@dataclass(frozen=True)
class OwnRouter:
    """Find ways in this process, at once."""

    router: Router
    memory: ObstacleMemory

    async def route(self, request: RouteRequest) -> RouteResult:
        return self.router.route(request, memory=self.memory)


def rehearse(world: LockstepWorld, text: str) -> Rehearsal:
    """Return what a sentence would do, from where the robot stands."""
    missions = world.planner.missions
    router = OwnRouter(world.scene.router, world.planner.obstacle_memory)
    rehearser = Rehearser(missions.memory, world.scene.robot, router, lambda: missions.loop.book)
    return asyncio.run(rehearser.of_text(text))


def drive(world: LockstepWorld, text: str, limit_s: float = 300.0) -> tuple[str, float, float]:
    """Drive it; return how it ended, and what it took: metres by the truth, seconds."""
    goal = world.say(text)
    began_s, way_m = world.now_s, 0.0
    before = world.truth
    while not goal.has_ended and world.now_s - began_s < limit_s:
        world.tick()
        here = world.truth
        step_m = hypot(here.x_m - before.x_m, here.y_m - before.y_m)
        if step_m >= 0.01:  # noise of a standing robot is no way
            way_m, before = way_m + step_m, here
    return goal.state, way_m, world.now_s - began_s
