"""Hold the limiter to a smoother written plainly, and to its limits under any input."""

from __future__ import annotations

from math import sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.kinematics import fastest_rim, rim_speeds, saturate
from bridge.core.motion.limiter import shape, stopping_m, tick_length
from bridge.core.state_motion import LimiterState, Profile
from tests.bridge.core.table import table
from wire import STILL, RobotDescription, Twist2
from wire.robot import Base, Limits

BASE, LIMITS = Base(), Limits()
DT = 0.01


# The vectors are of limiters without a jerk limit: bounds as high as robot.toml allows, and beyond.
QUICK = {"max_jerk_mps3": 1e6, "stop_jerk_mps3": 1e6, "max_speed_mps": 2.0, "max_wheel_radps": 99.0}


def unjerked(accel: float, decel: float) -> Limits:
    return Limits().model_copy(
        update={
            **QUICK,
            "max_accel_mps2": accel,
            "max_decel_mps2": decel,
            "hardest_decel_mps2": max(decel, 2.5),
        }
    )


# nav2's velocity smoother at 20 Hz, VS4 to VS9.
@pytest.mark.parametrize(
    ("current", "asked", "accel", "decel", "expected"),
    [
        (0.5, 1.5, 0.1, 1.0, 0.505),
        (1.5, 0.5, 0.1, 1.0, 1.45),
        (1.0, 0.0, 0.1, 1.0, 0.95),
        (-1.5, -0.5, 0.1, 1.0, -1.45),
        (-1.0, 0.0, 0.1, 1.0, -0.95),
        (-0.2, 0.8, 0.1, 1.0, -0.15),
        (0.2, -0.8, 0.1, 1.0, 0.15),
        (1.0, 2.0, 1.5, 2.0, 1.075),
        (0.5, 0.55, 2.5, 2.5, 0.55),
        (0.5, 0.45, 2.5, 2.5, 0.45),
    ],
)
def test_steps_match_the_smoother(
    current: float, asked: float, accel: float, decel: float, expected: float
) -> None:
    memory = shape(
        Twist2(asked, 0.0),
        LimiterState(Twist2(current, 0.0)),
        BASE,
        unjerked(accel, decel),
        0.05,
        period_s=0.05,
    )
    assert memory.sent.v_mps == pytest.approx(expected)


def test_the_stopping_length_is_enough_and_not_much_more() -> None:
    memory, gone = LimiterState(Twist2(0.5, 0.0)), 0.0
    need = stopping_m(memory.sent, 0.0, BASE, LIMITS, DT)
    while memory.sent != STILL:
        memory = shape(STILL, memory, BASE, LIMITS, DT)
        gone += memory.sent.v_mps * DT
    assert need - 0.02 <= gone <= need


speeds = st.builds(Twist2, st.floats(-2, 2), st.floats(-4, 4))
wild = st.builds(Twist2, st.floats(), st.floats())
memories = st.builds(LimiterState, speeds, st.floats(-3, 3), st.floats(-3, 3))
profiles = st.sampled_from(Profile)


@given(
    wild,
    st.builds(LimiterState, wild, st.floats(), st.floats()),
    st.floats(),
    profiles,
    st.none() | st.floats(),
)
def test_no_input_makes_a_wheel_exceed_its_limits(
    target: Twist2, memory: LimiterState, dt: float, profile: Profile, room: float | None
) -> None:
    out = shape(target, memory, BASE, LIMITS, dt, profile=profile, room_m=room)
    assert abs(out.sent.v_mps) <= LIMITS.max_speed_mps + 1e-9
    assert abs(out.sent.w_radps) <= LIMITS.max_turn_radps + 1e-9
    most = LIMITS.max_wheel_radps * BASE.wheel_radius_m + 1e-9
    assert fastest_rim(out.sent, BASE.wheel_separation_m) <= most
    adapter = TypeAdapter(LimiterState)
    assert adapter.validate_json(adapter.dump_json(out)) == out


@given(speeds, memories, st.floats(0.005, 0.02), profiles)
def test_no_wheel_changes_faster_than_allowed(
    target: Twist2, memory: LimiterState, dt: float, profile: Profile
) -> None:
    last = saturate(memory.sent, BASE, LIMITS)
    out = shape(target, memory, BASE, LIMITS, dt, profile=profile)
    decel = LIMITS.hardest_decel_mps2 if profile is Profile.FASTEST else LIMITS.max_decel_mps2
    for before, after in zip(
        rim_speeds(last, BASE.wheel_separation_m),
        rim_speeds(out.sent, BASE.wheel_separation_m),
        strict=True,
    ):
        slows = abs(after) <= abs(before) and after * before >= 0.0
        most = decel if slows or after * before < 0.0 else LIMITS.max_accel_mps2
        assert abs(after - before) <= most * dt + 1e-9


@given(memories, st.sampled_from([Profile.STOP, Profile.FASTEST]))
def test_a_stop_ends_in_time_and_only_slows(memory: LimiterState, profile: Profile) -> None:
    start = saturate(memory.sent, BASE, LIMITS)
    memory = LimiterState(start, memory.left_mps2, memory.right_mps2)
    rim = fastest_rim(start, BASE.wheel_separation_m)
    d, j = LIMITS.max_decel_mps2, LIMITS.stop_jerk_mps3
    limit_s = rim / d + min(d / j, 2 * sqrt(rim / j)) + 0.05
    if profile is Profile.FASTEST:
        limit_s = rim / LIMITS.hardest_decel_mps2 + 0.02
    ticks = 0
    while memory.sent != STILL:
        following = shape(start, memory, BASE, LIMITS, DT, profile=profile)
        ticks += 1
        assert ticks * DT <= limit_s
        assert abs(following.sent.v_mps) <= abs(memory.sent.v_mps)
        assert abs(following.sent.w_radps) <= abs(memory.sent.w_radps)
        assert following.sent.v_mps * start.w_radps == pytest.approx(
            following.sent.w_radps * start.v_mps, abs=1e-9
        )
        memory = following


@settings(max_examples=30)
@given(memories, speeds)
def test_the_target_is_reached_exactly_and_kept(memory: LimiterState, target: Twist2) -> None:
    wanted = saturate(target, BASE, LIMITS)
    for _ in range(600):
        memory = shape(target, memory, BASE, LIMITS, DT)
    assert memory.sent == wanted
    assert shape(target, memory, BASE, LIMITS, DT).sent == wanted


@given(memories)
def test_a_stop_order_is_no_slower_than_letting_go(memory: LimiterState) -> None:
    ordered = shape(Twist2(0.5, 0.0), memory, BASE, LIMITS, DT, profile=Profile.STOP)
    let_go = shape(STILL, memory, BASE, LIMITS, DT)
    assert fastest_rim(ordered.sent, 0.5) <= fastest_rim(let_go.sent, 0.5)


CART = RobotDescription()
FRAME, BOUNDS = CART.base, CART.limits


def shaped(target: Twist2, memory: LimiterState, dt_s: float = DT) -> LimiterState:
    return shape(target, memory, FRAME, BOUNDS, dt_s)


@table("sign", [1.0, -1.0])
def test_from_rest_either_way_the_gentle_jerk_counts(sign: float) -> None:
    after = shaped(Twist2(0.5 * sign, 0.0), LimiterState())
    assert after.sent.v_mps == pytest.approx(sign * 2.0 * DT * DT), "2 m/s3, not 10"


@table(
    ("dt_s", "length_s"),
    [(0.004, 0.005), (0.005, 0.005), (0.0053, 0.0053), (0.02, 0.02), (0.021, 0.02), (0.027, 0.02),
     (float("nan"), 0.01), (-1.0, 0.005)],
)  # fmt: skip
def test_a_tick_is_held_between_half_a_period_and_two(dt_s: float, length_s: float) -> None:
    assert tick_length(dt_s, 0.01) == length_s


def test_acceleration_fades_as_the_square_root_of_twice_the_jerk_and_the_rest() -> None:
    # 1 mm/s left: sqrt(2 x 2 x 0.001) = 63 mm/s2
    memory = LimiterState(Twist2(0.299, 0.0), 0.5, 0.5)
    after = shaped(Twist2(0.3, 0.0), memory)
    assert after.sent.v_mps == pytest.approx(0.299 + 0.004**0.5 * DT)


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
    needs_m = stopping_m(last, 0.0, FRAME, BOUNDS, DT)
    for room_m, slowed_mps in ((needs_m, 10.0 * DT * DT), (needs_m * 0.999, 1.0 * DT)):
        after = shape(Twist2(0.0, 0.0), LimiterState(last), FRAME, BOUNDS, DT, room_m=room_m)
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
    after = shape(Twist2(-0.5, 0.0), memory, FRAME, robot.limits, DT)
    assert after.sent.v_mps == pytest.approx(-0.0025)


@table("sign", [1.0, -1.0])
def test_either_way_slowing_is_quick_and_speeding_up_gentle(sign: float) -> None:
    memory = LimiterState(Twist2(0.3 * sign, 0.0))
    slowed = shaped(Twist2(0.1 * sign, 0.0), memory)
    assert slowed.sent.v_mps == pytest.approx(sign * (0.3 - 10.0 * DT * DT))
    faster = shaped(Twist2(0.5 * sign, 0.0), memory)
    assert faster.sent.v_mps == pytest.approx(sign * (0.3 + 2.0 * DT * DT))
