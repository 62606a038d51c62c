"""Who comes along the way is met; who crosses, follows, stands, or walks elsewhere is not."""

from __future__ import annotations

from math import cos, sin

import pytest

from planner.navigation import Mover
from planner.navigation.oncoming import CLOSES_MPS, NEAR_M, find_oncoming, is_closing_in
from planner.navigation.route import WIDE_M

WAY = tuple((0.1 * i, 0.0) for i in range(51))


def mover(x_m: float, y_m: float, vx_mps: float, vy_mps: float = 0.0) -> Mover:
    return Mover(1, x_m, y_m, vx_mps, vy_mps, 0.25)


def test_somebody_who_comes_is_met_where_they_are_on_the_way() -> None:
    met = find_oncoming(WAY, [mover(3.0, 0.2, -0.8)])
    assert met is not None
    assert met.far_m == pytest.approx(3.0, abs=0.06)
    assert met.at_m == pytest.approx((3.0, 0.0), abs=0.06)


def test_the_nearest_of_several_is_told() -> None:
    met = find_oncoming(WAY, [mover(4.0, 0.0, -0.8), mover(2.0, 0.0, -0.8)])
    assert met is not None
    assert met.far_m == pytest.approx(2.0, abs=0.06)


@pytest.mark.parametrize(
    "other",
    [
        mover(3.0, 0.0, 0.8),  # goes the same way
        mover(3.0, 0.0, 0.0),  # stands
        mover(3.0, 0.5, -0.3, -0.9),  # crosses
        mover(3.0, 1.2, -0.8),  # walks in a lane of its own
        mover(0.5, 0.0, -0.8),  # is here already
        mover(7.0, 0.0, -0.8),  # is beyond the way that is looked at
        mover(float("nan"), 0.0, -0.8),
        mover(3.0, 0.0, float("nan")),
    ],
)
def test_nobody_else_is_met(other: Mover) -> None:
    assert find_oncoming(WAY, [other]) is None


@pytest.mark.parametrize("way", [(), ((0.0, 0.0),), ((0.0, 0.0), (0.0, 0.0))])
def test_on_a_way_without_length_nobody_comes(way: tuple[tuple[float, float], ...]) -> None:
    assert find_oncoming(way, [mover(1.0, 0.0, -0.8)]) is None


def robot(x_m: float, y_m: float, vx_mps: float, vy_mps: float) -> Mover:
    return Mover(1, x_m, y_m, vx_mps, vy_mps, WIDE_M + 0.02)


@pytest.mark.parametrize("from_rad", [0.0, 1.0, 2.5, -1.7])
def test_another_robot_closes_in_from_wherever_it_comes(from_rad: float) -> None:
    x_m, y_m = cos(from_rad), sin(from_rad)
    for share in (1.0, -1.0):
        vx_mps, vy_mps = -0.4 * x_m * share, -0.4 * y_m * share
        other = robot(2.0 + x_m, y_m - 3.0, vx_mps, vy_mps)
        assert is_closing_in((2.0, -3.0), [other]) is (share > 0.0)


@pytest.mark.parametrize(
    "other",
    [
        robot(NEAR_M + 0.01, 0.0, -0.4, 0.0),
        robot(1.0, 0.0, -CLOSES_MPS / 2, 0.4),  # passes by
        robot(1.0, 0.0, 0.0, 0.0),
        robot(float("nan"), 0.0, -0.4, 0.0),
        robot(1.0, 0.0, float("nan"), 0.0),
        Mover(1, 1.0, 0.0, -0.4, 0.0, WIDE_M),  # a person
    ],
)
def test_nobody_else_closes_in(other: Mover) -> None:
    assert not is_closing_in((0.0, 0.0), [other])
