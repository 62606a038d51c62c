"""What stands in the way ahead bends the way before the robot is held, where there is another."""

from __future__ import annotations

import pytest

from planner.plan import GoalState
from tests.known import known
from tests.tools.lockstep.conftest import Ready
from tools.lockstep import GoalHandle, LockstepWorld

pytestmark = pytest.mark.nightly(keep=1)


LIMIT_S = 90.0


def set_off(ready: Ready, order: str) -> tuple[LockstepWorld, GoalHandle]:
    """Return a drive in whose way a crate was put, some 3 m ahead."""
    world = ready(site="home", seed=3)
    goal = world.say(order)
    loop = world.planner.missions.loop
    world.run(4.0)  # into the hallway
    way = known(loop._engine.way_ahead(3.0))
    world.place_obstacle(*way.points[-1])
    return world, goal


def watch(world: LockstepWorld, goal: GoalHandle) -> tuple[list[str], bool]:
    """Run until the goal ends; return what was told of the way, in order, and if it was held."""
    told: list[str] = []
    while not (goal.has_ended or world.status.blocked):
        world.run(0.1)
        leg = world.planner.missions.loop.leg
        code = leg.doubt.code if leg is not None and leg.doubt is not None else None
        if code is not None and told[-1:] != [code]:
            told.append(code)
        assert world.now_s < 1_000.0 + LIMIT_S
    return told, world.status.blocked


def test_with_another_way_the_robot_takes_it_and_is_never_held(ready: Ready) -> None:
    world, goal = set_off(ready, "go to the study")
    told, held = watch(world, goal)
    assert goal.state is GoalState.SUCCEEDED
    assert told[:2] == ["route_doubted", "route_bent"]
    assert not held


def test_without_another_way_it_goes_on_and_says_so_until_the_bridge_holds_it(ready: Ready) -> None:
    world, goal = set_off(ready, "go to the kitchen")
    told, held = watch(world, goal)
    assert held
    assert told[:2] == ["route_doubted", "route_kept"]
    assert "route_bent" not in told
