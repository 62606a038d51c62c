"""Hold each reason to refuse a horizon, at its boundary."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.authority.horizon_checks import check_horizon
from bridge.core.geometry.fence import build_fence
from wire.commands import Waypoint
from wire.geometry import Pose2

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
    "xs",
    [
        (0.0,),
        (0.0, 0.01),
        (0.0, 0.25),
        (0.0, 0.01, 0.06, 0.07),
        (0.0, 0.05, 0.30, 0.31),
        (0.5, 0.6, 0.7),
        (0.1, 0.1 + 0.1, 0.1 + 0.1 + 0.1, 0.1 + 0.1 + 0.1 + 0.05),
    ],
)
def test_what_is_well_spaced_passes(xs: tuple[float, ...]) -> None:
    assert judged(line(*xs)) == ()


@pytest.mark.parametrize(
    ("xs", "code"),
    [
        ((0.0, 0.0), "bad_spacing"),
        ((0.0, 0.26), "bad_spacing"),
        ((0.0, 0.1, 0.14, 0.24), "bad_spacing"),
        ((0.0, 0.1, 0.4, 0.5), "bad_spacing"),
        ((0.51, 0.6), "first_point_far"),
        (tuple(0.05 * i for i in range(51)), "too_many_points"),
    ],
)
def test_shape_is_refused_by_name(xs: tuple[float, ...], code: str) -> None:
    assert judged(line(*xs)) == (code,)


@pytest.mark.parametrize("speed", [0.05, 0.5, 0.5 + 1e-9, 0.05 - 1e-9, -0.05, -0.5])
def test_speeds_at_the_bounds_pass(speed: float) -> None:
    assert judged(line(0.0, 0.1, speed=speed)) == ()


@pytest.mark.parametrize("speed", [0.04, 0.51, -0.04, -0.51])
def test_speeds_beyond_the_bounds_are_refused(speed: float) -> None:
    assert judged(line(0.0, 0.1, speed=speed)) == ("bad_speed",)


def test_standing_points_have_no_direction() -> None:
    assert judged(line(0.0, 0.1, speed=0.0)) == ("mixed_direction", "bad_speed")


def test_both_directions_in_one_horizon_are_refused() -> None:
    assert judged(line(0.0, speed=0.2) + line(0.1, speed=-0.2)) == ("mixed_direction",)


def test_only_the_last_point_has_a_heading() -> None:
    turned = Waypoint(x_m=0.1, y_m=0.0, speed_mps=0.2, heading_rad=1.0)
    assert judged([*line(0.0), turned]) == ()
    assert judged([turned, *line(0.2)]) == ("heading_not_last",)


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


def test_a_fence_far_along_is_seen() -> None:
    along = [i * 0.2 for i in range(30)]
    assert judged(line(*along)) == ("fence_crossed",)
    assert judged(line(*along[:25])) == ()
    beside = [Waypoint(x_m=x, y_m=1.01, speed_mps=0.3) for x in along]
    assert judged(beside, Pose2(0.0, 1.0, 0.0)) == ()


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


def test_a_robot_outside_may_come_back_in() -> None:
    inward = [
        Waypoint(x_m=4.95, y_m=0.0, speed_mps=0.3),
        Waypoint(x_m=4.85, y_m=0.0, speed_mps=0.3),
    ]
    assert judged(inward, Pose2(5.05, 0.0, 3.0)) == ()
    outward = line(5.06, 5.2)
    assert judged(outward, Pose2(5.05, 0.0, 3.0)) == ("fence_crossed",)


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
