"""Frames come through whole, in any pieces; what is spoilt is none, but for the checksum's odds."""

from __future__ import annotations

import struct
from binascii import crc_hqx
from dataclasses import replace

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from devices.pons_mcu import (
    HEAD,
    LONGEST,
    McuCommand,
    McuReader,
    McuState,
    encode_command,
    encode_state,
)

U32 = st.integers(0, (1 << 32) - 1)
I32 = st.integers(-(1 << 31), (1 << 31) - 1)
U16 = st.integers(0, 0xFFFF)
U8 = st.integers(0, 0xFF)
COMMANDS = st.builds(McuCommand, U32, U32, I32, I32, U32, U16, U8)
STATES = st.builds(McuState, U32, U32, U32, U32, U32, I32, I32, I32, I32, U16, U16, U8)
COMMAND = McuCommand(7, 0x01020304, 1500, -1500, 4096, 200, 1)
STATE = McuState(9, 0x0A0B0C0D, 0x01020304, 7, 1_000_000, -1, 4096, 1490, -1490, 0xFFFF, 12_000, 1)
COMMAND_BYTES = bytes.fromhex(
    "a55a 13 01 07000000 04030201 dc050000 24faffff 00100000 c800 01 eccb"
)
STATE_BYTES = bytes.fromhex(
    "a55a 25 81 09000000 0d0c0b0a 04030201 07000000 40420f00 ffffffff 00100000"
    "d2050000 2efaffff ffff e02e 01 1c12"
)


def frame_of(message: McuCommand | McuState) -> bytes:
    is_command = isinstance(message, McuCommand)
    return encode_command(message) if is_command else encode_state(message)  # type: ignore[arg-type]


def bitwise_crc(data: bytes) -> int:
    """Compute CRC-16/XMODEM the long way."""
    rest = 0
    for byte in data:
        rest ^= byte << 8
        for _ in range(8):
            rest = (rest << 1 ^ (0x1021 if rest & 0x8000 else 0)) & 0xFFFF
    return rest


def test_the_checksum_is_xmodems() -> None:
    """31C3 is its published check value (catalogue of parametrised CRC algorithms)."""
    assert crc_hqx(b"123456789", 0) == bitwise_crc(b"123456789") == 0x31C3


@pytest.mark.parametrize(("message", "data"), [(COMMAND, COMMAND_BYTES), (STATE, STATE_BYTES)])
def test_golden_bytes_encode_and_decode(message: McuCommand | McuState, data: bytes) -> None:
    assert frame_of(message) == data
    assert McuReader().read(data) == [message]
    assert int.from_bytes(data[-2:], "little") == bitwise_crc(data[2:-2])
    assert len(data) <= LONGEST


@given(st.lists(COMMANDS | STATES, max_size=6), st.data())
def test_frames_come_through_in_any_pieces(
    messages: list[McuCommand | McuState], data: st.DataObject
) -> None:
    stream = b"".join(frame_of(message) for message in messages)
    reader, found, at = McuReader(), [], 0
    while at < len(stream):
        size = data.draw(st.integers(1, 60))
        found += reader.read(stream[at : at + size])
        at += size
    assert found == messages
    assert reader.spoilt_bytes == 0


@given(STATES, st.integers(0, 8 * LONGEST - 1), COMMANDS)
def test_a_flipped_bit_spoils_its_frame_and_no_other(
    state: McuState, bit: int, command: McuCommand
) -> None:
    spoilt = bytearray(encode_state(state))
    spoilt[bit // 8] ^= 1 << bit % 8
    reader = McuReader()
    found = reader.read(bytes(spoilt) + encode_command(command))
    found += reader.read(bytes(LONGEST))  # whatever it still waited for has now come
    assert state not in found
    assert found == [command]


@given(st.binary(max_size=300), COMMANDS)
def test_noise_before_a_frame_does_not_hide_it(noise: bytes, command: McuCommand) -> None:
    reader = McuReader()
    found = reader.read(noise + encode_command(command))
    found += reader.read(bytes(LONGEST))
    assert command in found


@given(STATES, st.integers(0, LONGEST - 1), COMMANDS)
def test_a_cut_frame_costs_no_other(state: McuState, kept: int, command: McuCommand) -> None:
    sent = encode_state(state)
    assume(not HEAD.startswith(sent[kept:]))  # else the next frame's head completes this one
    reader = McuReader()
    found = reader.read(sent[:kept] + encode_command(command))
    assert command in found + reader.read(bytes(LONGEST))


@given(st.lists(st.binary(max_size=80), max_size=30))
def test_it_remembers_no_more_than_one_frame(pieces: list[bytes]) -> None:
    reader = McuReader()
    for piece in pieces:
        reader.read(piece)
        assert len(reader._rest) < LONGEST


def test_a_reset_forgets_what_was_begun() -> None:
    reader, data = McuReader(), encode_command(COMMAND)
    reader.read(data[:10])
    reader.reset()
    assert reader.read(data[10:]) == []
    assert reader.read(data) == [COMMAND]


def test_a_checked_frame_of_an_unknown_kind_or_length_is_none() -> None:
    body = bytes.fromhex("13 02 07000000") + bytes(19)
    other = b"\xa5\x5a" + body + crc_hqx(body, 0).to_bytes(2, "little")
    short = bytes.fromhex("02 01 07000000") + bytes(2)
    small = b"\xa5\x5a" + short + crc_hqx(short, 0).to_bytes(2, "little")
    assert McuReader().read(other + small + bytes(LONGEST)) == []


def test_a_number_that_does_not_fit_is_refused() -> None:
    with pytest.raises(struct.error):
        encode_command(replace(COMMAND, left_mradps=1 << 31))
