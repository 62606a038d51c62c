"""Hold the limiter's arithmetic to numbers worked out by hand, where a law would let them waver."""

from __future__ import annotations

import pytest

from bridge.core.motion.limiter import shape, stopping_m, tick_length
from bridge.core.state_motion import LimiterState
from tests.bridge.core.table import table
from wire import RobotDescription, Twist2

ROBOT = RobotDescription()
BASE, LIMITS = ROBOT.base, ROBOT.limits
DT = 0.01


def shaped(target: Twist2, memory: LimiterState, dt_s: float = DT) -> LimiterState:
    return shape(target, memory, BASE, LIMITS, dt_s)


@table("sign", [1.0, -1.0])
def test_from_rest_either_way_the_gentle_jerk_counts(sign: float) -> None:
    after = shaped(Twist2(0.5 * sign, 0.0), LimiterState())
    assert after.sent.v_mps == pytest.approx(sign * 2.0 * DT * DT), "2 m/s3, not 10"


def test_what_is_remembered_is_change_by_time() -> None:
    after = shaped(Twist2(0.5, 0.0), LimiterState(Twist2(0.1, 0.0), 0.5, 0.5))
    assert after.sent.v_mps == pytest.approx(0.105)
    assert after.left_mps2 == pytest.approx(0.5)
    assert after.right_mps2 == pytest.approx(0.5)


def test_one_wheel_that_starts_makes_the_change_no_stop() -> None:
    # the left wheel slows from 0.4 to 0.2 m/s, the right one starts backwards: gentle for both
    memory = LimiterState(Twist2(0.2, -0.8))
    after = shaped(Twist2(-0.05, -1.0), memory)
    left = after.sent.v_mps - 0.25 * after.sent.w_radps
    assert 0.4 - left <= 2.0 * DT * DT + 1e-12, "2 m/s3, not 10"


@table(
    ("dt_s", "length_s"),
    [(0.004, 0.005), (0.005, 0.005), (0.0053, 0.0053), (0.02, 0.02), (0.021, 0.02), (0.027, 0.02),
     (float("nan"), 0.01), (-1.0, 0.005)],
)  # fmt: skip
def test_a_tick_is_held_between_half_a_period_and_two(dt_s: float, length_s: float) -> None:
    assert tick_length(dt_s, 0.01) == length_s


def test_a_reversal_within_a_tick_brakes_and_then_speeds_up_with_what_is_left() -> None:
    # 3 mm/s take 3 ms at 1 m/s2; the 7 ms left give 3.5 mm/s the other way at 0.5 m/s2
    memory = LimiterState(Twist2(0.003, 0.0), -9.0, -9.0)  # the jerk has nothing to say
    after = shaped(Twist2(-0.5, 0.0), memory)
    assert after.sent.v_mps == pytest.approx(-0.0035)


def test_acceleration_fades_as_the_square_root_of_twice_the_jerk_and_the_rest() -> None:
    # 1 mm/s left: sqrt(2 x 2 x 0.001) = 63 mm/s2
    memory = LimiterState(Twist2(0.299, 0.0), 0.5, 0.5)
    after = shaped(Twist2(0.3, 0.0), memory)
    assert after.sent.v_mps == pytest.approx(0.299 + 0.004**0.5 * DT)


def test_a_stop_under_way_needs_less_path_by_what_it_already_brakes() -> None:
    # 0.5^2 / 2 + 0.5 (missing^2 / 20 + 0.01) + 1 / 2400, missing of 1 m/s2
    fresh, braking = (stopping_m(Twist2(0.5, 0.0), had, BASE, LIMITS, DT) for had in (0.0, 0.6))
    assert fresh == pytest.approx(0.125 + 0.5 * (0.05 + 0.01) + 1 / 2400)
    assert braking == pytest.approx(0.125 + 0.5 * (0.16 / 20 + 0.01) + 1 / 2400)


@table("had", [-1.0, 1.0])
def test_what_a_wheel_that_stays_as_it_is_did_before_hurries_no_other(had: float) -> None:
    # the left wheel keeps 0.2 m/s though it was changing; the right one begins gently: 2 m/s3
    after = shaped(Twist2(0.25, 0.2), LimiterState(Twist2(0.2, 0.0), had, 0.0))
    right = after.sent.v_mps + 0.25 * after.sent.w_radps
    assert right - 0.2 == pytest.approx(2.0 * DT * DT)


def test_a_wheel_that_stays_lets_the_other_slow_quickly() -> None:
    # rims at 0.25 and 0.25 m/s, wanted 0.25 and 0.05: 10 m/s3, not 2
    after = shaped(Twist2(0.15, -0.4), LimiterState(Twist2(0.25, 0.0)))
    assert after.sent.v_mps + 0.25 * after.sent.w_radps == pytest.approx(0.25 - 10.0 * DT * DT)
    assert after.sent.v_mps - 0.25 * after.sent.w_radps == pytest.approx(0.25)


def test_the_jerk_counts_where_the_room_is_just_enough() -> None:
    last = Twist2(0.3, 0.0)
    needs_m = stopping_m(last, 0.0, BASE, LIMITS, DT)
    for room_m, slowed_mps in ((needs_m, 10.0 * DT * DT), (needs_m * 0.999, 1.0 * DT)):
        after = shape(Twist2(0.0, 0.0), LimiterState(last), BASE, LIMITS, DT, room_m=room_m)
        assert 0.3 - after.sent.v_mps == pytest.approx(slowed_mps)


@table(
    ("dt_s", "period_s", "length_s"),
    [(0.6, 1.0, 0.6), (1.05, 1.05, 0.02), (0.01, 0.0, 0.01), (0.3, -1.0, 0.02)],
)
def test_a_period_is_one_of_at_most_a_second(dt_s: float, period_s: float, length_s: float) -> None:
    assert tick_length(dt_s, period_s) == length_s


def test_a_tick_that_can_make_the_whole_change_makes_it_exactly() -> None:
    memory = LimiterState(Twist2(0.001, 0.0), -1.0, -1.0)
    after = shaped(Twist2(0.0, 0.0), memory)
    assert after.sent == Twist2(0.0, 0.0)
    assert (after.left_mps2, after.right_mps2) == pytest.approx((-0.1, -0.1))
    assert shaped(Twist2(0.001, 0.0), memory) == LimiterState(Twist2(0.001, 0.0))


def test_brakes_that_are_not_1_mps2_take_their_time_of_a_tick() -> None:
    # 3 mm/s take 5 ms at 0.6 m/s2; the 5 ms left give 2.5 mm/s the other way at 0.5 m/s2
    robot = RobotDescription.model_validate({"limits": {"max_decel_mps2": 0.6}})
    memory = LimiterState(Twist2(0.003, 0.0), -9.0, -9.0)
    after = shape(Twist2(-0.5, 0.0), memory, BASE, robot.limits, DT)
    assert after.sent.v_mps == pytest.approx(-0.0025)


@table("sign", [1.0, -1.0])
def test_either_way_slowing_is_quick_and_speeding_up_gentle(sign: float) -> None:
    memory = LimiterState(Twist2(0.3 * sign, 0.0))
    slowed = shaped(Twist2(0.1 * sign, 0.0), memory)
    assert slowed.sent.v_mps == pytest.approx(sign * (0.3 - 10.0 * DT * DT))
    faster = shaped(Twist2(0.5 * sign, 0.0), memory)
    assert faster.sent.v_mps == pytest.approx(sign * (0.3 + 2.0 * DT * DT))
