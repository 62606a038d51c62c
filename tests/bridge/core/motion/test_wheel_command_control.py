"""Hold the control of one wheel to its laws."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import copysign, inf, isfinite, nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.core.motion import wheel_command
from bridge.core.motion.wheel_command import CORRECTION_MPS, CREEP_RADPS, DOUBT_S, control_wheel
from bridge.core.state_motion import AT_REST, Wheel
from tests.bridge.core.table import table
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


def told(
    wheel: Wheel, meant: float, seen: float | None = None, by: float = 0.0, dt_s: float = 0.01,
    *, trusted: bool = True, stopping: bool = False,
) -> Wheel:  # fmt: skip
    return control_wheel(wheel, meant, by, seen, dt_s, CART, trusted=trusted, stopping=stopping)


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
    assert wheel_command._doubt_s(doubt_s, off, 0.5, 0.01) == pytest.approx(after)


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
    drive = CART.drive.model_copy(update={"dead_zone_radps": 0.0, "max_correction": 0.0})
    bare = CART.model_copy(update={"drive": drive})
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
        (1.0, 0.5, 9.0, 1.0, 1.0), (-1.0, -0.5, 9.0, -1.0, -1.0),
    ],
)  # fmt: skip
def test_the_correction_learns_no_further_than_it_may(
    integral: float, off: float, spare: float, grown: float, whole: float
) -> None:
    found = wheel_command._correct(integral, off, spare, 0.01, CART.drive)
    assert found == pytest.approx((grown, whole))


def test_without_a_share_of_what_is_off_it_is_learnt_up_to_the_bound() -> None:
    bare = CART.drive.model_copy(update={"kp": 0.0})
    for sign in (1.0, -1.0):
        found = wheel_command._correct(sign * 0.95, sign * 1.0, 9.0, 0.01, bare)
        assert found == (sign, sign)


@table(("meant", "learnt"), [(3.7, 0.2), (3.5, 0.24)])
def test_near_its_fastest_a_wheel_learns_no_more_than_it_can_use(
    meant: float, learnt: float
) -> None:
    # 0.44 of the 0.5 rad/s of the bound is asked; 4 rad/s less what is fed forward is left
    assert told(ROLLING, meant, 1.6).integral == pytest.approx(learnt)
