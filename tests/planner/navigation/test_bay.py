"""A robot in a corridor stands at a wall, where a person is left a lane; or nowhere."""

from __future__ import annotations

import pytest

from planner.navigation import RouteFailure, RouteLimits, RouteRequest
from planner.navigation.bay import REACH_M, find_bay
from planner.navigation.costmap import static_costmap
from planner.navigation.router import Router
from tests.planner.navigation.floors import drawn
from wire import Pose2

LIMITS = RouteLimits()


def corridor(width: int) -> tuple[str, ...]:
    """Return a corridor 10 m long, as many quarters of a metre wide."""
    return ("#" * 40, *("." * 40 for _ in range(width)), "#" * 40)


def test_in_a_corridor_it_stands_at_one_side_no_nearer_to_the_person() -> None:
    site = drawn(*corridor(6))
    costmap = static_costmap(site, LIMITS.radius_m)
    robot, person = (5.0, 1.0), (4.0, 1.0)
    x_m, y_m = find_bay(costmap, costmap, robot, person)
    assert abs(y_m - 1.0) >= 0.25
    assert abs(x_m - robot[0]) <= REACH_M
    assert x_m >= robot[0] - 0.3


def test_where_nobody_could_pass_there_is_no_bay() -> None:
    site = drawn(*corridor(4))
    with pytest.raises(RouteFailure, match="no_route"):
        Router(site, LIMITS).route(
            RouteRequest(Pose2(5.0, 0.75, 0.0), Pose2(4.0, 0.75, 0.0), aside=True)
        )


def test_a_robot_that_leaves_a_lane_already_stays_where_it_is() -> None:
    """The corridor is 1.5 m wide; at 0.4 m from one wall the robot leaves 0.8 m."""
    site = drawn(*corridor(6))
    way = Router(site, LIMITS).route(
        RouteRequest(Pose2(5.0, 0.65, 0.0), Pose2(4.0, 1.0, 0.0), aside=True)
    )
    assert [(p.x_m, p.y_m) for p in way.points] == [(5.0, 0.65)]
    assert way.length_m == 0.0


def test_a_spot_behind_a_wall_is_no_bay() -> None:
    """A room beside the corridor is joined to it by a door 4 m away: nobody drives there."""
    rows = ["#" * 40, *("." * 40 for _ in range(3)), "." * 4 + "#" * 36]
    site = drawn(*rows, *("." * 40 for _ in range(4)), "#" * 40)
    costmap = static_costmap(site, LIMITS.radius_m)
    with pytest.raises(RouteFailure, match="no_route"):
        find_bay(costmap, costmap, (5.0, 0.75), (4.0, 0.75))


def test_the_way_aside_ends_in_the_bay() -> None:
    site = drawn(*corridor(6))
    way = Router(site, LIMITS).route(
        RouteRequest(Pose2(5.0, 1.0, 0.0), Pose2(4.0, 1.0, 0.0), aside=True)
    )
    assert abs(way.points[-1].y_m - 1.0) >= 0.2
