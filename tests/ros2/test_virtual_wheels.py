"""Virtual wheels go there and back: what they are told is what the poses say of them."""

from __future__ import annotations

from math import cos, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2.robot_words import OdometryWords
from ros2.virtual_wheels import VirtualWheels
from wire import wrap
from wire.robot import Base

BASE = Base(wheel_radius_m=0.07, wheel_separation_m=0.31)
SPEEDS = st.floats(-10.0, 10.0)


def wheels() -> VirtualWheels:
    return VirtualWheels(BASE, top_mps=0.5, top_radps=1.0)


def pose(at_s: float, x_m: float, y_m: float, yaw: float, v: float, w: float) -> OdometryWords:
    return OdometryWords(
        stamp_s=at_s, x_m=x_m, y_m=y_m, yaw_rad=wrap(yaw), v_mps=v, w_radps=w,
        estop=False, bumper_front=False, bumper_rear=False, cliff=False,
    )  # fmt: skip


@given(SPEEDS, SPEEDS)
def test_a_twist_is_what_two_wheels_make_and_comes_back_as_them(left: float, right: float) -> None:
    made = wheels()
    v_mps, w_radps = made.twist(left, right)
    assert v_mps == pytest.approx(BASE.wheel_radius_m * (left + right) / 2)
    read = made.turn(pose(0.0, 0.0, 0.0, 0.0, v_mps, w_radps))
    assert read.left_radps == pytest.approx(left)
    assert read.right_radps == pytest.approx(right)


@given(SPEEDS, SPEEDS, st.floats(-3.0, 3.0), st.floats(0.005, 0.1))
def test_poses_along_an_arc_turn_the_wheels_as_far_as_their_speeds_say(
    left: float, right: float, heading_rad: float, step_s: float
) -> None:
    made = wheels()
    v_mps, w_radps = made.twist(left, right)
    x_m = y_m = at_s = 0.0
    yaw_rad = heading_rad
    read = made.turn(pose(at_s, x_m, y_m, yaw_rad, v_mps, w_radps))
    for _ in range(20):
        half_rad = w_radps * step_s / 2
        chord_m = v_mps * step_s * (sin(half_rad) / half_rad if abs(half_rad) > 1e-9 else 1.0)
        x_m += chord_m * cos(yaw_rad + half_rad)
        y_m += chord_m * sin(yaw_rad + half_rad)
        yaw_rad += 2 * half_rad
        at_s += step_s
        read = made.turn(pose(at_s, x_m, y_m, yaw_rad, v_mps, w_radps))
    assert read.left_rad == pytest.approx(left * at_s, abs=1e-6)
    assert read.right_rad == pytest.approx(right * at_s, abs=1e-6)


def test_a_pose_that_no_motion_leads_to_is_a_jump() -> None:
    made = wheels()
    assert not made.jumps(pose(0.0, 50.0, 0.0, 0.0, 0.0, 0.0)), "the first is no jump"
    made.turn(pose(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert not made.jumps(pose(0.02, 0.11, 0.0, 0.2, 0.0, 0.0))
    assert made.jumps(pose(0.02, 0.13, 0.0, 0.0, 0.0, 0.0))
    assert made.jumps(pose(0.02, 0.0, 0.0, 0.3, 0.0, 0.0))
    assert made.jumps(pose(-0.02, 0.0, 0.0, 0.0, 0.0, 0.0)), "time does not go back"
    made.forget()
    assert not made.jumps(pose(0.02, 9.0, 0.0, 0.0, 0.0, 0.0))


def test_a_speed_beyond_the_wire_is_as_fast_as_it_can_say() -> None:
    read = wheels().turn(pose(0.0, 0.0, 0.0, 0.0, 1e6, 0.0))
    assert (read.left_radps, read.right_radps) == (1000.0, 1000.0)
