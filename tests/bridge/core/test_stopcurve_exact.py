"""Hold the planned stop to numbers worked out by hand, on wheels that do not do the same."""

from __future__ import annotations

from math import nan, sqrt

import pytest

from bridge.core.modes import stop_profile
from bridge.core.modes.stop_profile import plan_stop, planned_rim_mps, planned_twist, too_slow
from bridge.core.motion.limiter import stopping_m
from bridge.core.state_motion import NO_STOP, LimiterState, Profile, StopPlan
from tests.bridge.core.table import table
from wire import STILL, RobotDescription, Twist2

ROBOT = RobotDescription.model_validate(
    {
        "base": {"wheel_separation_m": 0.8, "radius_m": 0.5},
        "limits": {"max_decel_mps2": 0.8, "stop_jerk_mps3": 5.0, "hardest_decel_mps2": 2.0},
    }
)
BASE, LIMITS = ROBOT.base, ROBOT.limits


def plan(sent: Twist2, left: float = 0.0, right: float = 0.0) -> StopPlan:
    return plan_stop(LimiterState(sent, left, right), BASE, LIMITS, Profile.STOP)


@table(
    ("sent", "left", "right", "under_way"),
    [
        # rims at 0.1 and 0.5 m/s
        (Twist2(0.3, 0.5), -0.2, -0.4, 0.4),
        (Twist2(0.3, 0.5), -0.4, -0.2, 0.4),
        (Twist2(0.3, 0.5), 0.4, 0.2, 0.0),
        (Twist2(0.3, 0.5), 0.4, -0.1, 0.1),
        (Twist2(-0.3, 0.5), 0.4, 0.2, 0.4),
        (Twist2(-0.3, 0.5), -0.4, 0.2, 0.2),
        (Twist2(-0.3, 0.5), -0.4, -0.2, 0.0),
        # turning in place: the left wheel goes back
        (Twist2(0.0, 0.5), 0.3, -0.1, 0.3),
        (Twist2(0.0, 0.5), -0.3, 0.1, 0.0),
        # a wheel that stands does not brake
        (Twist2(0.2, 0.5), -0.3, -0.1, 0.1),
        (Twist2(0.2, 0.5), 0.3, -0.1, 0.1),
        (Twist2(0.2, -0.5), -0.1, 0.3, 0.1),
        # nearly standing: only with its true half width does the left wheel go back
        (Twist2(0.15, 0.5), 0.3, 0.0, 0.3),
    ],
)
def test_what_brakes_already_counts(
    sent: Twist2, left: float, right: float, under_way: float
) -> None:
    assert stop_profile._braking(LimiterState(sent, left, right), BASE) == pytest.approx(under_way)
    assert plan(sent, left, right).first_mps2 == pytest.approx(under_way)


def test_a_wheel_that_stands_brakes_nothing() -> None:
    assert stop_profile._against(0.0, 1.0) == stop_profile._against(0.0, -1.0) == 0.0
    assert (stop_profile._against(0.5, -1.0), stop_profile._against(-0.5, -1.0)) == (1.0, -1.0)


def test_a_long_stop_rises_stays_and_fades() -> None:
    # 0.5 m/s at the rim: both ramps take 0.16 s and 0.064 m/s; 0.372 m/s are left for 0.8 m/s2
    made = plan(Twist2(0.3, 0.5))
    assert (made.rim_mps, made.first_mps2, made.peak_mps2) == pytest.approx((0.5, 0.0, 0.8))
    assert (made.rise_s, made.flat_s, made.fall_s) == pytest.approx((0.16, 0.372 / 0.8, 0.16))
    assert made.duration_s == pytest.approx(0.32 + 0.465)
    for at_s, rim_mps in (
        (-1.0, 0.5), (0.0, 0.5), (0.08, 0.5 - 0.4 * 0.04), (0.16, 0.436), (0.36, 0.276),
        (0.625, 0.064), (0.705, 0.8 * 0.08**2 / 0.32), (0.785, 0.0), (0.9, 0.0),
    ):  # fmt: skip
        assert planned_rim_mps(made, at_s) == pytest.approx(rim_mps), at_s
        half = planned_twist(made, at_s)
        assert (half.v_mps, half.w_radps) == pytest.approx((0.6 * rim_mps, rim_mps))


def test_a_stop_that_brakes_already_rises_less() -> None:
    made = plan(Twist2(0.3, 0.5), -0.4, -0.4)
    # ramps take (2 x 0.64 - 0.16) / 10 of the 0.5 m/s
    assert (made.first_mps2, made.rise_s) == pytest.approx((0.4, 0.08))
    assert made.flat_s == pytest.approx((0.5 - 0.112) / 0.8)
    assert planned_rim_mps(made, 0.04) == pytest.approx(0.5 - (0.4 + 5.0 * 0.02) * 0.04)
    hard = plan(Twist2(0.3, 0.5), -3.0, -3.0)
    assert (hard.first_mps2, hard.peak_mps2, hard.rise_s) == pytest.approx((0.8, 0.8, 0.0))


def test_a_short_stop_never_brakes_fully() -> None:
    # 0.05 m/s: the peak is sqrt(5 x 0.05), and nothing is flat
    made = plan(Twist2(0.05, 0.0))
    assert (made.peak_mps2, made.flat_s) == pytest.approx((0.5, 0.0), abs=1e-12)
    assert (made.rise_s, made.fall_s) == pytest.approx((0.1, 0.1))
    # braking by 0.3 m/s2 already: the peak is sqrt(0.25 + 0.045)
    braking = plan(Twist2(0.05, 0.0), -0.3, -0.3)
    assert braking.peak_mps2 == pytest.approx(sqrt(0.295))
    # no more than can fade in what is left: sqrt(2 x 5 x 0.01)
    fading = plan(Twist2(0.01, 0.0), -0.7, -0.7)
    assert fading.first_mps2 == pytest.approx(sqrt(0.1))


def test_the_hardest_stop_is_a_straight_line() -> None:
    made = plan_stop(LimiterState(Twist2(0.3, 0.5)), BASE, LIMITS, Profile.FASTEST)
    assert made == StopPlan(Twist2(0.3, 0.5), 0.5, 2.0, 2.0, 0.0, 0.25, 0.0)
    for at_s, rim_mps in ((0.0, 0.5), (0.1, 0.3), (0.2, 0.1), (0.25, 0.0)):
        assert planned_rim_mps(made, at_s) == pytest.approx(rim_mps)


def test_what_stands_or_is_no_speed_has_no_stop() -> None:
    assert plan(STILL) == NO_STOP
    assert plan(Twist2(1e3, 0.0)) != NO_STOP
    assert plan(Twist2(1.0001e3, 0.0)) == NO_STOP
    assert planned_twist(NO_STOP, -1.0) == STILL
    assert planned_twist(NO_STOP, 0.5) == STILL


@table(
    ("measured", "elapsed_s", "slow"),
    [
        (0.6, 0.26, False),  # lag and grace are not over
        (0.7, 0.27, True),
        (0.1 + 0.4359, 0.42, False),  # 0.26 s late the plan is at 0.436 m/s, and 0.1 more is slack
        (0.1 + 0.4361, 0.42, True),
        (0.0999, 9.0, False),
        (0.1001, 9.0, True),
        (nan, 0.42, True),
        (nan, 0.2, False),
    ],
)
def test_too_slow_is_beyond_the_late_plan_and_its_slack(
    measured: float, elapsed_s: float, slow: bool
) -> None:
    assert too_slow(plan(Twist2(0.5, 0.0)), Twist2(measured, 0.0), elapsed_s, 0.06, BASE) is slow
    assert too_slow(plan(Twist2(0.5, 0.0)), Twist2(0.0, measured / 0.4), elapsed_s, 0.06, BASE) is (
        slow
    )


def test_the_path_of_a_stop_by_numbers() -> None:
    # 0.5 m/s at the rim: 0.25 / 1.6 and 0.5 (0.6^2 / 8 + 0.01) and 0.512 / 600; the body's 0.6
    need_m = 0.15625 + 0.5 * (0.045 + 0.01) + 0.512 / 600
    assert stopping_m(Twist2(0.3, 0.5), 0.2, BASE, LIMITS, 0.01) == pytest.approx(0.6 * need_m)
    assert stopping_m(Twist2(-0.5, 0.0), 0.9, BASE, LIMITS, 0.01) == pytest.approx(
        0.15625 + 0.005 + 0.512 / 600
    )
    assert stopping_m(STILL, 0.0, BASE, LIMITS, 0.01) == 0.0
