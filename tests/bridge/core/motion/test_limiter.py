"""Hold the limiter against other smoothers' vectors and against laws over any input."""

from __future__ import annotations

from math import sqrt

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.kinematics import fastest_rim, rim_speeds, saturate
from bridge.core.motion.limiter import shape, stopping_m, tick_length
from bridge.core.state_motion import LimiterState, Profile
from wire.geometry import STILL, Twist2
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


def ticks_to(target: float, start: float, limits: Limits, dt: float) -> tuple[int, list[float]]:
    memory, speeds = LimiterState(Twist2(start, 0.0)), [start]
    while speeds[-1] != target:
        memory = shape(Twist2(target, 0.0), memory, BASE, limits, dt, period_s=dt)
        speeds.append(memory.sent.v_mps)
        assert len(speeds) < 10_000
    return len(speeds) - 1, speeds


# ros2_controllers' acceleration limiter table, 1 ms. They have limits per direction; ours are one
# pair, towards zero and away from it, so their reverse rows run with their reverse numbers.
@pytest.mark.parametrize(
    ("start", "target", "accel", "decel", "seconds"),
    [
        (0.0, 1.0, 2.0, 4.0, 0.5),
        (1.0, 0.0, 2.0, 4.0, 0.25),
        (0.0, -1.0, 8.0, 10.0, 0.125),
        (-1.0, 0.0, 8.0, 10.0, 0.1),
        (0.0, 1.0, 5.0, 4.0, 0.2),
    ],
)
def test_ramps_take_the_expected_time(
    start: float, target: float, accel: float, decel: float, seconds: float
) -> None:
    ticks, speeds = ticks_to(target, start, unjerked(accel, decel), 0.001)
    assert ticks in (round(seconds * 1000), round(seconds * 1000) + 1)
    assert all(abs(speed) < abs(target) for speed in speeds[:-1] if abs(target) > abs(start))


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


def test_a_reversal_brakes_to_zero_then_accelerates() -> None:
    # VS6 in full: four steps of 0.05 down, then steps of 0.005 up.
    _, speeds = ticks_to(0.05, -0.2, unjerked(0.1, 1.0), 0.05)
    assert speeds[:6] == pytest.approx([-0.2, -0.15, -0.1, -0.05, 0.0, 0.005])


def test_four_hundred_equal_steps_then_holds() -> None:
    ticks, _ = ticks_to(2.0, 0.0, unjerked(0.1, 1.0), 0.05)
    assert ticks in (400, 401)


def test_the_first_command_from_rest_is_one_step() -> None:
    memory = shape(Twist2(0.5, 0.0), LimiterState(), BASE, unjerked(2.5, 2.5), 0.05, period_s=0.05)
    assert memory.sent == Twist2(0.125, 0.0)


def test_starting_is_gentle_and_stopping_is_not() -> None:
    started = shape(Twist2(0.5, 0.0), LimiterState(), BASE, LIMITS, DT)
    assert started.sent.v_mps == pytest.approx(LIMITS.max_jerk_mps3 * DT * DT)
    going = LimiterState(Twist2(0.5, 0.0))
    stopped = shape(STILL, going, BASE, LIMITS, DT)
    assert 0.5 - stopped.sent.v_mps == pytest.approx(LIMITS.stop_jerk_mps3 * DT * DT)


def test_acceleration_fades_out_at_the_target() -> None:
    memory, steps = LimiterState(), [0.0]
    while memory.sent.v_mps < 0.5:
        following = shape(Twist2(0.5, 0.0), memory, BASE, LIMITS, DT)
        steps.append(following.sent.v_mps - memory.sent.v_mps)
        memory = following
    assert max(steps) == pytest.approx(LIMITS.max_accel_mps2 * DT)
    assert steps[-1] < 0.3 * max(steps)


def test_jerk_yields_where_the_room_is_short() -> None:
    going = LimiterState(Twist2(0.5, 0.0))
    need = stopping_m(going.sent, 0.0, BASE, LIMITS, DT)
    gentle = shape(STILL, going, BASE, LIMITS, DT, room_m=need + 0.01)
    firm = shape(STILL, going, BASE, LIMITS, DT, room_m=need - 0.01)
    assert gentle.sent.v_mps > firm.sent.v_mps
    assert firm.sent.v_mps == pytest.approx(0.5 - LIMITS.max_decel_mps2 * DT)


@pytest.mark.parametrize("room", [float("nan"), -1.0, 0.0])
def test_no_room_is_no_jerk_limit(room: float) -> None:
    going = LimiterState(Twist2(0.5, 0.0))
    assert shape(STILL, going, BASE, LIMITS, DT, room_m=room).sent.v_mps == pytest.approx(0.49)


def test_the_stopping_length_is_enough_and_not_much_more() -> None:
    memory, gone = LimiterState(Twist2(0.5, 0.0)), 0.0
    need = stopping_m(memory.sent, 0.0, BASE, LIMITS, DT)
    while memory.sent != STILL:
        memory = shape(STILL, memory, BASE, LIMITS, DT)
        gone += memory.sent.v_mps * DT
    assert need - 0.02 <= gone <= need


def test_a_turn_in_place_and_standstill_need_no_path() -> None:
    assert stopping_m(STILL, 0.0, BASE, LIMITS, DT) == 0.0
    assert stopping_m(Twist2(0.0, 1.0), 0.0, BASE, LIMITS, DT) == 0.0


def test_a_wheel_that_need_not_change_holds_nothing_up() -> None:
    pivot = Twist2(0.1, 0.4)  # the left wheel stands
    memory = shape(pivot, LimiterState(), BASE, unjerked(1.0, 1.0), DT)
    assert rim_speeds(memory.sent, BASE.wheel_separation_m) == pytest.approx((0.0, 0.01))


def test_the_hardest_stop_has_no_jerk_limit() -> None:
    memory = LimiterState(Twist2(0.5, 0.0))
    for _ in range(20):
        memory = shape(Twist2(0.5, 0.0), memory, BASE, LIMITS, DT, profile=Profile.FASTEST)
    assert memory.sent.v_mps == pytest.approx(0.0, abs=1e-12)


def test_a_stop_goes_on_from_the_deceleration_under_way() -> None:
    braking = LimiterState(Twist2(0.4, 0.0), -1.0, -1.0)
    memory = shape(Twist2(0.4, 0.0), braking, BASE, LIMITS, DT, profile=Profile.STOP)
    assert memory.sent.v_mps == pytest.approx(0.39)


def test_a_stop_while_accelerating_never_speeds_up_first() -> None:
    rising = LimiterState(Twist2(0.3, 0.0), 0.5, 0.5)
    assert shape(STILL, rising, BASE, LIMITS, DT).sent.v_mps < 0.3


@pytest.mark.parametrize(
    ("dt", "period", "held"),
    [
        (0.01, 0.01, 0.01),
        (0.0, 0.01, 0.005),
        (-5.0, 0.01, 0.005),
        (9.0, 0.01, 0.02),
        (float("inf"), 0.01, 0.02),
        (float("nan"), 0.01, 0.01),
        (0.01, float("nan"), 0.01),
        (0.01, 0.0, 0.01),
    ],
)
def test_a_tick_is_never_taken_longer_than_two_periods(
    dt: float, period: float, held: float
) -> None:
    assert tick_length(dt, period) == held


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
