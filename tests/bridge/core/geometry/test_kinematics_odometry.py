"""Hold the motion of the robot to what its wheels turned."""

from __future__ import annotations

from math import cos, inf, isfinite, nan, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from bridge.core.geometry.kinematics import OdometryState, advance, along_arc, arc_end, roll
from tests.bridge.core.reached import reached
from tests.bridge.core.table import table
from wire import IDENTITY, STILL, DriveState, Pose2, RobotDescription
from wire.geometry import MAX_COORDINATE_M
from wire.robot import Base

BASE = Base(wheel_radius_m=1.0, wheel_separation_m=1.0)


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
        state = advance(state, reading_of(left, right, speed=speed), BASE)
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


@table("had", [(None, 2.0), (1.0, None), (None, None)])
def test_without_a_zero_nothing_moves(had: tuple[float | None, float | None]) -> None:
    after = advance(OdometryState(Pose2(3, 4, 1), STILL, *had), reading(1.5, 2.5), FRAME)
    assert after.base_in_odom == Pose2(3, 4, 1)
    assert (after.left_rad, after.right_rad, after.jumps) == (1.5, 2.5, 0)
    far = advance(OdometryState(), reading(1e9, -1e9 - 1.0), FRAME)
    assert (far.left_rad, far.right_rad) == (1e9, None)


def test_what_is_metered_stays_a_number() -> None:
    full = OdometryState(STILL_POSE, STILL, 0.0, 0.0, 1e12, 1e12)
    after = advance(full, reading(-2.0, 4.0), FRAME)
    assert (after.travelled_m, after.turned_rad) == (1e12, 1e12)


STILL_POSE = Pose2(0.0, 0.0, 0.0)
