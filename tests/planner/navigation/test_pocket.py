"""A robot makes way for another one where it parts no floor, and only who has the shorter way."""

from __future__ import annotations

from dataclasses import replace
from math import cos, hypot, pi, sin

import pytest

from planner.navigation import RouteFailure, RouteLimits, RouteRequest
from planner.navigation.router import Router
from tests.planner.navigation.floors import drawn
from wire import Pose2

LIMITS = RouteLimits()
ROOMS = drawn(
    "#" * 40,
    *(["#" + "." * 38 + "#"] * 10),
    "#" * 18 + "." * 4 + "#" * 18,
    *(["#" + "." * 38 + "#"] * 10),
    "#" * 40,
)
"""Two rooms of 9.5 by 2.5 m, above and below a wall with a door 1 m wide at x 5.0, y 2.875."""
DOOR_M, BEFORE_M = (5.0, 2.85), (5.0, 3.55)
CORNERS = ((1.0, 1.0), (9.0, 1.0), (1.0, 4.8), (9.0, 4.8))


def aside(robot: tuple[float, float], other: tuple[float, float]) -> RouteRequest:
    """Return the request of a robot that makes way for another one, as the lidar sees that."""
    away_m = hypot(other[0] - robot[0], other[1] - robot[1])
    share = (away_m - 0.15) / away_m
    seen_x_m, seen_y_m = (a + share * (b - a) for a, b in zip(robot, other, strict=True))
    start, seen = Pose2(*robot, 0.0), Pose2(seen_x_m, seen_y_m, 0.0)
    return RouteRequest(start, seen, aside=True, passes_m=0.3)


def end(request: RouteRequest) -> tuple[float, float]:
    last = Router(ROOMS, LIMITS).route(request).points[-1]
    return last.x_m, last.y_m


def can_pass(stands: tuple[float, float], from_m: tuple[float, float]) -> bool:
    """Return whether another robot finds its way from there to both rooms' ends past it."""
    around = [2 * pi * i / 24 for i in range(24)]
    body = tuple((stands[0] + 0.3 * cos(a), stands[1] + 0.3 * sin(a)) for a in around)
    router, start = Router(ROOMS, LIMITS), Pose2(*from_m, 0.0)
    ways = [router.route(RouteRequest(start, Pose2(*far, 0.0), body)) for far in CORNERS]
    return all(way.moved_goal_m == 0.0 for way in ways)


@pytest.mark.parametrize(("robot", "other"), [(DOOR_M, BEFORE_M), (BEFORE_M, DOOR_M)])
def test_past_where_it_stands_another_one_comes_to_every_corner(
    robot: tuple[float, float], other: tuple[float, float]
) -> None:
    with pytest.raises(RouteFailure):
        can_pass(robot, other)
    assert can_pass(end(aside(robot, other)), other)


def test_two_that_are_seen_as_one_are_passed_one_by_one() -> None:
    """No door lets a disc as wide as two through: before one, any place would seem aside."""
    two = replace(aside(DOOR_M, BEFORE_M), passes_m=0.68)
    assert end(two) != DOOR_M
    assert can_pass(end(two), BEFORE_M)


def test_where_nobody_is_in_anybodys_way_it_stays() -> None:
    assert end(aside((8.0, 1.5), (7.2, 1.5))) == (8.0, 1.5)


def test_asked_first_the_one_with_the_shorter_way_goes_and_the_other_does_not() -> None:
    assert end(replace(aside(BEFORE_M, DOOR_M), strict=True)) == end(aside(BEFORE_M, DOOR_M))
    with pytest.raises(RouteFailure, match="shorter way"):
        end(replace(aside(DOOR_M, BEFORE_M), strict=True))


def test_without_a_place_to_pass_there_is_none() -> None:
    """A tube 0.9 m wide, longer than anybody goes back, with the robot in its middle."""
    tube = drawn("#" * 120, *(["#" + "." * 118 + "#"] * 4), "#" * 120)
    with pytest.raises(RouteFailure, match="could pass"):
        Router(tube, LIMITS).route(aside((15.0, 0.75), (14.0, 0.75)))


def test_nobody_makes_way_across_the_others_way() -> None:
    """The nearest pocket of a robot before the door lies behind the other one's way out of it."""
    robot, other = (5.9, 3.55), (5.0, 2.85)
    line = Router(ROOMS, LIMITS).route(aside(robot, other)).points
    away_m = hypot(robot[0] - other[0], robot[1] - other[1])
    assert all(hypot(p.x_m - other[0], p.y_m - other[1]) >= away_m - 0.2 for p in line)
