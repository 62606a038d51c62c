"""A wheel reaches the speed that it is told, is measured truly, and is never driven beyond full."""

from __future__ import annotations

from math import tau
from pathlib import Path

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from devices import pons_mcu
from devices.pons_mcu import McuCommand, encode_command
from tests.firmware.core import Core, Encoder

SHARED = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=12)
"""Each example drives for seconds."""
PERIOD_S = 0.005


class Wheel:
    """A motor whose speed follows its duty with a lag, and an encoder on it."""

    def __init__(self, free_radps: float, lag_s: float, ticks_per_turn: int) -> None:
        self.free_radps = free_radps
        self.lag_s = lag_s
        self.ticks_per_turn = ticks_per_turn
        self.radps = 0.0
        self.angle_rad = 0.0
        self.encoder = Encoder()

    def turn(self, duty: int, began_s: float) -> None:
        """Turn for one period."""
        steps = 10
        for step in range(steps):
            dt_s = PERIOD_S / steps
            self.radps += (duty / 1000 * self.free_radps - self.radps) * dt_s / self.lag_s
            self.angle_rad += self.radps * dt_s
            ticks = int(self.angle_rad / tau * self.ticks_per_turn // 1)
            if ticks != self.encoder.ticks:
                edge_us = round((began_s + (step + 1) * dt_s) * 1e6) // 4 * 4
                self.encoder = Encoder(ticks, edge_us)


def drive(
    core: Core, wheel: Wheel, target_radps: float, seconds: float
) -> list[tuple[float, int, int]]:
    """Hold a target; return true speed, reported speed [mrad/s] and duty of each period."""
    seen = []
    for period in range(1, round(seconds / PERIOD_S) + 1):
        now_s = period * PERIOD_S
        now_us = round(now_s * 1e6)
        mradps = round(target_radps * 1000)
        command = McuCommand(period, 1, mradps, mradps, wheel.ticks_per_turn, 200, pons_mcu.ENABLE)
        core.hear(encode_command(command), now_us)
        got = core.control(now_us, wheel.encoder, wheel.encoder)
        seen.append((wheel.radps, core.report(now_us).left_mradps, got.left_duty))
        wheel.turn(got.left_duty, now_s)
    return seen


@SHARED
@given(
    st.floats(-12.0, 12.0),
    st.floats(16.0, 26.0),
    st.floats(0.03, 0.1),
    st.integers(200, 4096),
)
def test_it_reaches_the_speed_that_it_is_told(
    host_library: Path, target_radps: float, free_radps: float, lag_s: float, ticks_per_turn: int
) -> None:
    """Though the motor is a fifth weaker or a third stronger than config.h says."""
    seen = drive(Core(host_library), Wheel(free_radps, lag_s, ticks_per_turn), target_radps, 3.0)
    settled = [speed for speed, _, _ in seen[-100:]]
    mean = sum(settled) / len(settled)
    assert abs(mean - target_radps) <= 0.03 * abs(target_radps) + tau / ticks_per_turn * 4
    assert all(abs(duty) <= 1000 for _, _, duty in seen)


@SHARED
@given(st.floats(0.5, 15.0), st.integers(200, 4096))
def test_the_reported_speed_is_the_true_one(
    host_library: Path, target_radps: float, ticks_per_turn: int
) -> None:
    seen = drive(Core(host_library), Wheel(20.0, 0.05, ticks_per_turn), target_radps, 2.0)
    true = sum(speed for speed, _, _ in seen[-100:]) / 100
    said = sum(speed for _, speed, _ in seen[-100:]) / 100 / 1000
    assert abs(said - true) <= 0.03 * true + 0.05


def test_a_wheel_that_stopped_is_soon_said_to_stand(host_library: Path) -> None:
    core = Core(host_library)
    wheel = Wheel(20.0, 0.05, 1000)
    drive(core, wheel, 5.0, 1.0)
    core.control(1_010_000, wheel.encoder, wheel.encoder)
    assert core.report(1_010_000).left_mradps > 4000
    core.control(1_260_000, wheel.encoder, wheel.encoder)
    assert core.report(1_260_000).left_mradps == 0


def test_an_order_beyond_the_motor_is_held_to_what_it_can(host_library: Path) -> None:
    seen = drive(Core(host_library), Wheel(20.0, 0.05, 1000), 900.0, 1.0)
    assert max(duty for _, _, duty in seen) == 1000
