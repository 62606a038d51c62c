"""What stands in the way is found beside walls, measured, and seen to be gone."""

from __future__ import annotations

import itertools
from math import atan2, cos, hypot, inf, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.navigation.obstruction import (
    AHEAD_M,
    EXPLAINED_M,
    NARROW_SPARE_M,
    Obstruction,
    find_narrow,
    find_obstruction,
    is_seen_open,
    points_of,
)
from tests.planner.navigation.floors import drawn
from wire import Pose2, Scan
from wire.lidar_config import LidarConfig

RADIUS_M = 0.3
HALL = drawn(*("." * 24 for _ in range(8)), "#" * 24)
"""6 m wide, with a wall along y from 0 to 0.25 m."""
PATH = [(1.0 + 0.1 * i, 1.0) for i in range(40)]
ROBOT = (1.0, 1.0)


def front(x_m: float, y_m: float, width_m: float) -> list[tuple[float, float]]:
    """Return the returns of a flat thing that faces the robot."""
    return [(x_m, y_m - width_m / 2 + 0.02 * i) for i in range(round(width_m / 0.02) + 1)]


def find(points: list[tuple[float, float]]) -> Obstruction | None:
    return find_obstruction(points, PATH, ROBOT, RADIUS_M, HALL.grid)


@given(st.floats(0.4, AHEAD_M - 0.1), st.floats(-0.25, 0.25), st.floats(0.1, 0.8))
def test_a_thing_on_the_path_is_found_where_and_as_wide_as_it_is(
    ahead_m: float, aside_m: float, width_m: float
) -> None:
    found = find(front(ROBOT[0] + ahead_m, 1.0 + aside_m, width_m))
    assert found is not None
    assert found.width_m == pytest.approx(width_m, abs=0.03)
    assert found.middle == pytest.approx((ROBOT[0] + ahead_m, 1.0 + aside_m), abs=0.03)


@pytest.mark.parametrize(
    "points",
    [
        pytest.param([], id="nothing"),
        pytest.param(front(1.0 + AHEAD_M + 0.6, 1.0, 0.5), id="too far along the path"),
        pytest.param(front(1.8, 1.0 + 0.45 + 0.3, 0.4), id="beside the path"),
        pytest.param(front(0.4, 1.0, 0.4), id="behind"),
        pytest.param([(1.5, 0.25 + EXPLAINED_M / 2)], id="a wall of the map"),
    ],
)
def test_what_does_not_stand_in_the_way_is_not_found(points: list[tuple[float, float]]) -> None:
    assert find(points) is None


def test_of_two_things_the_nearer_is_meant_and_they_stay_two() -> None:
    found = find([*front(1.6, 1.0, 0.4), *front(2.2, 1.0, 0.8)])
    assert found is not None
    assert found.middle[0] == pytest.approx(1.6)
    assert found.width_m == pytest.approx(0.4, abs=0.03)


def disc(radius_m: float, away_m: float, noise_m: float = 0.02) -> list[tuple[float, float]]:
    """Return the returns of a round thing whose near side is so far ahead, a degree apart."""
    centre_m, points = away_m + radius_m, []
    for degree in range(-180, 180):
        towards = degree * pi / 180
        half = radius_m**2 - (centre_m * sin(towards)) ** 2
        if cos(towards) > 0.0 and half >= 0.0:
            range_m = centre_m * cos(towards) - half**0.5 + noise_m * (-1) ** degree
            points.append((ROBOT[0] + range_m * cos(towards), ROBOT[1] + range_m * sin(towards)))
    return points


def corner(leg_m: float, x_m: float = 1.4) -> list[tuple[float, float]]:
    """Return the returns of a box that turns an edge to the robot."""
    steps = [leg_m * i / 20 for i in range(-20, 21)]
    return [(x_m + abs(step), 1.0 + step) for step in steps]


@pytest.mark.parametrize("away_m", [0.36, 0.5, 0.9])
def test_what_is_as_round_and_wide_as_the_robot_is_told(away_m: float) -> None:
    found = find(disc(RADIUS_M, away_m))
    assert found is not None
    assert found.is_round


@pytest.mark.parametrize(
    "points",
    [
        pytest.param(front(1.36, 1.0, 0.5), id="a box's face"),
        pytest.param(corner(0.28), id="a box's edge"),
        pytest.param(disc(0.15, 0.36), id="a bin"),
        pytest.param(disc(0.6, 0.36), id="a round table"),
        pytest.param([*disc(0.05, 0.36), *front(1.5, 1.2, 0.1)], id="two legs"),
        pytest.param([*disc(RADIUS_M, 0.36), *front(1.5, 1.4, 0.4)], id="beside a box"),
    ],
)
def test_what_has_another_shape_is_a_thing(points: list[tuple[float, float]]) -> None:
    found = find(points)
    assert found is not None
    assert not found.is_round


def test_without_a_path_only_what_touches_the_robot_could_be_meant() -> None:
    assert find_obstruction(front(1.6, 1.0, 0.4), [], ROBOT, RADIUS_M, HALL.grid) is None


@given(st.tuples(st.floats(-9, 9), st.floats(-9, 9)), st.tuples(st.floats(-9, 9), st.floats(-9, 9)))
def test_the_points_of_an_obstruction_leave_no_gap(
    start: tuple[float, float], end: tuple[float, float]
) -> None:
    points = points_of(Obstruction(start, end))
    assert points[0] == pytest.approx(start)
    assert points[-1] == pytest.approx(end)
    gaps = [hypot(b[0] - a[0], b[1] - a[1]) for a, b in itertools.pairwise(points)]
    assert max(gaps) <= 0.0501


DOOR = Obstruction((2.0, 0.5), (2.0, 1.5))
LIDAR = LidarConfig()


def scan_of(
    wall_x_m: float | None, here: Pose2, *, between: tuple[float, float] = (-inf, inf)
) -> Scan:
    """Return a scan of a wall across x, seen only where it crosses ``between`` in y; else 6 m."""
    ranges: list[float | None] = []
    for index in range(360):
        angle = here.yaw_rad - pi + index * pi / 180
        run_m = (wall_x_m - here.x_m) / cos(angle) if wall_x_m and cos(angle) > 0.01 else inf
        y_m = here.y_m + run_m * sin(angle) if run_m < inf else inf
        ranges.append(run_m if 0 < run_m < 6 and between[0] <= y_m <= between[1] else 6.0)
    return Scan(
        boot_id="l1", seq=1, stamp_s=1.0, angle_min_rad=-pi, angle_increment_rad=pi / 180,
        range_min_m=0.1, range_max_m=8.0, ranges_m=tuple(ranges),
    )  # fmt: skip


@pytest.mark.parametrize("yaw_rad", [0.0, 1.0, -3.0])
def test_a_place_is_open_once_the_beams_pass_it(yaw_rad: float) -> None:
    here = Pose2(1.0 - LIDAR.x_m * cos(yaw_rad), 1.0 - LIDAR.x_m * sin(yaw_rad), yaw_rad)
    lidar_at = Pose2(1.0, 1.0, yaw_rad + LIDAR.yaw_rad)
    assert is_seen_open(DOOR, scan_of(None, lidar_at), LIDAR, here)
    assert not is_seen_open(DOOR, scan_of(2.0, lidar_at), LIDAR, here)
    half = scan_of(2.0, lidar_at, between=(1.0, 9.0))
    assert not is_seen_open(DOOR, half, LIDAR, here), "half a door is no door"
    nearer = scan_of(1.5, lidar_at)
    assert not is_seen_open(DOOR, nearer, LIDAR, here), "something hides it"


def test_beams_without_a_return_and_places_far_away_say_nothing() -> None:
    here = Pose2(1.0, 1.0, 0.0)
    silent = scan_of(None, here).model_copy(update={"ranges_m": (None,) * 360})
    assert not is_seen_open(DOOR, silent, LIDAR, here)
    far = Pose2(-2.6, 1.0, 0.0)
    assert atan2(0.0, DOOR.middle[0] - far.x_m) == 0.0
    assert not is_seen_open(DOOR, scan_of(None, far), LIDAR, far)


@given(st.integers(5, 24))
def test_a_gap_of_the_map_is_narrow_where_it_leaves_less_than_margin_and_error(cells: int) -> None:
    # Pillars of four cells of 0.05 m on both sides of the path, 0.3 m ahead.
    aside = (40 - cells) // 2
    pillars, floor = "." * 12 + "####" + "." * 24, "." * 40
    rows = [floor if aside <= row < aside + cells else pillars for row in range(40)]
    grid = drawn(*rows, square_m=0.05).grid
    y_m = (40 - aside - cells / 2) * 0.05
    path = [(0.325 + 0.1 * i, y_m) for i in range(15)]
    found = find_narrow(path, path[0], RADIUS_M, grid)
    spare_m = cells * 0.05 - 2 * (RADIUS_M + 0.05 + NARROW_SPARE_M)
    if spare_m > 0.05:
        assert found is None
    if spare_m < -0.05:
        assert found is not None
        assert found.gap
        assert found.width_m == pytest.approx(cells * 0.05, abs=0.06)
        assert found.middle[1] == pytest.approx(y_m, abs=0.05)


def test_no_gap_is_narrow_beyond_the_next_steps_or_beside_one_wall() -> None:
    assert find_narrow(PATH, ROBOT, RADIUS_M, HALL.grid) is None
    far = drawn(
        *(("." * 24 + "####" + "." * 12) for _ in range(20)), *("." * 40 for _ in range(10))
    )
    assert find_narrow([(0.5 + 0.1 * i, 0.5) for i in range(40)], (0.5, 0.5), 0.3, far.grid) is None
    assert find_narrow([], ROBOT, RADIUS_M, HALL.grid) is None
