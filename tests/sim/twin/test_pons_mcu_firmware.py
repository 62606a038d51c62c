"""The firmware's own dead-man stops the wheels, and nothing old or odd keeps them turning."""

from __future__ import annotations

from dataclasses import replace
from typing import cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from devices import pons_mcu
from devices.pons_mcu import McuCommand, McuReader, McuState, encode_command
from sim.twin.pons_mcu import PonsMcuFirmware
from tests.wire.examples import EXAMPLES
from wire import DriveState
from wire.drive_config import DriveConfig

CONFIG = DriveConfig(kind="pons_mcu", port="/dev/x", ticks_per_turn=400)
BODY = cast("DriveState", EXAMPLES[DriveState])
GO = McuCommand(7, 0xB1, 1500, -1500, 400, 200, pons_mcu.ENABLE)
STILL = (0.0, 0.0, False)


def firmware(boot: int = 0xF0) -> PonsMcuFirmware:
    return PonsMcuFirmware(CONFIG, boot)


def told(given: PonsMcuFirmware, command: McuCommand, now_s: float) -> tuple[float, float, bool]:
    given.hear(encode_command(command), now_s)
    return given.motors(now_s)


def said(given: PonsMcuFirmware, now_s: float, body: DriveState | None = None) -> McuState:
    (state,) = McuReader().read(given.say(body or BODY, now_s))
    assert isinstance(state, McuState)
    return state


def test_before_the_first_command_it_stands_timed_out() -> None:
    new = firmware()
    assert new.motors(0.0) == STILL
    state = said(new, 0.0)
    assert state.bits & pons_mcu.TIMED_OUT
    assert (state.echo_boot, state.echo_seq) == (0, 0)


@given(st.integers(50, 500), st.floats(0.0, 2.0))
def test_it_drives_for_the_time_to_live_and_no_longer(ttl_ms: int, age_s: float) -> None:
    new = firmware()
    told(new, replace(GO, ttl_ms=ttl_ms), 1.0)
    alive = (1.0 + age_s) - 1.0 <= ttl_ms / 1000
    assert new.motors(1.0 + age_s) == ((1.5, -1.5, True) if alive else STILL)
    state = said(new, 1.0 + age_s)
    assert bool(state.bits & pons_mcu.TIMED_OUT) is not alive
    assert bool(state.bits & pons_mcu.ENABLED) is alive


@pytest.mark.parametrize("ttl_ms", [0, 1, 49, 501, 65_535])
def test_a_time_to_live_that_is_none_is_refused(ttl_ms: int) -> None:
    assert told(firmware(), replace(GO, ttl_ms=ttl_ms), 1.0) == STILL


def test_ticks_of_another_wheel_are_refused() -> None:
    """Its speeds would be of another wheel too."""
    assert told(firmware(), replace(GO, ticks_per_turn=401), 1.0) == STILL


@given(st.integers(0, 7))
def test_an_old_command_keeps_no_wheel_turning(seq: int) -> None:
    new = firmware()
    told(new, GO, 1.0)
    told(new, replace(GO, seq=seq), 1.19)
    assert new.motors(1.21) == STILL


def test_another_boot_is_heard_whatever_its_number() -> None:
    new = firmware()
    told(new, GO, 1.0)
    assert told(new, replace(GO, boot=0xB2, seq=1, left_mradps=100), 1.1)[0] == 0.1
    assert said(new, 1.1).echo_boot == 0xB2


def test_without_enable_there_is_no_torque() -> None:
    new = firmware()
    assert told(new, replace(GO, flags=0), 1.0) == STILL
    assert not said(new, 1.0).bits & (pons_mcu.ENABLED | pons_mcu.TIMED_OUT)


def test_a_clock_that_goes_back_is_no_sign_of_life() -> None:
    new = firmware()
    told(new, GO, 5.0)
    assert new.motors(4.9) == STILL


def test_it_counts_from_its_start_and_wraps() -> None:
    new = firmware()
    at_start = BODY.model_copy(update={"left_rad": 3.0, "right_rad": -3.0})
    assert said(new, 0.0, at_start).left_ticks == 0
    turned = BODY.model_copy(update={"left_rad": 3.0 + 6.2831854, "right_rad": -3.0 - 3.1415926})
    state = said(new, 0.1, turned)
    assert (state.left_ticks, state.right_ticks) == (400, -200)
    far = BODY.model_copy(update={"left_rad": 4e7})
    assert -(2**31) <= said(new, 0.2, far).left_ticks < 2**31


def test_pressed_inputs_and_the_battery_are_told() -> None:
    body = BODY.model_copy(
        update={
            "estop_pressed": True,
            "bumper_front": True,
            "bumper_rear": True,
            "cliff": True,
            "battery": 0.5,
        }
    )
    state = said(firmware(), 0.0, body)
    assert state.bits == (
        pons_mcu.TIMED_OUT
        | pons_mcu.STOP_PRESSED
        | pons_mcu.BUMPER_FRONT
        | pons_mcu.BUMPER_REAR
        | pons_mcu.CLIFF
    )
    assert state.battery_mv == 11_100
    no_news = BODY.model_copy(update={"battery": None})
    assert said(firmware(), 0.0, no_news).battery_mv == pons_mcu.NOT_MEASURED


def test_a_reset_controller_has_another_boot_and_forgets_the_command() -> None:
    one, other = PonsMcuFirmware(CONFIG), PonsMcuFirmware(CONFIG)
    told(one, GO, 1.0)
    assert said(one, 1.0).boot != said(other, 1.0).boot
    assert other.motors(1.0) == STILL
