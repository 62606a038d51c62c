"""Hold wheels and motions to each other, and a motion to its limits."""

from __future__ import annotations

from math import cos, inf, isfinite, nan, pi, sin, sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.kinematics import (
    STOPPED,
    OdometryState,
    advance,
    along_arc,
    arc_end,
    fastest_rim,
    rim_speeds,
    roll,
    saturate,
    scale_twist,
    twist_of,
    wheels_of,
)
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from wire import IDENTITY, STILL, DriveState, Pose2, RobotDescription, Twist2
from wire.geometry import MAX_COORDINATE_M, MAX_SPEED_MPS
from wire.robot import Base, Limits

BASE, LIMITS = Base(), Limits()
anything = st.floats()
some_speed = st.floats(-50, 50)


@given(some_speed, some_speed)
def test_wheels_and_twist_are_inverse(left: float, right: float) -> None:
    back = wheels_of(twist_of(left, right, BASE), BASE)
    assert back.left_radps == pytest.approx(left, abs=1e-9)
    assert back.right_radps == pytest.approx(right, abs=1e-9)


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


UNIT = Base(wheel_radius_m=1.0, wheel_separation_m=1.0)


def reading_of(left: float, right: float, *, boot: str = "a", speed: float = 0.0) -> DriveState:
    return DriveState.model_construct(
        boot_id=boot,
        seq=1,
        stamp_s=0.0,
        echo_boot=None,
        echo_seq=0,
        enabled=True,
        timed_out=False,
        left_rad=left,
        right_rad=right,
        left_radps=speed,
        right_radps=speed,
    )


# ros2_controllers' odometry table (L = 1, r = 1). They reject a step of 1e-7 s; we integrate angles
# and know no step time, so a small step is simply a small step.
@pytest.mark.parametrize(
    ("left", "right", "x", "y", "yaw"),
    [
        (1.0, 1.0, 1.0, 0.0, 0.0),
        (-1.0, 1.0, 0.0, 0.0, 2.0),
        (1.0, 2.0, 1.5 * sin(1.0), 1.5 * (1 - cos(1.0)), 1.0),
    ],
)
def test_arcs_are_exact(left: float, right: float, x: float, y: float, yaw: float) -> None:
    pose = roll(IDENTITY, left, right, 1.0)
    assert (pose.x_m, pose.y_m, pose.yaw_rad) == pytest.approx((x, y, yaw))


@given(st.lists(st.tuples(st.floats(), st.floats(), st.floats()), max_size=5))
def test_no_reading_raises_or_leaves_the_finite(readings: list[tuple[float, float, float]]) -> None:
    state = OdometryState()
    for left, right, speed in readings:
        state = advance(state, reading_of(left, right, speed=speed), UNIT)
    adapter = TypeAdapter(OdometryState)
    assert adapter.validate_json(adapter.dump_json(state)) == state


@given(st.floats(), st.floats(), st.floats(-3, 3))
def test_an_arc_never_leaves_the_world(length: float, turn: float, yaw: float) -> None:
    pose = along_arc(Pose2(1.0, 2.0, yaw), length, turn)
    assert isfinite(pose.x_m)
    assert isfinite(pose.y_m)
    assert isfinite(pose.yaw_rad)


@given(st.floats(-2, 2), st.floats(-2, 2), st.floats(0, 1))
def test_an_arc_may_be_gone_in_parts(length: float, turn: float, part: float) -> None:
    whole = along_arc(IDENTITY, length, turn)
    halved = along_arc(
        along_arc(IDENTITY, length * part, turn * part), length * (1 - part), turn * (1 - part)
    )
    assert (halved.x_m, halved.y_m) == pytest.approx((whole.x_m, whole.y_m), abs=1e-6)


def reading(left: float, right: float, *, speeds: tuple[float, float] = (0.0, 0.0)) -> DriveState:
    state = reached("active").state.drive.newest
    assert state is not None
    return state.model_copy(
        update={
            "left_rad": left, "right_rad": right,
            "left_radps": speeds[0], "right_radps": speeds[1],
        }
    )  # fmt: skip


def test_what_leaves_the_world_or_is_no_number_moves_nothing() -> None:
    pose = Pose2(1.0, 2.0, 0.5)
    for turn in (inf, -inf, nan):
        assert arc_end(pose, 1.0, turn) == (1.0, 2.0)
        assert along_arc(pose, 1.0, turn) == pose
    edge = Pose2(MAX_COORDINATE_M - 1.0, 0.0, 0.0)
    assert along_arc(edge, 1.0, 0.0).x_m == MAX_COORDINATE_M
    assert along_arc(edge, 1.001, 0.0) == edge
    for yaw in (0.0, pi / 2, pi, -pi / 2):
        far = Pose2(cos(yaw) * (MAX_COORDINATE_M - 1), sin(yaw) * (MAX_COORDINATE_M - 1), yaw)
        assert along_arc(far, 1.5, 0.0) == far
        assert along_arc(far, 0.5, 0.0) != far


def test_two_wheel_paths_make_an_arc() -> None:
    there = roll(Pose2(0.0, 0.0, 0.0), 0.1, 0.5, 0.8)  # 0.3 m, turning by 0.5 rad
    assert (there.x_m, there.y_m) == pytest.approx((0.6 * sin(0.5), 0.6 * (1 - cos(0.5))))
    assert there.yaw_rad == pytest.approx(0.5)


@table(
    ("left", "right", "rezero", "rolls", "jumps"),
    [
        (1.5, 4.5, False, (0.1, 0.5), 0),
        (0.5, 1.5, False, (-0.1, -0.1), 0),
        (6.0, 2.0, False, (1.0, 0.0), 0),
        (6.0 + 1e-6, 2.0, False, (0.0, 0.0), 1),
        (1.0, 7.0 + 1e-6, False, (0.0, 0.0), 1),
        (1.0, -3.0 - 1e-6, False, (0.0, 0.0), 1),
        (-4.0, -3.0, False, (-1.0, -1.0), 0),
        (nan, 2.0, False, (0.0, 0.0), 1),
        (1.5, 4.5, True, (0.0, 0.0), 0),
    ],
)
def test_a_reading_rolls_the_robot_by_what_its_wheels_turned(
    left: float, right: float, rezero: bool, rolls: tuple[float, float], jumps: int
) -> None:
    start = Pose2(3.0, 4.0, 1.0)
    state = OdometryState(start, STILL, 1.0, 2.0, 10.0, 20.0, 5)
    after = advance(state, reading(left, right, speeds=(2.5, 0.5)), FRAME, rezero=rezero)
    assert after.base_in_odom == roll(start, *rolls, 0.8) if any(rolls) else start
    assert (after.measured.v_mps, after.measured.w_radps) == pytest.approx((0.3, -0.5))
    assert after.travelled_m == pytest.approx(10.0 + abs(sum(rolls)) / 2)
    assert after.turned_rad == pytest.approx(20.0 + abs(rolls[1] - rolls[0]) / 0.8)
    assert after.jumps == 5 + jumps
    assert (after.left_rad, after.right_rad) == (None if left != left else left, right)


def test_what_is_metered_stays_a_number() -> None:
    full = OdometryState(STILL_POSE, STILL, 0.0, 0.0, 1e12, 1e12)
    after = advance(full, reading(-2.0, 4.0), FRAME)
    assert (after.travelled_m, after.turned_rad) == (1e12, 1e12)


STILL_POSE = Pose2(0.0, 0.0, 0.0)
