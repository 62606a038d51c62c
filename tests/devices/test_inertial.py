"""A gyro is turned into the robot's axes, and what it says standing is taken away, no more."""

from __future__ import annotations

from itertools import product
from math import nan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from devices.inertial import MOST_RADPS, Mounting, StandingBias

AXES = [sign + name for sign, name in product(("", "-"), "xyz")]
PAIRS = [(up, forward) for up, forward in product(AXES, AXES) if up[-1] != forward[-1]]


@pytest.mark.parametrize(("up", "forward"), PAIRS)
def test_any_mounting_is_a_rotation_that_puts_its_axes_where_they_belong(
    up: str, forward: str
) -> None:
    mounting = Mounting(up, forward)
    units = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)]
    x, y, z = (mounting.turn(unit) for unit in units)  # columns of the matrix
    volume = sum(
        a * (b * c - d * e)
        for a, b, c, d, e in (
            (x[0], y[1], z[2], y[2], z[1]), (x[1], y[2], z[0], y[0], z[2]),
            (x[2], y[0], z[1], y[1], z[0]),
        )
    )  # fmt: skip
    assert volume == 1.0, "a mirrored robot turns the other way"
    sign = -1.0 if up.startswith("-") else 1.0
    x_, y_, z_ = units["xyz".index(up[-1])]
    assert mounting.turn((sign * x_, sign * y_, sign * z_)) == (0.0, 0.0, 1.0)


def test_two_ends_of_one_axis_are_no_mounting() -> None:
    with pytest.raises(ValueError, match="one axis"):
        Mounting("z", "-z")


def rest(bias: StandingBias, rate: float, seconds: float, start: float = 0.0) -> list[float | None]:
    count = round(seconds * 20)
    return [bias.correct(rate, start + k / 20, stands=True) for k in range(count)]


def test_nothing_is_told_before_the_bias_is_known() -> None:
    bias = StandingBias(is_sure_of_standing=True)
    told = rest(bias, 0.2, 2.0)
    assert told[:20] == [None] * 20
    assert told[20:] == pytest.approx([0.0] * 20)
    assert bias.correct(0.7, 2.05, stands=False) == pytest.approx(0.5)


@pytest.mark.parametrize("rate", [MOST_RADPS + 0.01, -1.0, nan])
def test_what_no_standing_gyro_says_is_no_bias(rate: float) -> None:
    bias = StandingBias(is_sure_of_standing=True)
    assert rest(bias, rate, 5.0) == [None] * 100


def test_a_hand_that_turns_it_is_no_bias() -> None:
    bias = StandingBias(is_sure_of_standing=True)
    for k in range(100):
        assert bias.correct(0.1 if k % 4 else 0.2, k / 20, stands=True) is None


def test_a_moving_robot_teaches_nothing() -> None:
    bias = StandingBias(is_sure_of_standing=True)
    for k in range(100):
        assert bias.correct(0.1, k / 20, stands=False) is None


def test_silences_between_readings_are_no_standstill() -> None:
    bias = StandingBias(is_sure_of_standing=True)
    for k in range(100):
        assert bias.correct(0.1, k * 0.3, stands=True) is None
    assert bias.correct(0.1, 0.0, stands=True) is None, "nor is a clock that went back"


def test_it_creeps_along_with_the_temperature() -> None:
    bias = StandingBias(is_sure_of_standing=False)
    for k in range(40):
        rest(bias, 0.002 * k, 1.1, start=10.0 * k)
    assert bias.bias_radps == pytest.approx(0.078, abs=0.01)


@pytest.mark.parametrize("sure", [True, False])
def test_only_wheels_that_stand_unlearn_a_turn_that_was_taken_for_a_bias(sure: bool) -> None:
    bias = StandingBias(is_sure_of_standing=sure)
    rest(bias, 0.2, 1.1)
    rest(bias, 0.01, 8.0, start=10.0)
    assert bias.bias_radps == pytest.approx(0.01 if sure else 0.2)


@given(st.lists(st.tuples(st.floats(-50, 50), st.booleans()), max_size=200))
def test_a_bias_is_never_more_than_a_gyro_may_say(said: list[tuple[float, bool]]) -> None:
    bias = StandingBias(is_sure_of_standing=True)
    for k, (rate, stands) in enumerate(said):
        bias.correct(rate, k / 20, stands=stands)
        assert bias.bias_radps is None or abs(bias.bias_radps) <= MOST_RADPS
