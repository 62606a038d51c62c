"""The firmware obeys and falls silent as its Python twin does, and trips where a wheel disobeys."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from devices import pons_mcu
from devices.pons_mcu import McuCommand, McuReader, McuState, encode_command
from sim.twin.pons_mcu import PonsMcuFirmware
from tests.firmware.core import Core, Encoder
from tests.known import known
from tests.wire.examples import EXAMPLES
from wire import DriveState
from wire.drive_config import DriveConfig

TICKS = 400
CONFIG = DriveConfig(kind="pons_mcu", port="/dev/x", ticks_per_turn=TICKS)
BODY = EXAMPLES[DriveState]
GO = McuCommand(7, 0xB1, 1500, -1500, TICKS, 200, pons_mcu.ENABLE)
SHARED = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
EVENTS = st.lists(
    st.tuples(
        st.integers(1, 300),  # ms since the last
        st.builds(
            McuCommand,
            seq=st.integers(0, 5),
            boot=st.sampled_from([0xB1, 0xB2]),
            left_mradps=st.just(1500),
            right_mradps=st.just(-1500),
            ticks_per_turn=st.just(TICKS),
            ttl_ms=st.sampled_from([0, 49, 50, 200, 500, 501, 65_535]),
            flags=st.sampled_from([0, pons_mcu.ENABLE]),
        ),
    ),
    max_size=12,
)


def twins_state(twin: PonsMcuFirmware, now_s: float) -> McuState:
    assert isinstance(BODY, DriveState)
    (state,) = McuReader().read(twin.say(BODY, now_s))
    assert isinstance(state, McuState)
    return state


@SHARED
@given(EVENTS)
def test_firmware_and_twin_obey_the_same_commands_for_the_same_time(
    host_library: Path, events: list[tuple[int, McuCommand]]
) -> None:
    core, twin = Core(host_library), PonsMcuFirmware(CONFIG, boot=0xF0)
    now_ms = 0
    for gap_ms, command in events:
        for later_ms in (1, 49, 50, 51, 200, 201):
            if later_ms < gap_ms:
                compare(core, twin, now_ms + later_ms)
        now_ms += gap_ms
        twin.hear(encode_command(command), now_ms / 1000)
        core.hear(encode_command(command), now_ms * 1000)
        compare(core, twin, now_ms)


def compare(core: Core, twin: PonsMcuFirmware, now_ms: int) -> None:
    """Compare half a millisecond later, where no rounding of seconds decides."""
    now_us = now_ms * 1000 + 500
    left, right, torque = twin.motors(now_us / 1e6)
    drives = core.control(now_us)
    theirs, ours = twins_state(twin, now_us / 1e6), core.report(now_us)
    assert drives.torque == torque
    assert bool(drives.left_duty) == bool(left)
    assert bool(drives.right_duty) == bool(right)
    assert (ours.echo_boot, ours.echo_seq) == (theirs.echo_boot, theirs.echo_seq)
    shared = pons_mcu.ENABLED | pons_mcu.TIMED_OUT
    assert ours.bits & shared == theirs.bits & shared


@SHARED
@given(st.integers(50, 500), st.integers(0, 2**32 - 1))
def test_torque_ends_with_the_time_to_live_wherever_the_clock_stands(
    host_library: Path, ttl_ms: int, began_us: int
) -> None:
    core = Core(host_library)
    core.hear(encode_command(replace(GO, ttl_ms=ttl_ms)), began_us)
    assert not core.is_silent((began_us + ttl_ms * 1000) % 2**32)
    assert core.control((began_us + ttl_ms * 1000) % 2**32).torque
    assert core.is_silent((began_us + ttl_ms * 1000 + 4) % 2**32)
    assert not core.control((began_us + ttl_ms * 1000 + 4) % 2**32).torque


def test_silence_is_remembered_when_the_clock_begins_anew(host_library: Path) -> None:
    """After 71 minutes the age of the last command looks young again."""
    core = Core(host_library)
    core.hear(encode_command(GO), 5000)
    assert core.is_silent(5000 + 300_000)
    assert core.is_silent(5000 + 2**32)
    assert not core.control(5000 + 2**32).torque


@pytest.mark.parametrize(
    "bad",
    [
        replace(GO, boot=0),
        replace(GO, ttl_ms=49),
        replace(GO, ttl_ms=501),
        replace(GO, ticks_per_turn=3),
        replace(GO, ticks_per_turn=1_000_001),
        replace(GO, left_mradps=1_000_001),
        replace(GO, right_mradps=-1_000_001),
    ],
)
def test_a_command_that_no_host_means_is_refused(host_library: Path, bad: McuCommand) -> None:
    core = Core(host_library)
    core.hear(encode_command(bad), 1000)
    assert not core.control(1000).torque
    assert core.report(1000).echo_boot == 0


def test_another_wheel_within_one_run_of_the_host_is_refused(host_library: Path) -> None:
    core = Core(host_library)
    core.hear(encode_command(GO), 1000)
    core.hear(encode_command(replace(GO, seq=8, ticks_per_turn=TICKS + 1)), 2000)
    assert core.report(2000).echo_seq == 7
    core.hear(encode_command(replace(GO, seq=1, boot=0xB2, ticks_per_turn=TICKS + 1)), 3000)
    assert core.report(3000).echo_boot == 0xB2


def test_a_pressed_stop_takes_the_torque_whatever_the_host_says(host_library: Path) -> None:
    core = Core(host_library)
    core.hear(encode_command(GO), 1000)
    assert not core.control(1000, stop_pressed=1).torque
    state = core.report(1000, stop_pressed=1)
    assert state.bits == pons_mcu.STOP_PRESSED
    assert core.control(2000).torque


def run_until_trip(core: Core, ticks_a_period: int, **pins: int) -> int | None:
    """Return after how many ms the torque went, keeping the command alive; None: never in 3 s."""
    for period in range(1, 601):
        now_us = period * 5000
        if period % 2:
            go = replace(GO, seq=period, left_mradps=15_000, right_mradps=-15_000)
            core.hear(encode_command(go), now_us)
        turned = Encoder(ticks_a_period * period, now_us)
        still = Encoder(-ticks_a_period * period, now_us)
        if not core.control(now_us, turned, still, **pins).torque:
            return period * 5
    return None


@pytest.mark.parametrize("ticks_a_period", [0, -1, -50])
def test_a_wheel_that_stands_or_turns_back_loses_the_torque(
    host_library: Path, ticks_a_period: int
) -> None:
    core = Core(host_library)
    after_ms = known(run_until_trip(core, ticks_a_period))
    assert after_ms <= 600
    assert core.report(after_ms * 1000).bits & pons_mcu.TRIPPED


def test_a_wheel_that_obeys_keeps_it(host_library: Path) -> None:
    assert run_until_trip(Core(host_library), 5) is None


def test_too_much_current_takes_the_torque(host_library: Path) -> None:
    assert run_until_trip(Core(host_library, most_ma=2000), 5, current_ma=2001) == 105
    assert run_until_trip(Core(host_library, most_ma=2000), 5, current_ma=2000) is None


def test_after_a_trip_the_host_must_take_the_torque_away_itself(host_library: Path) -> None:
    core = Core(host_library)
    after_ms = known(run_until_trip(core, 0))
    now_us = after_ms * 1000
    core.hear(encode_command(replace(GO, seq=10_000)), now_us)
    assert not core.control(now_us).torque
    core.hear(encode_command(replace(GO, seq=10_001, flags=0)), now_us)
    core.hear(encode_command(replace(GO, seq=10_002)), now_us)
    assert core.control(now_us).torque
