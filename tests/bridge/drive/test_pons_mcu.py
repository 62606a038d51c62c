"""What the controller says becomes a state of the wire, and a command its bytes."""

from __future__ import annotations

from binascii import crc_hqx
from dataclasses import replace
from math import pi
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.drive.pons_mcu import PonsMcuProtocol
from devices import pons_mcu
from devices.pons_mcu import McuCommand, McuReader, McuState, encode_command, encode_state
from wire import DriveCommand, DriveState
from wire.drive_config import DriveConfig

CONFIG = DriveConfig(kind="pons_mcu", port="/dev/x", ticks_per_turn=4096, timeout_s=0.2)
STATE = McuState(1, 0xAB, 0, 0, 1_000_000, 0, 0, 0, 0, 0xFFFF, 0xFFFF, 0)
SPEEDS = st.floats(-1000.0, 1000.0)


def command(**given: object) -> DriveCommand:
    made = DriveCommand(boot="b1", seq=7, left_radps=1.25, right_radps=-0.5, enable=True)
    return made.model_copy(update=given)


def frame(kind: int, seq: int, payload: bytes) -> bytes:
    """Return a frame that checks, whatever its type and length."""
    body = bytes([len(payload), kind]) + seq.to_bytes(4, "little") + payload
    return pons_mcu.HEAD + body + crc_hqx(body, 0).to_bytes(2, "little")


def heard(protocol: PonsMcuProtocol, *states: McuState, now_s: float = 10.0) -> list[DriveState]:
    return protocol.decode(b"".join(map(encode_state, states)), now_s)


def sent(protocol: PonsMcuProtocol, given: DriveCommand) -> McuCommand:
    (frame,) = McuReader().read(protocol.encode(given))
    assert isinstance(frame, McuCommand)
    return frame


@given(SPEEDS, SPEEDS, st.booleans(), st.integers(0, 2**40))
def test_a_command_is_rounded_to_a_thousandth_and_carries_all(
    left_radps: float, right_radps: float, enable: bool, seq: int
) -> None:
    frame = sent(
        PonsMcuProtocol(CONFIG, "b1"),
        command(left_radps=left_radps, right_radps=right_radps, enable=enable, seq=seq),
    )
    assert frame.left_mradps / 1000 == pytest.approx(left_radps, abs=0.0005)
    assert frame.right_mradps / 1000 == pytest.approx(right_radps, abs=0.0005)
    assert (frame.ttl_ms, frame.ticks_per_turn, frame.seq) == (200, 4096, seq % 2**32)
    assert bool(frame.flags & pons_mcu.ENABLE) is enable
    assert frame.boot != 0


def test_the_echo_names_this_bridge_another_or_none() -> None:
    protocol = PonsMcuProtocol(CONFIG, "b1")
    number = sent(protocol, command()).boot
    ours, none, other = heard(
        protocol,
        replace(STATE, echo_boot=number, echo_seq=7),
        replace(STATE, seq=2),
        replace(STATE, seq=3, echo_boot=(number % 0xFFFF_FFFE) + 1, echo_seq=9),
    )
    assert (ours.echo_boot, ours.echo_seq) == ("b1", 7)
    assert none.echo_boot is None
    assert other.echo_boot not in {None, "b1"}


def test_ticks_become_angles_and_go_on_past_their_wrap() -> None:
    top = 2**31 - 1
    states = heard(
        PonsMcuProtocol(CONFIG, "b1"),
        replace(STATE, left_ticks=1024, right_ticks=top),
        replace(STATE, seq=2, left_ticks=-1024, right_ticks=-(2**31) + 1023),
    )
    assert [state.left_rad for state in states] == pytest.approx([pi / 2, -pi / 2])
    assert states[1].right_rad - states[0].right_rad == pytest.approx(pi / 2)


def test_another_boot_counts_from_its_own_start() -> None:
    protocol = PonsMcuProtocol(CONFIG, "b1")
    before, after = heard(
        protocol,
        replace(STATE, left_ticks=2**31 - 1),
        replace(STATE, boot=0xCD, left_ticks=-(2**31), time_us=5),
    )
    assert before.boot_id != after.boot_id
    assert after.left_rad < 0.0
    assert after.stamp_s <= 10.0


def test_readings_that_came_late_in_a_burst_are_as_old_as_they_are() -> None:
    protocol = PonsMcuProtocol(CONFIG, "b1")
    heard(protocol, STATE, now_s=50.0)
    burst = [replace(STATE, seq=k, time_us=1_000_000 + 10_000 * k) for k in range(1, 6)]
    stamps = [state.stamp_s for state in heard(protocol, *burst, now_s=50.05)]
    assert stamps == pytest.approx([50.01, 50.02, 50.03, 50.04, 50.05])


def test_a_clock_that_wraps_goes_on() -> None:
    protocol = PonsMcuProtocol(CONFIG, "b1")
    (first,) = heard(protocol, replace(STATE, time_us=2**32 - 5_000), now_s=50.0)
    (second,) = heard(protocol, replace(STATE, seq=2, time_us=5_000), now_s=50.01)
    assert second.stamp_s - first.stamp_s == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("bit", "field"),
    [
        (pons_mcu.ENABLED, "enabled"),
        (pons_mcu.TIMED_OUT, "timed_out"),
        (pons_mcu.STOP_PRESSED, "estop_pressed"),
        (pons_mcu.BUMPER_FRONT, "bumper_front"),
        (pons_mcu.BUMPER_REAR, "bumper_rear"),
        (pons_mcu.CLIFF, "cliff"),
    ],
)
def test_each_bit_is_one_field(bit: int, field: str) -> None:
    (state,) = heard(PonsMcuProtocol(CONFIG, "b1"), replace(STATE, bits=bit))
    fields = ("enabled", "timed_out", "estop_pressed", "bumper_front", "bumper_rear", "cliff")
    assert [name for name in fields if getattr(state, name)] == [field]


@pytest.mark.parametrize(
    ("battery_mv", "charge"), [(0xFFFF, None), (9_600, 0.0), (11_100, 0.5), (13_000, 1.0), (0, 0.0)]
)
def test_the_charge_lies_between_two_voltages(battery_mv: int, charge: float | None) -> None:
    config = DriveConfig(
        kind="pons_mcu", port="/dev/x", ticks_per_turn=9, battery_empty_v=9.6, battery_full_v=12.6
    )
    (state,) = heard(PonsMcuProtocol(config, "b1"), replace(STATE, battery_mv=battery_mv))
    assert state.battery == (None if charge is None else pytest.approx(charge))
    (untold,) = heard(PonsMcuProtocol(CONFIG, "b1"), replace(STATE, battery_mv=battery_mv))
    assert untold.battery is None


def test_current_is_told_where_it_is_measured() -> None:
    protocol = PonsMcuProtocol(CONFIG, "b1")
    without, measured = heard(protocol, STATE, replace(STATE, seq=2, current_ma=1500))
    assert (without.current_a, measured.current_a) == (None, 1.5)


@given(st.integers(-(2**31), 2**31 - 1))
def test_no_speed_that_fits_the_frame_is_too_fast_for_the_wire(mradps: int) -> None:
    (state,) = heard(PonsMcuProtocol(CONFIG, "b1"), replace(STATE, left_mradps=mradps))
    assert abs(state.left_radps) <= 1000.0
    assert state.left_radps * mradps >= 0.0


def test_what_was_begun_before_the_port_opened_anew_is_forgotten() -> None:
    protocol = PonsMcuProtocol(CONFIG, "b1")
    data = encode_state(STATE)
    protocol.decode(data[:20], 1.0)
    assert protocol.begin() == b""
    assert protocol.decode(data[20:], 2.0) == []
    assert len(protocol.decode(data, 3.0)) == 1


def test_a_command_on_the_line_is_no_state() -> None:
    """A line that echoes, as one with its two wires joined, gives back what was sent."""
    frame = encode_command(McuCommand(1, 2, 0, 0, 4, 200, 0))
    assert PonsMcuProtocol(CONFIG, "b1").decode(frame, 1.0) == []


def test_without_ticks_there_is_no_protocol() -> None:
    with pytest.raises(ValueError, match="ticks_per_turn"):
        PonsMcuProtocol(DriveConfig(), "b1")


def test_a_controller_that_took_the_torque_away_is_told_once(
    caplog: pytest.LogCaptureFixture,
) -> None:
    protocol = PonsMcuProtocol(CONFIG, "b1")
    tripped = replace(STATE, bits=pons_mcu.TRIPPED)
    (first, *_) = heard(protocol, tripped, tripped, STATE, tripped)
    assert not first.enabled
    assert caplog.text.count("base_tripped") == 2


@pytest.mark.parametrize(
    ("kind", "payload"), [(0x81, bytes(44)), (0x81, bytes(36)), (0x82, bytes(41))]
)
def test_a_firmware_of_another_version_is_told_once_and_gives_no_state(
    kind: int, payload: bytes, caplog: pytest.LogCaptureFixture
) -> None:
    """Its frames check; their type or length is none of ours."""
    protocol = PonsMcuProtocol(CONFIG, "b1")
    protocol.begin()
    for seq in range(20):
        assert protocol.decode(frame(kind, seq, payload), 10.0 + seq / 100) == []
    assert caplog.text.count("base_firmware_other") == 1
    assert protocol.trouble == "base_firmware_other"


def test_noise_is_no_firmware_of_another_version(caplog: pytest.LogCaptureFixture) -> None:
    protocol, noise = PonsMcuProtocol(CONFIG, "b1"), Random(5)
    for _ in range(2_000):
        protocol.decode(noise.randbytes(60) + pons_mcu.HEAD + noise.randbytes(9), 10.0)
    assert "base_firmware_other" not in caplog.text
    assert protocol.trouble is None
