"""Hold the control of one wheel to numbers worked out by hand."""

from __future__ import annotations

from dataclasses import replace
from math import inf, nan

import pytest

from bridge.core.motion import wheel_command
from bridge.core.motion.wheel_command import control_wheel
from bridge.core.state_motion import AT_REST, Wheel
from tests.bridge.core import scripted
from tests.bridge.core.table import table
from wire import RobotDescription

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
    found = wheel_command._correct(integral, off, spare, 0.01, ROBOT.drive)
    assert found == pytest.approx((grown, whole))


def test_without_a_share_of_what_is_off_it_is_learnt_up_to_the_bound() -> None:
    bare = ROBOT.drive.model_copy(update={"kp": 0.0})
    for sign in (1.0, -1.0):
        found = wheel_command._correct(sign * 0.95, sign * 1.0, 9.0, 0.01, bare)
        assert found == (sign, sign)


@table(("meant", "learnt"), [(3.7, 0.2), (3.5, 0.24)])
def test_near_its_fastest_a_wheel_learns_no_more_than_it_can_use(
    meant: float, learnt: float
) -> None:
    # 0.44 of the 0.5 rad/s of the bound is asked; 4 rad/s less what is fed forward is left
    assert told(ROLLING, meant, 1.6).integral == pytest.approx(learnt)


@table(
    ("integral", "off", "spare", "expected"),
    [
        (1.0, 0.5, 2.0, (1.0, 1.0)),
        (-1.0, -0.5, 2.0, (-1.0, -1.0)),
        (0.5, nan, 2.0, (0.5, -1.0)),
        (0.5, 99.0, 2.0, (0.5, 1.0)),
        (0.5, -99.0, 2.0, (0.5, -1.0)),
    ],
)
def test_a_correction_ends_at_its_bound_and_what_is_no_number_brakes(
    integral: float, off: float, spare: float, expected: tuple[float, float]
) -> None:
    drive = scripted.ROBOT.drive
    found = wheel_command._correct(integral, off, spare, 0.01, drive)
    assert found == pytest.approx(expected)
