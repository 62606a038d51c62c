"""Hold the control of one wheel to its laws."""

from __future__ import annotations

from itertools import pairwise
from math import copysign, isfinite

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.motion.wheel_command import CORRECTION_MPS, CREEP_RADPS, DOUBT_S, control_wheel
from bridge.core.state_motion import AT_REST, Wheel
from wire import RobotDescription
from wire.drive_config import DriveConfig
from wire.robot import Limits

ROBOT = RobotDescription()

DT_S = 0.01

MOST = ROBOT.limits.max_wheel_radps

EPS = 1e-9

meant_speeds = st.floats(-MOST, MOST)

accelerations = st.floats(-5.0, 5.0)

readings = st.none() | st.floats(allow_nan=True, allow_infinity=True) | st.floats(-12.0, 12.0)

shares = st.floats(-1.0, 1.0)

speeds = st.floats(-MOST, MOST)

wheels = st.builds(Wheel, shares, shares, speeds, speeds, speeds)


gains = st.builds(
    DriveConfig,
    lag_s=st.floats(0.005, 0.5),
    dead_zone_radps=st.floats(0.0, 2.0),
    response_s=st.floats(0.0, 0.5),
    kp=st.floats(0.0, 2.0),
    ki_per_s=st.floats(0.0, 40.0),
    max_correction=st.floats(0.0, 0.3),
)


robots = gains.map(lambda drive: RobotDescription(drive=drive))

flags = st.booleans()


def step(
    wheel: Wheel,
    meant: float,
    reading: float | None,
    *,
    by: float = 0.0,
    robot: RobotDescription = ROBOT,
    trusted: bool = True,
    stopping: bool = False,
) -> Wheel:
    return control_wheel(wheel, meant, by, reading, DT_S, robot, trusted=trusted, stopping=stopping)


def bound_of(meant: float, robot: RobotDescription) -> float:
    share = robot.drive.max_correction * abs(meant)
    most = CORRECTION_MPS / robot.base.wheel_radius_m
    return min(robot.drive.dead_zone_radps + share, most)


def motor(told: float, speed: float, *, gain: float = 1.0, swallowed: float = 0.05) -> float:
    """Turn as a first-order motor of 0.05 s would after one more tick."""
    wish = copysign(gain * max(0.0, abs(told) - swallowed), told)
    return speed + (wish - speed) * DT_S / (0.05 + DT_S)


def run(
    meant: float, seconds: float, robot: RobotDescription = ROBOT, gain: float = 1.0,
    swallowed: float = 0.05,
) -> tuple[Wheel, float]:  # fmt: skip
    """Let the control and a motor work together; the motor is one tick late."""
    wheel, speed, told = AT_REST, 0.0, 0.0
    for _ in range(round(seconds / DT_S)):
        speed = motor(told, speed, gain=gain, swallowed=swallowed)
        told = wheel.told_radps
        wheel = step(wheel, meant, speed, robot=robot)
    return wheel, speed


@given(wheels, meant_speeds, accelerations, readings, robots, flags, flags)
def test_what_is_told_keeps_sign_and_limits(
    wheel: Wheel, meant: float, by: float, reading: float | None, robot: RobotDescription,
    trusted: bool, stopping: bool,
) -> None:  # fmt: skip
    after = step(wheel, meant, reading, by=by, robot=robot, trusted=trusted, stopping=stopping)
    assert abs(after.told_radps) <= robot.limits.max_wheel_radps
    assert after.told_radps * meant >= 0.0
    assert -1.0 <= after.integral <= 1.0
    assert -1.0 <= after.push <= 1.0
    assert isfinite(after.expected_radps)


@given(wheels, st.floats(-CREEP_RADPS, CREEP_RADPS, exclude_min=True, exclude_max=True), readings)
def test_zero_meant_is_zero_told_and_forgets_everything(
    wheel: Wheel, meant: float, reading: float | None
) -> None:
    assert step(wheel, meant, reading) == AT_REST


@given(wheels, readings)
def test_what_is_no_number_stands(wheel: Wheel, reading: float | None) -> None:
    assert step(wheel, float("nan"), reading) == AT_REST


@given(wheels, meant_speeds, accelerations, readings, robots)
def test_the_correction_is_bounded(
    wheel: Wheel, meant: float, by: float, reading: float | None, robot: RobotDescription
) -> None:
    free = robot.model_copy(update={"limits": Limits(max_wheel_radps=100.0)})
    plain = step(wheel, meant, None, by=by, robot=free, trusted=False)
    after = step(wheel, meant, reading, by=by, robot=free)
    assert abs(after.told_radps - plain.told_radps) <= bound_of(meant, free) + EPS
    assert bound_of(meant, free) * free.base.wheel_radius_m <= CORRECTION_MPS + EPS


@given(wheels, meant_speeds, st.floats(0.0, 5.0), readings, robots, flags)
def test_while_stopping_it_may_only_brake(
    wheel: Wheel, meant: float, braking: float, reading: float | None, robot: RobotDescription,
    trusted: bool,
) -> None:  # fmt: skip
    by = -copysign(braking, meant)
    after = step(wheel, meant, reading, by=by, robot=robot, trusted=trusted, stopping=True)
    assert abs(after.told_radps) <= abs(meant) + robot.drive.dead_zone_radps + EPS
    assert abs(after.told_radps) <= abs(wheel.told_radps)
    assert after.integral == 0.0
    assert after.push <= 0.0


@given(wheels, meant_speeds, accelerations, readings, flags)
def test_without_feedback_there_is_no_correction(
    wheel: Wheel, meant: float, by: float, reading: float | None, stopping: bool
) -> None:
    after = step(wheel, meant, reading, by=by, trusted=False, stopping=stopping)
    assert (after.integral, after.push) == (0.0, 0.0)


@given(st.lists(st.tuples(meant_speeds, readings, flags), min_size=5, max_size=60))
def test_no_sequence_of_readings_makes_power_at_standstill(
    script: list[tuple[float, float | None, bool]],
) -> None:
    wheel = AT_REST
    for meant, reading, stopping in script:
        wheel = step(wheel, meant, reading, stopping=stopping)
    for reading in (9.0, -9.0, None, float("inf")):
        wheel = step(wheel, 0.0, reading)
        assert wheel == AT_REST


@given(st.floats(0.5, 6.0), st.lists(readings, min_size=20, max_size=20))
def test_a_stop_only_falls_whatever_the_encoder_says(
    start: float, said: list[float | None]
) -> None:
    wheel, _ = run(start, 0.5, gain=0.9)
    told, meant = [wheel.told_radps], start
    for reading in said:
        meant = max(0.0, meant - start / 20)
        wheel = step(wheel, meant, reading, by=-1.0, stopping=True)
        told.append(wheel.told_radps)
    assert all(later <= earlier for earlier, later in pairwise(told))
    assert told[-1] == 0.0


@pytest.mark.parametrize("gain", [0.85, 1.0, 1.15])
@pytest.mark.parametrize("swallowed", [0.0, 0.05, 0.1])
@pytest.mark.parametrize("meant", [0.6, 5.0, -3.0])
def test_a_motor_that_is_otherwise_turns_as_meant(
    gain: float, swallowed: float, meant: float
) -> None:
    _, speed = run(meant, 1.5, gain=gain, swallowed=swallowed)
    assert speed == pytest.approx(meant, abs=0.03)


@pytest.mark.parametrize("reading", [0.0, -3.0, 9.0])
def test_what_no_motor_explains_is_not_believed_until_the_wheel_stands(reading: float) -> None:
    wheel, _ = run(3.0, 1.0)
    told = [wheel.told_radps]
    for _ in range(30):
        wheel = step(wheel, 3.0, reading)
        told.append(wheel.told_radps)
    assert max(told) <= 3.05 + bound_of(3.0, ROBOT) + EPS
    assert told[-1] == pytest.approx(3.05)
    wheel = step(wheel, 3.0, 3.0)
    assert wheel.push == 0.0
    assert wheel.doubt_s == pytest.approx(DOUBT_S)
    again = step(step(wheel, 0.0, 0.0), 1.0, 0.0)
    assert step(again, 1.0, 0.9).push != 0.0
