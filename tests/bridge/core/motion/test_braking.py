"""Hold the path and the speed of a stop to numbers worked out by hand."""

from __future__ import annotations

from math import nan, sqrt

import pytest

from bridge.core.geometry.stopping import speed_before, speed_within, stop_length_m
from bridge.core.motion.braking import speed_scale
from bridge.core.motion.free_distance import FreeLength
from tests.bridge.core.table import table
from wire import STILL, RobotDescription, Twist2

EPS = 1e-9


def robot_of(**parts: dict[str, float]) -> RobotDescription:
    return RobotDescription.model_validate(parts)


ROBOT = robot_of(limits={"max_decel_mps2": 0.8, "stop_jerk_mps3": 5.0})
"""Brakes at 0.8 m/s2 and takes 0.08 s of mean delay to build that up; 0.06 s late; 0.5 m wide."""


BASE, LIMITS = ROBOT.base, ROBOT.limits


def free(s_m: float, *, touching: bool = False, known: bool = True) -> FreeLength:
    return FreeLength(s_m, known, True, touching)


def within(s_m: float, decel: float, late_s: float) -> float:
    """Return the speed of which s = v t + v^2 / 2a, by the school's formula."""
    return decel * (sqrt(late_s * late_s + 2 * s_m / decel) - late_s)


@table(
    ("s_m", "decel", "late_s", "speed"),
    [
        (0.5, 0.8, 0.3, within(0.5, 0.8, 0.3)),
        (0.5, 0.8, 0.0, sqrt(0.8)),
        (0.5, 2.0, 0.1, within(0.5, 2.0, 0.1)),
        (0.0, 0.8, 0.0, 0.0),
        (-1.0, 0.8, 0.3, 0.0),
        (0.5, 0.0, 0.3, 0.0),
        (0.5, -1.0, 0.3, 0.0),
        (0.5, 0.8, -EPS, 0.0),
        (nan, 0.8, 0.3, 0.0),
        (0.5, nan, 0.3, 0.0),
        (0.5, 0.8, nan, 0.0),
    ],
)
def test_the_speed_that_stops_within_a_length(
    s_m: float, decel: float, late_s: float, speed: float
) -> None:
    assert speed_within(s_m, decel, late_s) == pytest.approx(speed)


@table(
    ("way", "twist", "scale"),
    [
        (free(9.0), Twist2(0.5, 0.2), 1.0),
        (free(0.2), Twist2(0.5, 0.0), within(0.2, 0.8, 0.3) / 0.5),
        (free(0.2), Twist2(-0.5, 0.0), within(0.2, 0.8, 0.3) / 0.5),
        (free(0.2), Twist2(0.5, 0.5), within(0.2, 0.64, 0.3) / 0.5),
        (free(0.0062), Twist2(0.5, 0.0), 0.0),  # 0.0199 m/s would be standing
        (free(0.0063), Twist2(0.5, 0.0), within(0.0063, 0.8, 0.3) / 0.5),
        (free(0.005), Twist2(0.01, 0.0), 1.0),
        (free(0.0), Twist2(0.5, 0.0), 0.0),
        (free(9.0, touching=True), Twist2(0.5, 0.0), 0.2),
        (free(9.0, touching=True), Twist2(-0.5, 0.0), 0.2),
        (free(9.0, touching=True), Twist2(0.2, 1.0), 0.3),
        (free(9.0, touching=True), Twist2(0.05, -1.0), 0.3),
        (free(9.0, touching=True), Twist2(0.05, 0.1), 1.0),
        (free(0.01, touching=True), Twist2(0.5, 0.0), within(0.01, 0.8, 0.3) / 0.5),
        (free(0.001, touching=True), Twist2(0.5, 0.0), within(0.001, 0.8, 0.3) / 0.5),
        (free(0.0), Twist2(0.99e-4, 1.0), 1.0),
        (free(0.0), Twist2(1e-4, 1.0), 0.0),
        (free(0.0, touching=True), Twist2(0.0, 1.0), 0.3),
        (free(0.0, touching=True), Twist2(0.0, 0.2), 1.0),
        (free(0.5), Twist2(nan, 0.0), 0.0),
    ],
)
def test_what_a_free_length_lets_pass(way: FreeLength, twist: Twist2, scale: float) -> None:
    assert speed_scale(way.s_m, twist, BASE, LIMITS, 0.3, touching=way.touching) == pytest.approx(
        scale
    )
    if 0.0 < scale < 1.0 and not way.touching:
        weak = within(way.s_m, 0.4 * 0.5 / (0.5 + abs(twist.w_radps) / 4), 0.3) / 0.5
        assert speed_scale(
            way.s_m, twist, BASE, LIMITS, 0.3, 0.5, touching=way.touching
        ) == pytest.approx(weak if weak * 0.5 >= 0.02 else 0.0)


@table(
    ("twist", "share", "length_m"),
    [
        (Twist2(0.4, 0.0), 1.0, 0.4 * 0.3 + 0.16 / 1.6),
        (Twist2(-0.4, 0.0), 0.5, 0.4 * 0.3 + 0.16 / 0.8),
        (Twist2(0.4, -0.8), 1.0, 0.4 * 0.3 + 0.16 * 3 / 3.2),
        (STILL, 1.0, 0.0),
        (Twist2(0.0, 1.0), 1.0, 0.0),
    ],
)
def test_the_path_until_standstill(twist: Twist2, share: float, length_m: float) -> None:
    assert stop_length_m(twist, BASE, LIMITS, 0.3, share) == pytest.approx(length_m)


@pytest.mark.parametrize("gap_m", [0.01, 0.1, 0.5])
@pytest.mark.parametrize(("decel", "late_s"), [(1.0, 0.0), (0.5, 0.2)])
def test_a_speed_before_a_slow_area_is_down_to_its_speed_at_the_edge(
    gap_m: float, decel: float, late_s: float
) -> None:
    slow = 0.2
    speed = speed_before(gap_m, slow, decel, late_s)
    assert speed >= slow
    needed_m = speed * late_s + (speed * speed - slow * slow) / (2 * decel)
    assert speed == slow or needed_m == pytest.approx(gap_m)


@pytest.mark.parametrize("gap_m", [0.0, -1.0, float("nan")])
def test_inside_a_slow_area_its_speed_is_the_bound(gap_m: float) -> None:
    assert speed_before(gap_m, 0.2, 1.0, 0.1) == 0.2
