"""Hold wheels and motions to each other, and a motion to its limits."""

from __future__ import annotations

from math import inf, isfinite, nan, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.geometry.kinematics import (
    STOPPED,
    fastest_rim,
    rim_speeds,
    saturate,
    scale_twist,
    twist_of,
    wheels_of,
)
from tests.bridge.core.table import table
from wire import STILL, RobotDescription, Twist2
from wire.geometry import MAX_SPEED_MPS
from wire.robot import Base, Limits

BASE, LIMITS = Base(), Limits()

anything = st.floats()

some_speed = st.floats(-50, 50)


@given(some_speed, some_speed)
def test_wheels_and_twist_are_inverse(left: float, right: float) -> None:
    back = wheels_of(twist_of(left, right, BASE), BASE)
    assert back.left_radps == pytest.approx(left, abs=1e-9)
    assert back.right_radps == pytest.approx(right, abs=1e-9)


def test_what_is_within_limits_passes_unchanged() -> None:
    asked = Twist2(0.5, 1.0)
    assert saturate(asked, BASE, LIMITS) is asked


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


CART = RobotDescription.model_validate(
    {
        "base": {"wheel_radius_m": 0.2, "wheel_separation_m": 0.8, "radius_m": 0.5},
        "limits": {"max_wheel_radps": 4.0, "max_speed_mps": 0.6, "max_turn_radps": 1.5},
        "drive": {
            "lag_s": 0.08, "response_s": 0.05, "dead_zone_radps": 0.1, "kp": 0.5,
            "ki_per_s": 10.0, "max_correction": 0.2,
        },
    }
)  # fmt: skip


FRAME, BOUNDS = CART.base, CART.limits


def test_rims_and_wheels_of_a_motion_and_back() -> None:
    twist = Twist2(0.3, -0.5)
    assert rim_speeds(twist, 0.8) == pytest.approx((0.5, 0.1))
    for v, w in ((0.3, -0.5), (-0.3, -0.5), (-0.3, 0.5)):
        assert fastest_rim(Twist2(v, w), 0.8) == pytest.approx(0.5)
    wheels = wheels_of(twist, FRAME)
    assert (wheels.left_radps, wheels.right_radps) == pytest.approx((2.5, 0.5))
    back = twist_of(2.5, 0.5, FRAME)
    assert (back.v_mps, back.w_radps) == pytest.approx((0.3, -0.5))
    for odd in (inf, nan, -inf):
        assert wheels_of(Twist2(odd, 0.0), FRAME) == STOPPED
        assert twist_of(odd, 0.0, FRAME) == STILL
        assert twist_of(0.0, odd, FRAME) == STILL
    assert wheels_of(Twist2(1e308, 1e309), FRAME) == STOPPED
    assert wheels_of(Twist2(1e308, -1e308), FRAME) == STOPPED


@table(
    ("v", "w", "cap", "factor"),
    [
        (0.6, 0.0, 1.0, 1.0), (0.8, 0.0, 1.0, 0.75), (-0.8, 0.0, 1.0, 0.75),
        (0.0, 1.5, 1.0, 1.0), (0.0, -2.0, 1.0, 0.75), (0.3, 0.0, 0.5, 1.0),
        (0.6, 0.0, 0.5, 0.5), (0.0, 1.5, 0.5, 0.5), (0.4, 1.0, 1.0, 1.0),
        (0.5, 1.0, 1.0, 0.8 / 0.9), (0.4, 1.4, 1.0, 0.8 / 0.96), (0.6, 0.2, 0.0, 0.0),
        (0.6, 1.0, 0.1, 0.1), (0.1, 0.1, -1e-9, None), (0.1, 0.1, 1.0 + 1e-9, None),
        (0.1, 0.1, nan, None), (nan, 0.1, 1.0, None), (0.1, inf, 1.0, None),
    ],
)  # fmt: skip
def test_one_factor_brings_a_motion_within_all_limits(
    v: float, w: float, cap: float, factor: float | None
) -> None:
    out = saturate(Twist2(v, w), FRAME, BOUNDS, cap)
    if factor is None:
        assert out == STILL
    else:
        assert (out.v_mps, out.w_radps) == pytest.approx((v * factor, w * factor))


def test_lateral_acceleration_is_held_by_its_root() -> None:
    limits = BOUNDS.model_copy(update={"max_lateral_mps2": 0.2})
    for v, w, factor in ((0.4, 0.5, 1.0), (0.4, 0.8, sqrt(0.2 / 0.32)), (-0.4, 0.8, sqrt(0.625))):
        out = saturate(Twist2(v, w), FRAME, limits)
        assert (out.v_mps, out.w_radps) == pytest.approx((v * factor, w * factor))


def test_a_factor_of_one_changes_no_bit() -> None:
    odd = Twist2(0.1 + 0.2, 0.7)
    assert scale_twist(odd, 1.0) is odd
    assert scale_twist(Twist2(0.4, -0.2), 0.5) == Twist2(0.2, -0.1)
