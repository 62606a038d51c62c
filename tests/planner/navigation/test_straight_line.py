"""Straight ways end where floor ends, ahead and backwards, and the bridge takes their horizons."""

from __future__ import annotations

from math import cos, hypot, pi, sin

import pytest

from bridge.core.authority.leg_tracking import check_horizon
from bridge.core.geometry.fence import build_fence
from planner.navigation import LegPath, RouteFailure, RouteLimits, RouteRequest, RouteResult, cut
from planner.navigation.router import Router
from planner.navigation.straight_line import BACK_MPS
from planner.site import Site
from tests.planner.navigation.floors import drawn
from wire import Pose2

# 5 m wide, 2 m deep, walls of 0.25 m: free floor for the centre from 0.60 m to 4.40 m.
HALL = drawn(*("#" * 20, *(("#" + "." * 18 + "#"),) * 6, "#" * 20))
FREE_FROM_M, FREE_TO_M, CELL_M = 0.60, 4.40, 0.05


def lay(site: Site, start: Pose2, along_m: float, *boxes: tuple[float, float]) -> RouteResult:
    goal = Pose2(
        start.x_m + along_m * cos(start.yaw_rad),
        start.y_m + along_m * sin(start.yaw_rad),
        start.yaw_rad,
    )
    return Router(site, RouteLimits()).route(RouteRequest(start, goal, boxes, straight=True))


@pytest.mark.parametrize(
    ("x_m", "yaw_rad", "along_m", "ends_m"),
    [
        (1.0, 0.0, 0.5, 1.5),
        (2.0, 0.0, -0.3, 1.7),
        (2.0, pi, 0.3, 1.7),
        (2.0, pi, -0.7, 2.7),
        (3.0, 0.0, 5.0, FREE_TO_M),
        (2.0, 0.0, -5.0, FREE_FROM_M),
        (4.37, 0.0, 1.0, 4.37),
    ],
)
def test_it_goes_as_far_as_floor_is_free_and_says_what_is_missing(
    x_m: float, yaw_rad: float, along_m: float, ends_m: float
) -> None:
    found = lay(HALL, Pose2(x_m, 1.0, yaw_rad), along_m)
    end = found.points[-1]
    assert end.x_m == pytest.approx(ends_m, abs=CELL_M + 0.02)
    assert end.y_m == pytest.approx(1.0, abs=1e-6)
    assert found.length_m + found.moved_goal_m == pytest.approx(abs(along_m), abs=0.03)
    ahead = along_m > 0
    assert all((p.speed_mps > 0.0) == ahead for p in found.points)
    assert ahead or all(abs(p.speed_mps) <= BACK_MPS for p in found.points)


def test_what_the_lidar_sees_ends_it_too() -> None:
    assert lay(HALL, Pose2(1.0, 1.0, 0.0), 2.0).moved_goal_m == pytest.approx(0.0)
    found = lay(HALL, Pose2(1.0, 1.0, 0.0), 2.0, (2.5, 1.0), (2.5, 1.05))
    assert found.points[-1].x_m < 2.5 - RouteLimits().radius_m


def test_a_robot_at_the_wall_may_leave_it_but_comes_no_nearer() -> None:
    at_the_wall = Pose2(4.60, 1.0, 0.0)  # its disc is in the costmap's margin
    assert lay(HALL, at_the_wall, -1.0).moved_goal_m == pytest.approx(0.0)
    assert lay(HALL, at_the_wall, 0.5).length_m <= CELL_M + 0.02
    with pytest.raises(RouteFailure, match="start_outside_map"):
        lay(HALL, Pose2(9.0, 1.0, 0.0), 1.0)


@pytest.mark.parametrize("along_m", [0.5, -0.8])
def test_the_bridge_takes_every_horizon_of_it(two_room: Site, along_m: float) -> None:
    record = two_room.fence.record
    fence = build_fence(record.map_id, record.allowed, record.keep_outs)
    start = two_room.place("kitchen")
    assert start is not None
    found = lay(two_room, start.pose, along_m)
    assert found.moved_goal_m == pytest.approx(0.0)
    path, progress_m, final = LegPath.of(found.points, start.pose.yaw_rad), 0.0, False
    for step in range(int(path.length_m / 0.02)):
        share = step * 0.02 / path.length_m
        end = path.points[-1]
        robot = Pose2(
            start.pose.x_m + share * (end.x_m - start.pose.x_m),
            start.pose.y_m + share * (end.y_m - start.pose.y_m),
            start.pose.yaw_rad,
        )
        horizon = cut(path, robot, progress_m)
        assert check_horizon(horizon.points, robot, 0.5, fence) == ()
        assert hypot(horizon.points[0].x_m - robot.x_m, horizon.points[0].y_m - robot.y_m) < 0.02
        progress_m, final = horizon.progress_m, horizon.final
    assert final
