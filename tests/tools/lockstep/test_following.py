"""Follow somebody in lockstep while eyes fail and a person gives orders: never too near."""

from __future__ import annotations

from math import hypot, pi
from pathlib import Path

import pytest

from planner.brain import ScriptedBrain
from planner.plan import Follow, GoalState, StepPlan
from tests.known import known
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import GoalHandle, LockstepWorld
from tools.lockstep.homes import stock_home
from wire import Pose2

pytestmark = pytest.mark.nightly(keep=1)


BRAKING_M = 0.3
START = Pose2(1.5, 1.2, pi / 2)


@pytest.fixture(scope="session")
def lived_in(tmp_path_factory: pytest.TempPathFactory, repository: Path) -> Path:
    """Return the two rooms with a person in them."""
    people: dict[str, object] = {"anna": {"at": [2.4, 4.3]}}
    return stock_home(
        tmp_path_factory.mktemp("sites"), repository / "sites" / "two_room", {}, people
    )


@pytest.fixture
def world(ready: Ready, lived_in: Path) -> LockstepWorld:
    """Return a world that sees, and whose brain says to follow."""
    world = ready(site=lived_in, seed=3, start=START)
    world.put("anna", Pose2(1.5, 2.6, 0.0))
    world.open_eyes()
    world.think_with(ScriptedBrain([StepPlan(steps=(Follow(object="person"),))] * 2))
    return world


def away_m(world: LockstepWorld, y_m: float) -> float:
    return hypot(world.truth.x_m - 1.5, world.truth.y_m - y_m)


def walk_on(world: LockstepWorld, from_m: float, to_m: float, seconds: float = 20.0) -> float:
    """Let her walk at 0.4 m/s, then stand; return the least distance."""
    least_m, y_m = 9.0, from_m
    for _ in range(round(seconds / 0.01)):
        y_m = min(to_m, y_m + 0.004)
        world.put("anna", Pose2(1.5, y_m, 0.0))
        world.tick()
        least_m = min(least_m, away_m(world, y_m))
    return least_m


@pytest.mark.parametrize("driving", [False, True], ids=["standing", "driving"])
def test_a_camera_that_falls_silent_ends_it_where_it_stands(
    world: LockstepWorld, driving: bool
) -> None:
    world.run(1.5)
    goal, y_m = world.say("follow me"), 3.4
    walk_on(world, 2.6, y_m, 3.0 if driving else 9.0)
    assert (world.twist.v_mps > 0.1) is driving
    world.open_eyes().blind = "camera_silent"
    before_m, least_m, at_s = away_m(world, y_m), 9.0, world.now_s
    while not goal.has_ended:
        world.tick()
        least_m = min(least_m, away_m(world, y_m))
        assert world.now_s - at_s < 15.0
    assert least_m > before_m - (BRAKING_M if driving else 0.0) - 0.1
    plan = known(goal.record.plan)
    assert (goal.state, plan.steps[0].reason) == (GoalState.FAILED, "camera_silent")
    world.run_until(lambda w: w.standing, 2.0)


@pytest.mark.parametrize("way", ["pause", "stop"])
def test_one_that_is_stopped_or_paused_stands_while_she_walks_on(
    world: LockstepWorld, way: str
) -> None:
    world.run(1.5)
    goal = world.say("follow me")
    walk_on(world, 2.6, 3.4, 3.0)
    assert world.twist.v_mps > 0.1
    _order(world, goal, way)
    world.run_until(lambda w: w.standing, 2.0)
    still = world.truth
    walk_on(world, 3.4, 4.2, 4.0)
    assert goal.state is GoalState.PAUSED
    assert hypot(world.truth.x_m - still.x_m, world.truth.y_m - still.y_m) < 0.02
    world.resume(goal)
    assert walk_on(world, 4.2, 4.4, 8.0) > 0.9
    assert world.truth.y_m > still.y_m + 0.3, "it goes after her again"
    assert world.contacts == 0


def _order(world: LockstepWorld, goal: GoalHandle, way: str) -> None:
    if way == "stop":
        world.stop()
    else:
        world.pause(goal)
