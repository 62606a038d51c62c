"""Hold the planned stop against the stop that the limiter really makes."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.kinematics import fastest_rim, saturate
from bridge.core.modes.stop_profile import (
    plan_stop,
    planned_rim_mps,
    planned_twist,
    too_long,
    too_slow,
)
from bridge.core.motion.limiter import shape
from bridge.core.state_motion import NO_STOP, LimiterState, Profile, StopPlan
from wire.geometry import STILL, Twist2
from wire.robot import Base, Limits

BASE, LIMITS = Base(), Limits()
DT, LAG = 0.01, 0.06
stops = st.sampled_from([Profile.STOP, Profile.FASTEST])
moving = st.builds(Twist2, st.floats(-0.5, 0.5), st.floats(-1, 1)).map(
    lambda twist: saturate(twist, BASE, LIMITS)
)


def test_an_ordinary_stop_takes_speed_over_deceleration_and_the_jerk_time() -> None:
    plan = plan_stop(LimiterState(Twist2(0.5, 0.0)), BASE, LIMITS, Profile.STOP)
    assert plan.duration_s == pytest.approx(0.5 / 1.0 + 1.0 / 10.0)
    assert planned_twist(plan, 0.0) == Twist2(0.5, 0.0)
    assert planned_twist(plan, 0.3).v_mps == pytest.approx(0.25)
    assert planned_twist(plan, 0.6) == STILL


def test_a_stop_begun_while_braking_is_shorter() -> None:
    braking = LimiterState(Twist2(0.5, 0.0), -1.0, -1.0)
    plan = plan_stop(braking, BASE, LIMITS, Profile.STOP)
    assert plan.duration_s == pytest.approx(0.45 / 1.0 + 1.0 / 10.0)
    assert planned_twist(plan, 0.2).v_mps == pytest.approx(0.3)


def test_standstill_needs_no_plan() -> None:
    assert plan_stop(LimiterState(), BASE, LIMITS, Profile.STOP) == NO_STOP
    assert planned_twist(NO_STOP, 1.0) == STILL
    odd = LimiterState(Twist2(float("nan"), 0.0))
    assert plan_stop(odd, BASE, LIMITS, Profile.STOP) == NO_STOP


@given(moving, st.floats(-1, 1), stops)
def test_the_limiter_follows_the_plan(twist: Twist2, accel: float, profile: Profile) -> None:
    memory = LimiterState(twist, accel, accel)
    plan = plan_stop(memory, BASE, LIMITS, profile)
    for tick in range(1, 130):
        memory = shape(twist, memory, BASE, LIMITS, DT, profile=profile)
        rim = fastest_rim(memory.sent, BASE.wheel_separation_m)
        assert rim <= planned_rim_mps(plan, (tick - 2) * DT) + 0.006
        assert not too_slow(plan, memory.sent, tick * DT, LAG, BASE)
    assert memory.sent == STILL
    adapter = TypeAdapter(StopPlan)
    assert adapter.validate_json(adapter.dump_json(plan)) == plan


@given(moving, st.floats(0, 1), stops, st.floats(0, 2), st.floats(0, 0.2))
def test_the_plan_never_rises(
    twist: Twist2, braking: float, profile: Profile, at_s: float, later_s: float
) -> None:
    plan = plan_stop(LimiterState(twist, -braking, -braking), BASE, LIMITS, profile)
    assert planned_rim_mps(plan, at_s + later_s) <= planned_rim_mps(plan, at_s) + 1e-12


def test_a_robot_that_does_not_slow_is_too_slow_and_takes_too_long() -> None:
    going = Twist2(0.5, 0.0)
    plan = plan_stop(LimiterState(going), BASE, LIMITS, Profile.STOP)
    assert not too_slow(plan, going, LAG + 0.2, LAG, BASE)
    assert too_slow(plan, going, LAG + 0.2 + 0.3, LAG, BASE)
    assert not too_long(plan, 1.5 * (0.6 + LAG) + 0.29, LAG)
    assert too_long(plan, 1.5 * (0.6 + LAG) + 0.31, LAG)


def test_what_is_not_a_number_is_judged_too_slow() -> None:
    plan = plan_stop(LimiterState(Twist2(0.5, 0.0)), BASE, LIMITS, Profile.STOP)
    assert too_slow(plan, Twist2(float("nan"), 0.0), 0.5, LAG, BASE)
    assert too_long(plan, float("nan"), LAG)


@given(st.floats(), st.floats(), st.floats(), st.floats())
def test_no_number_raises(v: float, w: float, accel: float, elapsed: float) -> None:
    plan = plan_stop(LimiterState(Twist2(v, w), accel, accel), BASE, LIMITS, Profile.STOP)
    assert planned_rim_mps(plan, elapsed) >= 0.0 or elapsed != elapsed
