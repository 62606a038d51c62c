"""Who comes along the way is met; who crosses, follows, stands, or walks elsewhere is not."""

from __future__ import annotations

from math import cos, sin

import pytest

from planner.navigation import Mover
from planner.navigation.oncoming import AHEAD_S, CLEAR_M, find_oncoming, is_closing_in
from planner.navigation.route import WIDE_M

RADIUS_M = WIDE_M + 0.02
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
    return Mover(1, x_m, y_m, vx_mps, vy_mps, RADIUS_M)


@pytest.mark.parametrize("from_rad", [0.0, 1.0, 2.5, -1.7])
def test_two_that_drive_towards_each_other_close_in_until_they_have_met(from_rad: float) -> None:
    x_m, y_m = cos(from_rad), sin(from_rad)
    for share in (1.0, -1.0):
        other = robot(2.0 + x_m, y_m - 3.0, -0.4 * x_m * share, -0.4 * y_m * share)
        own = (0.4 * x_m * share, 0.4 * y_m * share)
        assert is_closing_in((2.0, -3.0), own, 0.3, [other]) is (share > 0.0)
        assert is_closing_in((2.0, -3.0), (0.0, 0.0), 0.3, [other]) is (share > 0.0)


@pytest.mark.parametrize("late_s", [0.0, 3.0])
def test_who_crosses_closes_in_where_both_come_to_the_crossing_at_once(late_s: float) -> None:
    other = robot(0.4, -0.6 - 0.4 * late_s, 0.0, 0.4)
    assert is_closing_in((0.0, 0.0), (0.4, 0.0), 0.3, [other]) is (late_s == 0.0)


@pytest.mark.parametrize(
    "other",
    [
        robot(0.3 + RADIUS_M + CLEAR_M + 0.9 * AHEAD_S, 0.0, -0.4, 0.0),  # too far, as yet
        robot(1.0, 0.0, 0.5, 0.0),  # drives before it, and faster
        robot(0.3 + RADIUS_M + CLEAR_M + 0.1, 0.0, 0.5, 0.3),
        robot(1.0, 0.0, 0.4, 0.0),  # as fast: it never comes nearer
        robot(float("nan"), 0.0, -0.4, 0.0),
        robot(1.0, 0.0, float("nan"), 0.0),
        Mover(1, 1.0, 0.0, -0.4, 0.0, WIDE_M),  # a person
    ],
)
def test_nobody_else_closes_in(other: Mover) -> None:
    assert not is_closing_in((0.0, 0.0), (0.4, 0.0), 0.3, [other])
