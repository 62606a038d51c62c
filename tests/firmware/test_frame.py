"""The firmware reads what the host writes and writes what the host reads, whatever lies between."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from devices.pons_mcu import HEAD, McuCommand, McuReader, encode_command
from tests.firmware.core import Core, Encoder

NUMBERS = st.integers(0, 2**32 - 1)
SPEEDS = st.integers(-1_000_000, 1_000_000)
COMMANDS = st.builds(
    McuCommand,
    seq=NUMBERS,
    boot=st.integers(1, 2**32 - 1),
    left_mradps=SPEEDS,
    right_mradps=SPEEDS,
    ticks_per_turn=st.integers(4, 1_000_000),
    ttl_ms=st.integers(50, 500),
    flags=st.integers(0, 255),
)
NOISE = st.one_of(
    st.binary(max_size=40),
    st.just(HEAD),
    COMMANDS.map(lambda command: encode_command(command)[:-1]),
    COMMANDS.map(lambda command: encode_command(command)[3:]),
)
SHARED = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])


@SHARED
@given(COMMANDS)
def test_each_command_of_the_host_is_understood(host_library: Path, command: McuCommand) -> None:
    core = Core(host_library)
    core.hear(encode_command(command), 1000)
    state = core.report(1000)
    assert (state.echo_boot, state.echo_seq) == (command.boot, command.seq)


@SHARED
@given(st.lists(NOISE, max_size=6), COMMANDS)
def test_noise_in_front_hides_no_command(
    host_library: Path, noise: list[bytes], command: McuCommand
) -> None:
    """Two of the same: the first may be eaten by a frame that noise began, as the host's may."""
    core = Core(host_library)
    stream = b"".join(noise) + encode_command(command) * 2
    core.hear(stream, 1000)
    state = core.report(1000)
    heard = [frame for frame in McuReader().read(stream) if isinstance(frame, McuCommand)]
    assert (state.echo_boot, state.echo_seq) == (heard[-1].boot, heard[-1].seq)
    assert heard[-1] == command


@SHARED
@given(COMMANDS, st.data())
def test_a_spoilt_command_is_none(
    host_library: Path, command: McuCommand, data: st.DataObject
) -> None:
    """The checksum finds each error of up to three bits."""
    frame = bytearray(encode_command(command))
    bits = data.draw(st.sets(st.integers(0, len(frame) * 8 - 1), min_size=1, max_size=3))
    for bit in bits:
        frame[bit // 8] ^= 1 << bit % 8
    core = Core(host_library)
    core.hear(bytes(frame), 1000)
    assert core.report(1000).echo_boot == 0


@SHARED
@given(COMMANDS, st.integers(0, 28))
def test_a_command_may_come_in_two_pieces(
    host_library: Path, command: McuCommand, cut: int
) -> None:
    frame = encode_command(command)
    core = Core(host_library)
    core.hear(frame[:cut], 1000)
    core.hear(frame[cut:], 9000)
    assert core.report(9000).echo_seq == command.seq


@SHARED
@given(NUMBERS, st.integers(-(2**31), 2**31 - 1), st.integers(0, 2**16 - 1))
def test_each_state_is_understood_by_the_host(
    host_library: Path, time_us: int, ticks: int, millivolts: int
) -> None:
    core = Core(host_library, boot=0xDEADBEEF)
    state = core.report(time_us, Encoder(ticks), Encoder(-ticks - 1), battery_mv=millivolts)
    assert (state.boot, state.time_us) == (0xDEADBEEF, time_us)
    assert (state.left_ticks, state.right_ticks, state.battery_mv) == (
        ticks,
        -ticks - 1,
        millivolts,
    )


@pytest.mark.parametrize("count", [1, 5])
def test_states_are_numbered_one_by_one(host_library: Path, count: int) -> None:
    core = Core(host_library)
    assert [core.report(0).seq for _ in range(count)] == list(range(1, count + 1))
