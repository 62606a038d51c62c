"""Wheels give the way, the gyro the turn once its bias is known, and gaps are no knowledge."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from localization.odometry_integration import KEPT, OdometryTrail
from tests.localization.rooms import odometry_of
from wire import IDENTITY, Pose2, Twist2


def standing(trail: OdometryTrail, gyro_radps: float, seconds: float = 2.0) -> float:
    stamps = np.arange(0.0, seconds, 0.02).tolist()
    for stamp_s in stamps:
        trail.add(odometry_of(stamp_s, IDENTITY, gyro_radps=gyro_radps))
    return float(stamps[-1])


def test_it_interpolates_the_short_way_and_knows_what_it_covers() -> None:
    trail = OdometryTrail()
    assert trail.newest is None
    assert not trail.covers(0.0, 0.0)
    trail.add(odometry_of(1.0, Pose2(0.0, 0.0, pi - 0.1)))
    trail.add(odometry_of(1.2, Pose2(0.2, 0.0, -pi + 0.1)))
    assert trail.at(1.1).x_m == pytest.approx(-0.1, abs=0.02), "in its own frame, first is zero"
    assert trail.at(1.1).yaw_rad == pytest.approx(0.1)
    assert trail.covers(1.0, 1.2)
    assert not trail.covers(0.9, 1.1)
    assert not trail.covers(1.1, 1.3)
    trail.clear()
    assert trail.newest is None


def test_what_does_not_rise_in_time_is_ignored_and_old_readings_go() -> None:
    trail = OdometryTrail()
    for count in range(KEPT + 10):
        trail.add(odometry_of(count * 0.02, Pose2(count * 0.01, 0.0, 0.0)))
    trail.add(odometry_of(0.0, Pose2(9.0, 9.0, 0.0)))
    assert trail.newest is not None
    assert trail.newest.travelled_m == pytest.approx((KEPT + 9) * 0.01)
    assert not trail.covers(0.1, 1.0)


def test_wheels_that_slip_in_a_turn_turn_nothing_once_the_bias_is_known() -> None:
    trail = OdometryTrail()
    end_s = standing(trail, 0.01)
    for step in range(1, 51):
        slipping = Pose2(0.0, 0.0, step * 0.02)
        trail.add(
            odometry_of(end_s + step * 0.02, slipping, twist=Twist2(0.0, 1.0), gyro_radps=0.01)
        )
    assert trail.newest is not None
    assert trail.newest.carried.yaw_rad == pytest.approx(0.0, abs=1e-3)
    assert trail.newest.slip_rad == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("gyro_radps", [None, 0.3])
def test_without_a_plausible_gyro_wheels_count(gyro_radps: float | None) -> None:
    trail = OdometryTrail()
    for step in range(100):
        trail.add(odometry_of(step * 0.02, IDENTITY, gyro_radps=gyro_radps))
    trail.add(odometry_of(2.0, Pose2(0.0, 0.0, 0.5), gyro_radps=gyro_radps))
    assert trail.newest is not None
    assert trail.newest.carried.yaw_rad == pytest.approx(0.5)


def test_counters_are_those_of_the_instant() -> None:
    trail = OdometryTrail()
    for step in range(5):
        trail.add(odometry_of(step * 0.02, Pose2(step * 0.1, 0.0, 0.0)))
    assert trail.counters_at(0.05) == pytest.approx((0.2, 0.0))
    assert trail.counters_at(-1.0) == (0.0, 0.0)
