"""A motor that is made up is found again."""

from __future__ import annotations

from math import copysign, exp

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pons.calibrate.errors import RunLost
from pons.calibrate.motor import braking_radps2, fit_motor, plateau, statics
from pons.calibrate.track import TICK_S, TrackTick


def made_up(
    told: list[float], *, gain: float = 1.0, dead: float = 0.05, lag_s: float = 0.06, delay: int = 0
) -> list[TrackTick]:
    """Run a first-order motor in small steps; the encoder gives the mean over each tick."""
    ticks, speed, parts = [], 0.0, 10
    keep = exp(-TICK_S / parts / lag_s)
    for seq, _ in enumerate(told):
        wish = told[max(0, seq - delay)]
        wish = copysign(gain * max(0.0, abs(wish) - dead), wish)
        mean = 0.0
        for _ in range(parts):
            before = speed
            speed = wish + (speed - wish) * keep
            mean += (before + speed) / 2 / parts
        ticks.append(TrackTick(seq, (told[seq], told[seq]), (mean, mean)))
    return ticks


def drive(top: float = 3.5) -> list[float]:
    """Creep, speed up, stop."""
    ramp = [0.6 + 0.05 * n for n in range(round((top - 0.6) / 0.05))]
    stop = [max(0.0, top - 0.1 * n) for n in range(60)]
    return [0.6] * 200 + ramp + [top] * 100 + stop


@settings(max_examples=15, deadline=None)
@given(
    st.floats(0.8, 1.2),
    st.floats(0.0, 0.3),
    st.floats(0.02, 0.15),
    st.integers(0, 2),
    st.booleans(),
)
def test_dead_zone_gain_and_lag_are_found(
    gain: float, dead: float, lag_s: float, delay: int, forward: bool
) -> None:
    told = [speed if forward else -speed for speed in drive()]
    ticks = made_up(told, gain=gain, dead=dead, lag_s=lag_s, delay=delay)
    end = 200 + 58
    found = statics(plateau(ticks, 0, 150, 200), plateau(ticks, 0, end + 60, end + 99))
    assert found[0] == pytest.approx(dead, abs=0.03)
    assert found[1] == pytest.approx(gain, rel=0.01)
    motor = fit_motor(ticks, 0, dead, gain)
    assert motor.lag_s + motor.delay_s == pytest.approx(lag_s + delay * TICK_S, abs=0.004)
    assert motor.lag_s == pytest.approx(lag_s, abs=0.012)


def test_ticks_that_were_not_heard_are_left_out() -> None:
    ticks = made_up(drive())
    holed = [
        tick if tick.seq % 3 else TrackTick(tick.seq, tick.told, None) for tick in ticks
    ]  # fmt: skip
    assert fit_motor(holed, 1, 0.05, 1.0).lag_s == pytest.approx(0.06, abs=0.004)


def test_a_wheel_that_does_not_turn_is_a_fault() -> None:
    with pytest.raises(RunLost) as lost:
        statics((0.6, 0.0), (3.5, 0.0))
    assert lost.value.code == "encoder_fault"
    with pytest.raises(RunLost) as lost:
        statics((0.6, -0.6), (3.5, -3.4))
    assert lost.value.code == "encoder_fault"


def test_too_short_a_plateau_is_a_lost_run() -> None:
    with pytest.raises(RunLost, match="2 ticks"):
        plateau(made_up(drive()), 0, 10, 12)


def test_braking_is_the_slope_of_the_weaker_wheel() -> None:
    ticks = [
        TrackTick(n, (0.0, 0.0), (max(0.0, 3.5 - 0.1 * n), max(0.0, 3.5 - 0.08 * n)))
        for n in range(60)
    ]
    assert braking_radps2(ticks, 0) == pytest.approx(8.0, rel=0.01)
    with pytest.raises(RunLost, match="even braking"):
        braking_radps2(ticks[:4], 0)
