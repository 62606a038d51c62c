"""Hold the arithmetic of wheels to numbers worked out by hand: kinematics, odometry, control.

The robot of these tests is like no other here: wheels of 0.2 m, 0.8 m apart.
"""

from __future__ import annotations

from dataclasses import replace
from math import cos, inf, nan, pi, sin, sqrt

import pytest

from bridge.core.geometry.kinematics import (
    STOPPED,
    fastest_rim,
    rim_speeds,
    saturate,
    scale_twist,
    twist_of,
    wheels_of,
)
from bridge.core.geometry.odometry import OdometryState, advance, along_arc, arc_end, roll
from bridge.core.motion import wheel_control
from bridge.core.motion.wheel_control import control_wheel
from bridge.core.state_motion import AT_REST, Wheel
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from wire import STILL, DriveState, Pose2, RobotDescription, Twist2
from wire.geometry import MAX_COORDINATE_M, MAX_SPEED_MPS, MAX_TURN_RADPS

ROBOT = RobotDescription.model_validate(
    {
        "base": {"wheel_radius_m": 0.2, "wheel_separation_m": 0.8, "radius_m": 0.5},
        "limits": {"max_wheel_radps": 4.0, "max_speed_mps": 0.6, "max_turn_radps": 1.5},
        "drive": {
            "lag_s": 0.08, "response_s": 0.05, "dead_zone_radps": 0.1, "kp": 0.5,
            "ki_per_s": 10.0, "max_correction": 0.2,
        },
    }
)  # fmt: skip
BASE, LIMITS = ROBOT.base, ROBOT.limits


def test_rims_and_wheels_of_a_motion_and_back() -> None:
    twist = Twist2(0.3, -0.5)
    assert rim_speeds(twist, 0.8) == pytest.approx((0.5, 0.1))
    for v, w in ((0.3, -0.5), (-0.3, -0.5), (-0.3, 0.5)):
        assert fastest_rim(Twist2(v, w), 0.8) == pytest.approx(0.5)
    wheels = wheels_of(twist, BASE)
    assert (wheels.left_radps, wheels.right_radps) == pytest.approx((2.5, 0.5))
    back = twist_of(2.5, 0.5, BASE)
    assert (back.v_mps, back.w_radps) == pytest.approx((0.3, -0.5))
    for odd in (inf, nan, -inf):
        assert wheels_of(Twist2(odd, 0.0), BASE) == STOPPED
        assert twist_of(odd, 0.0, BASE) == STILL
        assert twist_of(0.0, odd, BASE) == STILL
    assert wheels_of(Twist2(1e308, 1e309), BASE) == STOPPED
    assert wheels_of(Twist2(1e308, -1e308), BASE) == STOPPED


@table("sign", [1.0, -1.0])
def test_what_is_measured_is_held_within_what_may_be_said(sign: float) -> None:
    fast = twist_of(sign * 1e6, sign * 1e6, BASE)
    assert fast == Twist2(sign * MAX_SPEED_MPS, 0.0)
    spin = twist_of(-sign * 1e6, sign * 1e6, BASE)
    assert spin == Twist2(0.0, sign * MAX_TURN_RADPS)
    most = sign * MAX_SPEED_MPS / 0.2
    assert twist_of(most, most, BASE).v_mps == pytest.approx(sign * MAX_SPEED_MPS)


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
    out = saturate(Twist2(v, w), BASE, LIMITS, cap)
    if factor is None:
        assert out == STILL
    else:
        assert (out.v_mps, out.w_radps) == pytest.approx((v * factor, w * factor))


def test_lateral_acceleration_is_held_by_its_root() -> None:
    limits = LIMITS.model_copy(update={"max_lateral_mps2": 0.2})
    for v, w, factor in ((0.4, 0.5, 1.0), (0.4, 0.8, sqrt(0.2 / 0.32)), (-0.4, 0.8, sqrt(0.625))):
        out = saturate(Twist2(v, w), BASE, limits)
        assert (out.v_mps, out.w_radps) == pytest.approx((v * factor, w * factor))


def test_a_factor_of_one_changes_no_bit() -> None:
    odd = Twist2(0.1 + 0.2, 0.7)
    assert scale_twist(odd, 1.0) is odd
    assert scale_twist(Twist2(0.4, -0.2), 0.5) == Twist2(0.2, -0.1)


# Odometry --------------------------------------------------------------------------------------


def reading(left: float, right: float, *, speeds: tuple[float, float] = (0.0, 0.0)) -> DriveState:
    state = reached("active").state.drive.newest
    assert state is not None
    return state.model_copy(
        update={
            "left_rad": left, "right_rad": right,
            "left_radps": speeds[0], "right_radps": speeds[1],
        }
    )  # fmt: skip


@table("yaw", [0.0, 2.0, -3.1])
@table("turn", [1.0, -0.3, 2e-6, 1.9e-6, 0.0, 4.0])
@table("length", [0.5, -0.2])
def test_an_arc_ends_on_its_circle(length: float, turn: float, yaw: float) -> None:
    pose = Pose2(1.0, -2.0, yaw)
    x, y = 1.0 + length * cos(yaw + turn / 2), -2.0 + length * sin(yaw + turn / 2)
    if turn and abs(turn) > 0.1:
        radius = length / turn
        x = 1.0 + radius * (sin(yaw + turn) - sin(yaw))
        y = -2.0 - radius * (cos(yaw + turn) - cos(yaw))
    assert arc_end(pose, length, turn) == pytest.approx((x, y))
    there = along_arc(pose, length, turn)
    assert (there.x_m, there.y_m) == pytest.approx((x, y))
    assert cos(there.yaw_rad - yaw - turn) == pytest.approx(1.0)
    assert -pi <= there.yaw_rad <= pi


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
    after = advance(state, reading(left, right, speeds=(2.5, 0.5)), BASE, rezero=rezero)
    assert after.base_in_odom == roll(start, *rolls, 0.8) if any(rolls) else start
    assert (after.measured.v_mps, after.measured.w_radps) == pytest.approx((0.3, -0.5))
    assert after.travelled_m == pytest.approx(10.0 + abs(sum(rolls)) / 2)
    assert after.turned_rad == pytest.approx(20.0 + abs(rolls[1] - rolls[0]) / 0.8)
    assert after.jumps == 5 + jumps
    assert (after.left_rad, after.right_rad) == (None if left != left else left, right)


@table("had", [(None, 2.0), (1.0, None), (None, None)])
def test_without_a_zero_nothing_moves(had: tuple[float | None, float | None]) -> None:
    after = advance(OdometryState(Pose2(3, 4, 1), STILL, *had), reading(1.5, 2.5), BASE)
    assert after.base_in_odom == Pose2(3, 4, 1)
    assert (after.left_rad, after.right_rad, after.jumps) == (1.5, 2.5, 0)
    far = advance(OdometryState(), reading(1e9, -1e9 - 1.0), BASE)
    assert (far.left_rad, far.right_rad) == (1e9, None)


def test_what_is_metered_stays_a_number() -> None:
    full = OdometryState(STILL_POSE, STILL, 0.0, 0.0, 1e12, 1e12)
    after = advance(full, reading(-2.0, 4.0), BASE)
    assert (after.travelled_m, after.turned_rad) == (1e12, 1e12)


STILL_POSE = Pose2(0.0, 0.0, 0.0)


# Wheel control ---------------------------------------------------------------------------------


def told(
    wheel: Wheel, meant: float, seen: float | None = None, by: float = 0.0, dt_s: float = 0.01,
    *, trusted: bool = True, stopping: bool = False,
) -> Wheel:  # fmt: skip
    return control_wheel(wheel, meant, by, seen, dt_s, ROBOT, trusted=trusted, stopping=stopping)


ROLLING = Wheel(0.2, 0.3, 1.9, 1.8, 2.0, 0.0)
"""At a meant speed of 2 rad/s 0.5 rad/s may be added: a share of 1."""


@table("sign", [1.0, -1.0])
def test_a_wheel_is_told_what_its_motor_needs(sign: float) -> None:
    """Ahead by 0.05 s of 0.4 m/s2 at a wheel of 0.2 m: 0.1 rad/s; then the dead zone's."""
    plain = told(AT_REST, sign * 2.0, None, sign * 0.4)
    assert plain.told_radps == pytest.approx(sign * (2.0 + 0.1 + 0.1))
    assert plain.expected_radps == pytest.approx(sign * 2.1 / 6)  # 0.01 s of 0.05 + 0.01 s
    assert (plain.due_radps, plain.push, plain.integral) == (0.0, 0.0, 0.0)
    rolling = replace(
        ROLLING, expected_radps=sign * 1.9, due_radps=sign * 1.8, told_radps=sign * 2.0
    )
    seen = told(rolling, sign * 2.0, sign * 1.7, sign * 0.4)
    # 0.1 rad/s behind is 0.2 of the bound: 0.2 + 10 x 0.01 x 0.2 learnt, and half of 0.2
    assert seen.integral == pytest.approx(0.22)
    assert seen.push == pytest.approx(0.32)
    assert seen.told_radps == pytest.approx(sign * (2.2 + 0.32 * 0.5))
    assert seen.due_radps == sign * 1.9
    assert seen.expected_radps == pytest.approx(sign * (1.9 + 0.2 / 6))
    unseen = told(rolling, sign * 2.0, None, sign * 0.4)
    assert (unseen.integral, unseen.push) == (0.2, 0.3)
    assert unseen.told_radps == pytest.approx(sign * (2.2 + 0.15))
    doubted = told(rolling, sign * 2.0, sign * 1.7, sign * 0.4, trusted=False)
    assert (doubted.integral, doubted.push, doubted.doubt_s) == (0.0, 0.0, 0.0)
    assert doubted.told_radps == pytest.approx(sign * 2.2)
    # braking: only what pushes back counts, and no more than was told before
    slower = told(rolling, sign * 1.5, sign * 2.0, sign * -0.4, stopping=True)
    assert slower.integral == 0.0
    assert slower.push == pytest.approx(-0.5 * 0.2 / 0.4 - 0.05)
    assert slower.told_radps == pytest.approx(sign * (1.5 - 0.1 + 0.1 - 0.3 * 0.4))
    held = told(rolling, sign * 1.5, sign * 1.0, sign * 0.4, stopping=True)
    assert (held.integral, held.push) == (0.0, 0.0)
    assert held.told_radps == pytest.approx(sign * 1.6)
    again = told(rolling, sign * 2.0, sign * 1.7, stopping=True)
    assert again.told_radps == sign * 2.0


@table(("meant", "moves"), [(0.01, True), (-0.01, True), (0.0099, False), (-0.0099, False)])
def test_slower_than_a_creep_is_standing(meant: float, moves: bool) -> None:
    assert (told(ROLLING, meant) != AT_REST) is moves


def test_no_more_than_the_wheel_can_and_no_less_than_standing() -> None:
    fast = replace(ROLLING, told_radps=3.9, due_radps=3.9, expected_radps=3.9)
    assert told(fast, 3.95, 3.9).told_radps == 4.0
    assert told(fast, 3.95, None, 9.0).told_radps == 4.0
    assert told(fast, 3.95, None, 9.0).expected_radps == pytest.approx(3.9 + 0.1 / 6)
    slow = told(replace(ROLLING, push=-1.0), 0.05, None, -9.0)
    assert slow.told_radps == 0.0
    assert slow.expected_radps == pytest.approx(1.9 - 1.9 / 6)


def test_the_bound_is_a_share_of_speed_and_of_the_rim() -> None:
    # 0.1 and a fifth of 1 rad/s; beyond 2 rad/s 0.1 m/s at the rim, 0.5 rad/s
    for meant, bound in ((1.0, 0.3), (2.0, 0.5), (3.0, 0.5)):
        wheel = replace(ROLLING, integral=0.0, push=1.0)
        assert told(wheel, meant).told_radps == pytest.approx(meant + 0.1 + bound)


@table(
    ("before", "told_before", "begins"),
    [(0.5, 2.0, 1.9), (1.0, 0.0, 1.0), (-2.0, -2.0, -2.0), (4.0, 0.0, 4.0), (4.1, 0.0, 0.0),
     (-4.0, -1.0, -4.0), (-4.1, -1.0, 0.0), (nan, 0.0, 0.0)],
)  # fmt: skip
def test_a_wheel_that_stood_begins_with_what_it_turns(
    before: float, told_before: float, begins: float
) -> None:
    wheel = replace(ROLLING, told_radps=told_before)
    after = told(wheel, 2.0, before)
    assert after.due_radps == begins
    if told_before <= 0.0:
        assert told(wheel, 2.0, before, trusted=False).due_radps == 0.0
        assert told(wheel, 2.0, None).push == 0.0


@table(
    ("doubt_s", "off", "after"),
    [(0.05, 0.5, 0.0), (0.05, 0.5 + 1e-9, 0.06), (0.05, -0.5 - 1e-9, 0.06), (0.05, -0.5, 0.0),
     (0.05, nan, 0.06), (0.2, 0.0, 0.2), (0.3, 9.0, 0.3), (0.199, 0.0, 0.0)],
)  # fmt: skip
def test_doubt_grows_and_in_the_end_stays(doubt_s: float, off: float, after: float) -> None:
    assert wheel_control._doubt_s(doubt_s, off, 0.5, 0.01) == pytest.approx(after)


def test_what_is_too_far_off_for_too_long_is_not_corrected() -> None:
    # beyond 0.5 and 0.15 rad/s, 0.03 m/s at the rim
    for seen, doubt_s, believed in (
        (1.16, 0.195, True), (1.14, 0.195, False), (1.14, 0.185, True), (1.7, 0.2, False),
        (2.44, 0.195, True), (2.46, 0.195, False),
    ):  # fmt: skip
        after = told(replace(ROLLING, doubt_s=doubt_s), 2.0, seen)
        assert (after.push != 0.0) is believed, (seen, doubt_s)
        assert (after.integral != 0.0) is believed


def test_a_robot_that_nothing_may_correct_is_fed_forward() -> None:
    drive = ROBOT.drive.model_copy(update={"dead_zone_radps": 0.0, "max_correction": 0.0})
    bare = ROBOT.model_copy(update={"drive": drive})
    after = control_wheel(ROLLING, 2.0, 0.0, 1.0, 0.01, bare, trusted=True, stopping=False)
    assert (after.told_radps, after.push, after.integral) == (2.0, 0.0, 0.0)


# kp 0.5; in 0.01 s a share of 1 adds 0.1
@table(
    ("integral", "off", "spare", "grown", "whole"),
    [
        (0.2, 0.4, 9.0, 0.24, 0.44), (0.2, -0.4, 9.0, 0.16, -0.04), (-0.99, 0.4, 9.0, -0.95, -0.75),
        (0.5, 0.8, 9.0, 0.58, 0.98), (0.5, 0.9, 9.0, 0.5, 1.0), (-0.5, -0.92, 9.0, -0.5, -1.0),
        (0.95, 1.0, 9.0, 0.95, 1.0), (-0.95, -1.0, 9.0, -0.95, -1.0), (0.95, -4.0, 9.0, 0.95, -1.0),
        (0.2, 0.4, 0.45, 0.24, 0.44), (0.2, 0.4, 0.43, 0.2, 0.44), (0.2, -0.4, -0.5, 0.16, -0.04),
        (0.2, nan, 9.0, 0.2, -1.0), (0.2, inf, 9.0, 0.2, 1.0), (0.2, -inf, 9.0, 0.2, -1.0),
        (1.0, 0.0, 9.0, 1.0, 1.0), (-1.0, 0.0, 9.0, -1.0, -1.0), (1.0, 0.0, 0.5, 1.0, 1.0),
    ],
)  # fmt: skip
def test_the_correction_learns_no_further_than_it_may(
    integral: float, off: float, spare: float, grown: float, whole: float
) -> None:
    found = wheel_control._correct(integral, off, spare, 0.01, ROBOT.drive)
    assert found == pytest.approx((grown, whole))


def test_without_a_share_of_what_is_off_it_is_learnt_up_to_the_bound() -> None:
    bare = ROBOT.drive.model_copy(update={"kp": 0.0})
    for sign in (1.0, -1.0):
        found = wheel_control._correct(sign * 0.95, sign * 1.0, 9.0, 0.01, bare)
        assert found == (sign, sign)


@table(("meant", "learnt"), [(3.7, 0.2), (3.5, 0.24)])
def test_near_its_fastest_a_wheel_learns_no_more_than_it_can_use(
    meant: float, learnt: float
) -> None:
    # 0.44 of the 0.5 rad/s of the bound is asked; 4 rad/s less what is fed forward is left
    assert told(ROLLING, meant, 1.6).integral == pytest.approx(learnt)
