"""Check the speed cap that a person leaves to a running goal."""

from __future__ import annotations

import pytest

from planner.mission.events import ChangeSpeed
from planner.mission.plan_roles import LEAST_SPEED_SHARE
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
    points = world.bridge.waypoints[-1].points
    assert points
    assert max(abs(point.speed_mps) for point in points) <= share * 0.5 + 1e-9
