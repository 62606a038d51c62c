"""Hold the judging of a horizon: shape, speeds, headings and the fence along it."""

from __future__ import annotations

from itertools import accumulate, pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.authority.leg_tracking import check_horizon
from bridge.core.geometry.fence import build_fence
from tests.bridge.core.table import table
from wire import Pose2, Waypoint

FENCE = build_fence(
    "0" * 16, (((-9, -9), (9, -9), (9, 9), (-9, 9)),), (((5, -1), (6, -1), (6, 1), (5, 1)),)
)
HERE = Pose2(0.0, 0.0, 0.0)


def line(*xs: float, speed: float = 0.3) -> list[Waypoint]:
    return [Waypoint(x_m=x, y_m=0.0, speed_mps=speed) for x in xs]


def judged(points: list[Waypoint], robot: Pose2 = HERE) -> tuple[str, ...]:
    return check_horizon(points, robot, 0.5, FENCE)


def test_no_points_are_in_order() -> None:
    assert judged([]) == ()
    assert check_horizon([], HERE, 0.5, None) == ()


@pytest.mark.parametrize(
    ("xs", "code"),
    [
        ((0.0, 0.0), "bad_spacing"),
        ((0.51, 0.6), "first_point_far"),
        (tuple(0.05 * i for i in range(51)), "too_many_points"),
    ],
)
def test_shape_is_refused_by_name(xs: tuple[float, ...], code: str) -> None:
    assert judged(line(*xs)) == (code,)


def test_a_horizon_of_fifty_points_that_begins_half_a_metre_off_passes() -> None:
    assert judged(line(*(0.5 + 0.05 * i for i in range(50)))) == ()


def test_standing_points_have_no_direction() -> None:
    assert judged(line(0.0, 0.1, speed=0.0)) == ("mixed_direction", "bad_speed")


def test_both_directions_in_one_horizon_are_refused() -> None:
    assert judged(line(0.0, speed=0.2) + line(0.1, speed=-0.2)) == ("mixed_direction",)


def test_only_the_last_point_has_a_heading() -> None:
    turned = Waypoint(x_m=0.1, y_m=0.0, speed_mps=0.2, heading_rad=1.0)
    assert judged([*line(0.0), turned]) == ()
    assert judged([turned, *line(0.2)]) == ("heading_not_last",)
    assert judged([*line(0.0), turned, *line(0.2)]) == ("heading_not_last",)


def test_the_fence_is_tested_on_segments() -> None:
    near = Pose2(4.9, 0.99, 0.0)
    corner = [
        Waypoint(x_m=4.95, y_m=0.97, speed_mps=0.3),
        Waypoint(x_m=5.03, y_m=1.05, speed_mps=0.3),
    ]
    assert judged(corner, near) == ()
    cut = [
        Waypoint(x_m=4.97, y_m=0.95, speed_mps=0.3),
        Waypoint(x_m=5.07, y_m=1.02, speed_mps=0.3),
    ]
    assert judged(cut, near) == ("fence_crossed",)


@given(st.lists(st.tuples(st.floats(-0.2, 0.2), st.floats(-0.2, 0.2)), min_size=2, max_size=40))
def test_clearance_saves_tests_but_misses_nothing(steps: list[tuple[float, float]]) -> None:
    x, y, points = 4.6, 0.9, [Waypoint(x_m=4.6, y_m=0.9, speed_mps=0.3)]
    for dx, dy in steps:
        x, y = x + dx, y + dy
        points.append(Waypoint(x_m=x, y_m=y, speed_mps=0.3))
    crossed = any(FENCE.crosses(a.x_m, a.y_m, b.x_m, b.y_m) for a, b in pairwise(points))
    assert ("fence_crossed" in judged(points, Pose2(4.6, 0.9, 0.0))) is crossed


def test_a_segment_after_one_beside_the_fence_is_tested_too() -> None:
    """The clearance of a tested segment's start once let the next one into the keep-out."""
    points = [(4.6, 0.9), (4.7875, 1.05625), (4.975, 1.2125), (5.1, 1.025), (5.1, 0.9)]
    last_in = [Waypoint(x_m=x, y_m=y, speed_mps=0.3) for x, y in points]
    assert judged(last_in, Pose2(4.6, 0.9, 0.0)) == ("fence_crossed",)
    assert judged(last_in[:-1], Pose2(4.6, 0.9, 0.0)) == ()


def test_no_fence_refuses() -> None:
    assert check_horizon(line(0.0, 0.1), HERE, 0.5, None) == ("fence_crossed",)


def test_all_reasons_are_named_at_once() -> None:
    points = [*line(3.0, speed=-0.9), *line(3.9)]
    assert judged(points) == ("first_point_far", "bad_spacing", "mixed_direction", "bad_speed")


any_point = st.builds(
    Waypoint.model_construct,
    x_m=st.floats(),
    y_m=st.floats(),
    speed_mps=st.floats(),
    heading_rad=st.none() | st.floats(),
)


@given(st.lists(any_point, max_size=4), st.floats(), st.floats())
def test_no_float_raises_and_nan_is_refused(points: list[Waypoint], x: float, most: float) -> None:
    codes = check_horizon(points, Pose2(x, 0.0, 0.0), most, FENCE)
    odd = [p for p in points if p.x_m != p.x_m or p.y_m != p.y_m or p.speed_mps != p.speed_mps]
    assert codes or not odd


@table(
    ("gaps", "spaced"),
    [
        # a millimetre is what coordinates may be rounded by; less in the middle than at the ends
        ([0.1, 0.04905, 0.1], True), ([0.1, 0.04895, 0.1], False),
        ([0.1, 0.25095, 0.1], True), ([0.1, 0.25105, 0.1], False),
        ([0.00905, 0.1], True), ([0.00895, 0.1], False),
        ([0.1, 0.00905], True), ([0.1, 0.00895], False),
        ([0.25105, 0.1], False), ([0.1, 0.25105], False), ([0.25095], True),
    ],
)  # fmt: skip
def test_gaps_are_within_their_bounds_and_a_millimetre(gaps: list[float], spaced: bool) -> None:
    points = line(*accumulate(gaps, initial=0.0))
    assert judged(points) == (() if spaced else ("bad_spacing",))


@table(
    ("speed_mps", "fits"),
    [
        (0.05 - 1e-6, True),
        (0.5 + 1e-6, True),
        (0.05 - 1.05e-6, False),
        (0.5 + 1.05e-6, False),
    ],
)
def test_speeds_are_within_their_bounds_and_a_millionth(speed_mps: float, fits: bool) -> None:
    for speed in (speed_mps, -speed_mps):
        assert judged(line(0.0, 0.1, speed=speed)) == (() if fits else ("bad_speed",))


Point = tuple[float, float]


def is_inside(robot: Pose2, *points: Point) -> bool:
    made = [Waypoint(x_m=x, y_m=y, speed_mps=0.3) for x, y in points]
    return "fence_crossed" not in judged(made, robot)


@table(
    ("robot", "points", "inside"),
    [
        ((4.9, 0.5), [(5.05, 0.5)], False),  # its only point lies in the keep-out
        ((4.97, 0.9), [(5.1, 1.03)], False),  # the way to it cuts a corner
        ((4.97, 0.9), [(4.97, 1.03)], True),
        ((5.05, 0.0), [(4.95, 0.0)], True),  # a robot outside may come in
        ((5.05, 0.0), [(5.06, 0.0)], False),
        ((5.9, 0.0), [(6.1, 0.0)], True),
        ((-8.9, -8.9), [(-9.05, -8.9)], False),
        ((-8.9, -8.9), [(-8.8, -8.8)], True),
        # far from all: the clearance of its place saves the tests, that of another would not
        ((-4.5, -0.5), [(-4.4, -0.5), (-4.3, -0.5)], True),
        ((4.3, -2.0), [(4.3, -1.6), (5.1, -0.8)], False),
        # its second segment crosses; one that ends elsewhere would not
        ((4.5, 1.5), [(4.5, 1.5), (4.4, 1.6), (6.5, 0.0)], False),
        ((4.5, 1.5), [(4.5, 1.5), (4.4, 1.6), (6.5, 1.5)], True),
        ((4.5, 1.5), [(4.5, 1.5), (4.4, 1.6), (4.5, 0.0)], True),
        ((4.5, 0.0), [(4.5, 0.0), (4.9, 0.0), (5.2, 0.0)], False),
        ((4.5, 0.0), [(4.5, 0.0), (4.9, 0.0), (4.9, 0.3), (4.9, 0.6), (5.1, 0.6)], False),
        ((4.0, 0.0), [(4.0, 0.0), (4.3, 0.0), (4.6, 0.0), (4.9, 0.0), (5.1, 0.0)], False),
    ],
)
def test_every_way_stays_inside(robot: Point, points: list[Point], inside: bool) -> None:
    assert is_inside(Pose2(*robot, 0.0), *points) is inside


def test_the_way_to_the_first_point_is_measured_from_the_robot() -> None:
    """What is clear around the robot, less the way, is clear around its first point."""
    for x, y in ((8.5, 3.0), (-8.5, 3.0), (3.0, 8.5), (3.0, -8.5)):
        robot = Pose2(x, y, 0.0)
        out_x, out_y = (x * 9.2 / 8.5, y) if abs(x) > 8 else (x, y * 9.2 / 8.5)
        assert not is_inside(robot, (out_x, out_y))
        in_x, in_y = (x * 8.9 / 8.5, y) if abs(x) > 8 else (x, y * 8.9 / 8.5)
        assert is_inside(robot, (in_x, in_y))
        assert not is_inside(robot, (in_x, in_y), (out_x, out_y))
