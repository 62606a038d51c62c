"""Hold every horizon to the bridge's rules, under pose noise and on paths that cross themselves."""

from __future__ import annotations

import random
from itertools import pairwise
from math import cos, hypot, inf, nan, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.navigation import Horizon, LegPath, RoutePoint, cut
from planner.navigation.horizon import OFF_PATH_M, WINDOW_M
from wire import MAX_POINTS, Pose2

STOP_M = 0.5 * 0.5 / (2 * 1.0) + 0.3 * 0.5  # from 0.5 m/s at 1 m/s2, after 0.3 s


def leg(*xy_m: tuple[float, float], speed_mps: float = 0.5) -> LegPath:
    return LegPath.of([RoutePoint(x, y, speed_mps) for x, y in xy_m])


def straight(length_m: float, gap_m: float = 0.1) -> LegPath:
    count = round(length_m / gap_m)
    return leg(*((length_m * i / count, 0.0) for i in range(count + 1)))


def eight() -> LegPath:
    """Return a figure eight that crosses itself at right angles in the origin."""
    turns = [2 * pi * i / 200 for i in range(201)]
    return leg(*((1.5 * sin(t), 1.5 * sin(t) * cos(t)) for t in turns))


@st.composite
def paths(draw: st.DrawFn) -> LegPath:
    """Wander: gaps of 0.05 to 0.2 m and bends of up to 40 degrees, ends as short as 0.01 m."""
    x_m = y_m = heading = 0.0
    points = [RoutePoint(0.0, 0.0, 0.3)]
    count = draw(st.integers(0, 80))
    for index in range(count):
        at_end = index in (0, count - 1)
        gap_m = draw(st.floats(0.0125 if at_end else 0.0525, 0.2))
        heading += draw(st.floats(-0.7, 0.7))
        x_m, y_m = x_m + gap_m * cos(heading), y_m + gap_m * sin(heading)
        points.append(RoutePoint(x_m, y_m, draw(st.floats(0.05, 0.5))))
    return LegPath.of(points, draw(st.none() | st.floats(-3, 3)))


def check_message(path: LegPath, horizon: Horizon, robot: Pose2) -> None:
    points = horizon.points
    assert 1 <= len(points) <= MAX_POINTS
    assert hypot(points[0].x_m - robot.x_m, points[0].y_m - robot.y_m) <= OFF_PATH_M + 0.011
    gaps = [hypot(b.x_m - a.x_m, b.y_m - a.y_m) for a, b in pairwise(points)]
    assert all(0.05 <= gap <= 0.25 for gap in gaps[1:-1])
    assert all(0.01 - 1e-9 <= gap <= 0.25 for gap in gaps)
    assert all(0.05 <= p.speed_mps <= 0.5 for p in points)
    assert all(p.heading_rad is None for p in points[:-1])
    last = path.points[-1]
    ends = (points[-1].x_m, points[-1].y_m) == (last.x_m, last.y_m)
    assert horizon.final is ends
    assert points[-1].heading_rad == (path.heading_rad if ends else None)
    if not horizon.final:
        assert sum(gaps) >= min(1.5, 49 * 0.05) - 0.011


@given(paths(), st.floats(0, 1), st.integers(0, 2**31))
def test_a_noisy_drive_sends_only_lawful_horizons_and_its_progress_never_falls(
    path: LegPath, pace: float, seed: int
) -> None:
    noise = random.Random(seed)
    progress_m = 0.0
    for point, along_m in list(zip(path.points, path.along_m, strict=True))[:: 1 + int(2 * pace)]:
        robot = Pose2(point.x_m + noise.gauss(0, 0.02), point.y_m + noise.gauss(0, 0.02), 0.0)
        horizon = cut(path, robot, progress_m)
        assert not horizon.off_path
        assert progress_m <= horizon.progress_m <= progress_m + WINDOW_M + 1e-9
        assert horizon.progress_m <= along_m + 0.5
        check_message(path, horizon, robot)
        progress_m = horizon.progress_m


@given(paths(), st.floats(-5, 20), st.floats(-5, 5), st.floats(-5, 5))
def test_any_pose_gives_a_lawful_horizon_or_none(
    path: LegPath, progress_m: float, x_m: float, y_m: float
) -> None:
    robot = Pose2(x_m, y_m, 0.0)
    horizon = cut(path, robot, progress_m)
    assert horizon.off_path is (horizon.away_m > OFF_PATH_M)
    if horizon.off_path:
        assert horizon.points == ()
        assert not horizon.final
    else:
        check_message(path, horizon, robot)


def test_the_first_point_is_the_projection() -> None:
    horizon = cut(straight(5.0), Pose2(0.333, 0.1, 0.0), 0.2)
    assert (horizon.points[0].x_m, horizon.points[0].y_m) == pytest.approx((0.333, 0.0))
    assert horizon.points[1].x_m == pytest.approx(0.4)
    assert horizon.progress_m == pytest.approx(0.333)
    assert horizon.away_m == pytest.approx(0.1)


@pytest.mark.parametrize("x_m", [0.395, 0.4, 0.3951])
def test_a_vertex_nearer_than_the_least_gap_takes_its_place(x_m: float) -> None:
    horizon = cut(straight(5.0), Pose2(x_m, 0.0, 0.0), 0.2)
    assert horizon.points[0].x_m == pytest.approx(0.4)
    assert horizon.points[1].x_m == pytest.approx(0.5)


def test_the_stopping_distance_is_inside_every_horizon_that_does_not_end_the_leg() -> None:
    path, progress_m = straight(10.0), 0.0
    while progress_m < 9.9:
        horizon = cut(path, Pose2(progress_m, 0.0, 0.0), progress_m)
        reach_m = horizon.points[-1].x_m - horizon.points[0].x_m
        assert horizon.final or reach_m >= 2 * STOP_M
        progress_m += 0.07


def test_fine_points_are_bounded_in_number() -> None:
    horizon = cut(straight(10.0, 0.05), Pose2(0.0, 0.0, 0.0), 0.0)
    assert len(horizon.points) <= MAX_POINTS
    assert not horizon.final


def test_a_path_that_crosses_itself_is_followed_in_order() -> None:
    path, progress_m, final = eight(), 0.0, False
    for along_m, point in zip(path.along_m, path.points, strict=True):
        horizon = cut(path, Pose2(point.x_m, point.y_m, 0.0), progress_m)
        progress_m, final = horizon.progress_m, horizon.final
        assert progress_m == pytest.approx(along_m, abs=0.02)
    assert final


def test_a_robot_carried_back_along_its_path_is_off_it() -> None:
    path = straight(5.0)
    back = cut(path, Pose2(1.0, 0.0, 0.0), 2.0)
    assert back.off_path
    assert back.progress_m == 2.0
    assert not cut(path, Pose2(1.8, 0.0, 0.0), 2.0).off_path


def test_a_robot_carried_far_ahead_is_off_its_path() -> None:
    assert cut(straight(5.0), Pose2(3.0, 0.0, 0.0), 1.0).off_path


@pytest.mark.parametrize(("away_m", "off"), [(0.29, False), (0.3, False), (0.301, True)])
def test_a_robot_beside_its_path(away_m: float, off: bool) -> None:
    assert cut(straight(5.0), Pose2(1.0, away_m, 0.0), 0.9).off_path is off


@pytest.mark.parametrize("bad", [nan, inf, -inf])
def test_a_pose_that_is_no_number_is_off_the_path(bad: float) -> None:
    assert cut(straight(5.0), Pose2(bad, 0.0, 0.0), 0.0).off_path
    assert cut(straight(5.0), Pose2(0.0, bad, 0.0), 0.0).off_path


def test_at_the_end_one_point_with_its_heading_is_left() -> None:
    path = LegPath.of(straight(2.0).points, heading_rad=1.25)
    horizon = cut(path, Pose2(2.03, 0.01, 0.0), 1.9)
    assert horizon.final
    assert len(horizon.points) == 1
    assert horizon.points[0].heading_rad == 1.25


def test_a_leg_of_one_point_is_its_own_end() -> None:
    path = LegPath.of([RoutePoint(1.0, 1.0, 0.2)], heading_rad=0.5)
    horizon = cut(path, Pose2(1.1, 1.0, 0.0), 0.0)
    assert horizon.final
    assert [(p.x_m, p.y_m, p.heading_rad) for p in horizon.points] == [(1.0, 1.0, 0.5)]


def test_a_leg_without_points_is_none() -> None:
    with pytest.raises(ValueError, match="at least one point"):
        LegPath.of([])
