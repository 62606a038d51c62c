"""Hold the wheel arithmetic against formulas, against other controllers, and against any float."""

from __future__ import annotations

from math import isfinite

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.geometry.kinematics import (
    fastest_rim,
    rim_speeds,
    saturate,
    twist_of,
    wheels_of,
)
from wire.geometry import MAX_SPEED_MPS, STILL, Twist2
from wire.robot import Base, Limits

BASE, LIMITS = Base(), Limits()
anything = st.floats()
some_speed = st.floats(-50, 50)


# Vectors of ros2_controllers' diff_drive_controller tests, DD1 to DD3 and DD13, DD14.
@pytest.mark.parametrize(
    ("radius", "separation", "v", "w", "left", "right"),
    [
        (1.0, 0.4, 1.0, 0.0, 1.0, 1.0),
        (0.1, 1.0, 1.0, 0.0, 10.0, 10.0),
        (0.1, 0.4, 1.0, 1.0, 8.0, 12.0),
    ],
)
def test_wheel_speeds_match_the_formula(
    radius: float, separation: float, v: float, w: float, left: float, right: float
) -> None:
    base = Base(wheel_radius_m=radius, wheel_separation_m=separation)
    wheels = wheels_of(Twist2(v, w), base)
    assert wheels.left_radps == pytest.approx(left)
    assert wheels.right_radps == pytest.approx(right)


@given(some_speed, some_speed)
def test_wheels_and_twist_are_inverse(left: float, right: float) -> None:
    back = wheels_of(twist_of(left, right, BASE), BASE)
    assert back.left_radps == pytest.approx(left, abs=1e-9)
    assert back.right_radps == pytest.approx(right, abs=1e-9)


def test_speed_above_the_limit_becomes_the_limit() -> None:
    assert saturate(Twist2(5.0, 0.0), BASE, LIMITS) == Twist2(0.5, 0.0)
    assert saturate(Twist2(0.0, 5.0), BASE, LIMITS) == Twist2(0.0, 1.0)


def test_what_is_within_limits_passes_unchanged() -> None:
    asked = Twist2(0.5, 1.0)
    assert saturate(asked, BASE, LIMITS) is asked


def test_lateral_acceleration_slows_both_by_one_factor() -> None:
    limits = Limits(max_speed_mps=1.0, max_turn_radps=2.0, max_lateral_mps2=0.5)
    slowed = saturate(Twist2(1.0, 2.0), BASE, limits)
    assert slowed.v_mps * slowed.w_radps == pytest.approx(0.5)
    assert slowed.w_radps / slowed.v_mps == pytest.approx(2.0)


@pytest.mark.parametrize("cap", [-0.1, 1.1, float("nan"), float("inf")])
def test_an_impossible_cap_is_standstill(cap: float) -> None:
    assert saturate(Twist2(0.1, 0.1), BASE, LIMITS, cap) == STILL


@given(anything, anything, st.floats(0, 1))
def test_no_input_exceeds_a_limit(v: float, w: float, cap: float) -> None:
    out = saturate(Twist2(v, w), BASE, LIMITS, cap)
    slack = 1 + 1e-12
    tiny = 1e-15  # a cap of 1e-300 loses digits on the way
    assert abs(out.v_mps) <= LIMITS.max_speed_mps * cap * slack + tiny
    assert abs(out.w_radps) <= LIMITS.max_turn_radps * cap * slack + tiny
    assert abs(out.v_mps * out.w_radps) <= LIMITS.max_lateral_mps2 * slack
    most = LIMITS.max_wheel_radps * slack
    wheels = wheels_of(out, BASE)
    assert abs(wheels.left_radps) <= most
    assert abs(wheels.right_radps) <= most


@given(some_speed, some_speed)
def test_saturation_keeps_the_curve(v: float, w: float) -> None:
    out = saturate(Twist2(v, w), BASE, LIMITS)
    assert out.v_mps * w == pytest.approx(out.w_radps * v, abs=1e-9)
    assert out.v_mps * v >= 0.0
    assert out.w_radps * w >= 0.0


@given(anything, anything)
def test_wheels_are_always_finite(v: float, w: float) -> None:
    wheels = wheels_of(Twist2(v, w), BASE)
    assert isfinite(wheels.left_radps)
    assert isfinite(wheels.right_radps)
    measured = twist_of(v, w, BASE)
    assert abs(measured.v_mps) <= MAX_SPEED_MPS


def test_a_runaway_is_still_seen_as_fast() -> None:
    assert twist_of(1e6, 1e6, BASE).v_mps == MAX_SPEED_MPS
    assert twist_of(-1e6, -1e6, BASE).v_mps == -MAX_SPEED_MPS


@given(some_speed, some_speed)
def test_fastest_rim_is_the_faster_wheel(v: float, w: float) -> None:
    left, right = rim_speeds(Twist2(v, w), 0.5)
    assert fastest_rim(Twist2(v, w), 0.5) == pytest.approx(max(abs(left), abs(right)))
