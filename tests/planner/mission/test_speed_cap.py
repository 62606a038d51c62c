"""Check the speed cap that a person leaves to a running goal."""

from __future__ import annotations

import pytest

from planner.mission.events import ChangeSpeed, ClosingIn
from planner.mission.plan_roles import LEAST_SPEED_SHARE
from planner.mission.route_doubts import LASTS_S, MEETING_SHARE
from tests.planner.mission.lockstep import Together, go


def test_each_slower_halves_the_cap_down_to_a_quarter_and_faster_takes_it_back() -> None:
    world = Together()
    world.run(0.5)
    goal = world.give(go("kitchen"))
    world.run(1.0)
    seen = []
    for slower in (True, True, True, False, False, False):
        world.event(ChangeSpeed(goal, slower=slower))
        seen.append(world.goal(goal).speed_share)
    assert seen == [0.5, LEAST_SPEED_SHARE, LEAST_SPEED_SHARE, 0.5, 1.0, 1.0]


@pytest.mark.parametrize("share", [0.5, 0.25])
def test_no_waypoint_is_faster_than_the_cap(share: float) -> None:
    world = Together()
    world.run(0.5)
    goal = world.give(go("kitchen"))
    world.run(1.0)
    while world.goal(goal).speed_share != share:
        world.event(ChangeSpeed(goal, slower=True))
    world.run(0.2)
    assert fastest_mps(world) <= share * 0.5 + 1e-9


def fastest_mps(world: Together) -> float:
    """Return the highest speed among the newest waypoints."""
    return max(abs(point.speed_mps) for point in world.bridge.waypoints[-1].points)


def test_another_robot_that_closes_in_is_met_at_half_the_speed_as_long_as_it_does() -> None:
    world = Together()
    world.run(0.5)
    goal = world.give(go("kitchen"))
    world.run(1.0)
    free_mps, leg = fastest_mps(world), world.engine.leg
    assert leg is not None
    world.event(ClosingIn("another", leg.leg))
    world.event(ClosingIn(leg.mission, leg.leg - 1))
    world.run(0.2)
    assert fastest_mps(world) == free_mps, "it was told of another leg"
    world.event(ClosingIn(leg.mission, leg.leg))
    world.run(0.2)
    assert fastest_mps(world) <= MEETING_SHARE * free_mps + 1e-9
    assert world.goal(goal).speed_share == 1.0, "which is a person's word"
    world.event(ChangeSpeed(goal, slower=True))
    world.event(ChangeSpeed(goal, slower=True))
    world.run(0.2)
    assert fastest_mps(world) <= LEAST_SPEED_SHARE * free_mps + 1e-9
    for _ in range(2):
        world.event(ChangeSpeed(goal, slower=False))
    world.run(LASTS_S + 0.2)
    assert fastest_mps(world) == free_mps
