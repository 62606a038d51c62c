"""Hold odometry against the exact arc, against other controllers' vectors, and against nonsense."""

from __future__ import annotations

from math import cos, isfinite, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.odometry import OdometryState, advance, along_arc, roll
from wire.geometry import IDENTITY, Pose2, Twist2
from wire.robot import Base
from wire.sensors import DriveState

BASE = Base(wheel_radius_m=1.0, wheel_separation_m=1.0)


def reading(left: float, right: float, *, boot: str = "a", speed: float = 0.0) -> DriveState:
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


def test_driving_from_a_set_pose_goes_along_its_heading() -> None:
    pose = roll(Pose2(5.0, -2.0, pi / 2), 1.0, 1.0, 1.0)
    assert (pose.x_m, pose.y_m, pose.yaw_rad) == pytest.approx((5.0, -1.0, pi / 2))


def test_the_first_reading_is_the_zero() -> None:
    state = advance(OdometryState(), reading(100.0, -7.0), BASE)
    assert state.base_in_odom == IDENTITY
    assert state.travelled_m == 0.0


def test_steps_add_up_and_are_metered() -> None:
    state = advance(OdometryState(), reading(0.0, 0.0), BASE)
    for angle in (0.5, 1.0, 0.5):
        state = advance(state, reading(angle, angle, speed=0.2), BASE)
    assert state.base_in_odom == Pose2(0.5, 0.0, 0.0)
    assert state.travelled_m == pytest.approx(1.5)
    assert state.measured == Twist2(0.2, 0.0)


def test_another_boot_moves_nothing() -> None:
    state = advance(OdometryState(), reading(0.0, 0.0), BASE)
    state = advance(state, reading(0.5, 0.5), BASE)
    state = advance(state, reading(0.0, 0.0, boot="b"), BASE, rezero=True)
    state = advance(state, reading(0.25, 0.25, boot="b"), BASE)
    assert state.base_in_odom == Pose2(0.75, 0.0, 0.0)
    assert state.jumps == 0


def test_an_impossible_step_is_counted_not_driven() -> None:
    state = advance(OdometryState(), reading(0.0, 0.0), BASE)
    state = advance(state, reading(1e9, 1e9), BASE)
    assert state.base_in_odom == IDENTITY
    assert state.jumps == 1
    state = advance(state, reading(1e9 + 0.5, 1e9 + 0.5), BASE)
    assert state.base_in_odom == Pose2(0.5, 0.0, 0.0)


@given(st.lists(st.tuples(st.floats(), st.floats(), st.floats()), max_size=5))
def test_no_reading_raises_or_leaves_the_finite(readings: list[tuple[float, float, float]]) -> None:
    state = OdometryState()
    for left, right, speed in readings:
        state = advance(state, reading(left, right, speed=speed), BASE)
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
