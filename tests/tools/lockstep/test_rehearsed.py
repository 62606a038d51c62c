"""What is rehearsed is what is driven: metres within 5 %, seconds within 15 %."""

from __future__ import annotations

import asyncio
from dataclasses import dataclass
from math import hypot

import pytest

from lockstep.rehearsal_drive import RehearsalDrive
from planner.driven_rehearsal import DrivenPlan, DriveRequest, steps_to_drive
from planner.navigation import RouteRequest, RouteResult
from planner.navigation.obstacle_memory import ObstacleMemory
from planner.navigation.router import Router
from planner.rehearsal import Rehearsal, Rehearser
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import LockstepWorld

pytestmark = pytest.mark.nightly(keep=2)


METRES, SECONDS = 0.05, 0.15


@pytest.mark.parametrize(
    "order",
    ["go to the living room", "go to the kitchen, wait 2 seconds, then go home",
     "go forward 0.5 metres", "turn left 200 degrees, then go to the kitchen"],
)  # fmt: skip
def test_a_drive_takes_what_its_rehearsal_told(ready: Ready, order: str) -> None:
    world = ready(seed=1)
    told = rehearse(world, order)
    assert told.is_whole
    tried = simulate(world, order)
    ended, way_m, took_s = drive(world, order)
    assert ended == "succeeded", world.describe()
    assert told.length_m == pytest.approx(way_m, rel=METRES)
    assert told.seconds == pytest.approx(took_s, rel=SECONDS)
    assert [step.outcome for step in tried.steps] == ["succeeded"] * len(tried.steps)
    assert tried.length_m == pytest.approx(way_m, rel=METRES)
    assert tried.seconds == pytest.approx(took_s, rel=SECONDS)
    assert tried.contacts == world.contacts == 0


def test_a_rehearsal_moves_nothing_and_leaves_no_goal(ready: Ready) -> None:
    world = ready(seed=1)
    told = rehearse(world, "go to the living room")
    assert told.narrowest_m == pytest.approx(1.0, abs=0.06), "the door between the rooms"
    world.run(0.5)
    assert world.standing
    assert not world.planner.book.missions


def test_a_way_without_room_is_shut_as_the_drive_would_find(ready: Ready) -> None:
    world = ready(seed=1)
    told = rehearse(world, "go forward 9 metres")
    assert (told.steps[0].does, told.steps[0].code) == ("shut", "no_room")
    assert drive(world, "go forward 9 metres")[0] == "failed"


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


def simulate(world: LockstepWorld, text: str) -> DrivenPlan:
    """Return what a sentence comes to in the simulator, from where a world's robot stands.

    The simulator is told what the planner of that world knows: the map, and what its lidar has
    shown. What truly stands there it is not told.
    """
    missions = world.planner.missions
    layer = missions.obstacles.report if missions.obstacles is not None else None
    router = OwnRouter(world.scene.router, world.planner.obstacle_memory)
    rehearser = Rehearser(missions.memory, world.scene.robot, router, lambda: missions.loop.book)
    plan = asyncio.run(rehearser.plan_of(text))
    shown = asyncio.run(rehearser.of_plan(plan))
    request = DriveRequest(
        site=str(world.scene.folder.absolute()),
        robot=world.scene.robot,
        begins=shown.begins,
        rows=steps_to_drive(plan, shown),
        cells_bytes=len(layer.cells) if layer is not None else 0,
    )
    driving = RehearsalDrive(request, layer.cells + layer.suspicions if layer is not None else b"")
    for _ in driving.turns():
        pass
    return driving.plan()
