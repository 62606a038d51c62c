"""A way keeps right where room lasts, never leaves free floor, and ends where it did."""

from __future__ import annotations

from itertools import pairwise
from math import hypot

import numpy as np
import pytest

from planner.navigation import RouteLimits, RouteRequest, RouteResult
from planner.navigation.keep_right import MOST_M, keep_right
from planner.navigation.router import Router
from planner.navigation.smoothing import is_free
from planner.navigation.waypoints import evenly
from planner.site import Site
from tests.planner.navigation.floors import drawn
from wire import Pose2

LIMITS = RouteLimits()
EAST = (Pose2(1.0, 1.0, 0.0), Pose2(9.0, 1.0, 0.0))
WEST = (Pose2(9.0, 1.0, 0.0), Pose2(1.0, 1.0, 0.0))


def corridor(width: int) -> Site:
    """Return a corridor 10 m long, as many quarters of a metre wide, from y = 0.25 on."""
    return drawn("#" * 40, *("." * 40 for _ in range(width)), "#" * 40)


def way(site: Site, ends: tuple[Pose2, Pose2], right_m: float) -> RouteResult:
    return Router(site, LIMITS).route(RouteRequest(*ends, keep_right_m=right_m))


@pytest.mark.parametrize(("ends", "side"), [(EAST, -1.0), (WEST, 1.0)])
def test_in_a_corridor_it_leads_along_the_right_wall_and_ends_where_it_was_to(
    ends: tuple[Pose2, Pose2], side: float
) -> None:
    """The corridor is 1.5 m wide: its middle is y = 1.0, and a robot needs 0.35 m."""
    found = way(corridor(6), ends, 6.0)
    start_x, goal_x = ends[0].x_m, ends[1].x_m
    middle = [p.y_m for p in found.points if 2.0 <= abs(p.x_m - start_x) <= 4.0]
    assert all(0.25 <= side * (y - 1.0) <= 0.38 for y in middle)
    assert (found.points[-1].x_m, found.points[-1].y_m) == pytest.approx((goal_x, 1.0), abs=0.01)
    assert abs(found.points[0].y_m - 1.0) <= 0.1, "it begins at the robot"


def test_every_gap_is_one_that_the_bridge_takes() -> None:
    points = way(corridor(6), EAST, 6.0).points
    gaps = [hypot(b.x_m - a.x_m, b.y_m - a.y_m) for a, b in pairwise(points)]
    assert all(0.05 <= gap <= 0.25 for gap in gaps[1:-1])
    assert all(0.01 <= gap <= 0.25 for gap in (gaps[0], gaps[-1]))


def test_without_room_the_way_stays_as_it_was() -> None:
    site, ends = corridor(3), (Pose2(1.0, 0.62, 0.0), Pose2(9.0, 0.62, 0.0))
    assert way(site, ends, 6.0).points == way(site, ends, 0.0).points


def test_a_way_that_is_not_to_keep_right_does_not() -> None:
    points = way(corridor(6), EAST, 0.0).points
    assert all(abs(p.y_m - 1.0) <= 0.06 for p in points)


def test_beyond_its_reach_it_is_the_way_it_was() -> None:
    points = way(corridor(6), EAST, 3.0).points
    assert all(abs(p.y_m - 1.0) <= 0.06 for p in points if p.x_m >= 4.3)


def test_a_door_beside_the_way_is_no_lane() -> None:
    """A door of 1 m in the right wall, into a room: the way passes it straight."""
    rows = ["#" * 40, *("." * 40 for _ in range(6)), "#" * 18 + "." * 4 + "#" * 18]
    site = drawn(*rows, *("." * 40 for _ in range(6)), "#" * 40)
    ends = Pose2(1.0, 2.75, 0.0), Pose2(9.0, 2.75, 0.0)
    near = [p.y_m for p in way(site, ends, 7.0).points if 3.0 <= p.x_m <= 6.5]
    assert max(near) - min(near) <= 0.08


@pytest.mark.parametrize("seed", range(8))
def test_among_things_it_stays_on_free_floor_and_within_its_bound(seed: int) -> None:
    random = np.random.default_rng(seed)
    marks = [["."] * 40 for _ in range(12)]
    for row, column in random.integers((1, 6), (11, 34), (10, 2)):
        marks[row][column] = "#"
    site = drawn("#" * 40, *("".join(row) for row in marks), "#" * 40)
    router = Router(site, LIMITS)
    costmap = router._mapped
    plain = router.route(RouteRequest(Pose2(1.0, 1.7, 0.0), Pose2(9.0, 1.7, 0.0)))
    line = evenly(np.asarray([(p.x_m, p.y_m) for p in plain.points]))
    right = keep_right(costmap, line, 6.0)
    assert is_free(costmap, right)
    away = [np.hypot(*(line - point).T).min() for point in right]
    assert max(away) <= MOST_M + 0.01
