"""The OpenCR's table is read where it stands, and frames are the published ones."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from devices.dynamixel import STATUS, encode_frame
from devices.turtlebot3 import (
    BOARD,
    TABLE_BYTES,
    decode_table,
    encode_command,
    encode_heartbeat,
    encode_question,
    recognise,
)


def table(**fields: tuple[int, bytes]) -> bytes:
    made = bytearray(TABLE_BYTES)
    made[0:6] = b"\x00\x50\x01\x00\x00\x00"
    for at, data in fields.values():
        made[at : at + len(data)] = data
    return bytes(made)


def test_frames_are_as_computed_from_the_manual() -> None:
    assert encode_heartbeat(1) == bytes.fromhex("fffffd00c8060003130001 37a7")
    assert encode_heartbeat(257) == encode_heartbeat(1)
    ahead = bytes.fromhex("fffffd00c81d000396000a000000") + bytes(20) + bytes.fromhex("445f")
    assert encode_command(10, 0) == ahead
    assert encode_question()[4:12] == bytes.fromhex("c807000200 00b600")
    assert encode_command(10**9, -(10**9)) == encode_command(1000, -1000)


def test_each_field_stands_where_the_firmware_puts_it() -> None:
    found = decode_table(b"\x00" + table(
        millis=(10, b"\x10\x27\x00\x00"), status=(18, b"\xff"), beat=(19, b"\x2a"),
        bumpers=(28, b"\x00\x01"), battery=(42, b"\xb0\x04\x00\x00\x88\x13\x00\x00"),
        speeds=(128, b"\xff\xff\xff\xff\x02\x00\x00\x00"),
        ways=(136, b"\x00\x10\x00\x00\xfe\xff\xff\xff"), torque=(149, b"\x01"),
        twist=(150, b"\x05\x00\x00\x00"), turn=(170, b"\xfb\xff\xff\xff"),
    ))  # fmt: skip
    assert found is not None
    assert (found.model, found.millis, found.device_status, found.heartbeat) == (1, 10_000, -1, 42)
    assert (found.bumpers, found.battery_v, found.battery_share) == ((False, True), 12.0, 0.5)
    assert (found.left_step, found.right_step) == (-1, 2)
    assert (found.left_ticks, found.right_ticks) == (4096, -2)
    assert (found.torque, found.linear_cmps, found.angular_cradps) == (True, 5, -5)


@pytest.mark.parametrize(
    "parameters",
    [b"", b"\x00", b"\x01" + table(), b"\x00" + table()[:-1], b"\x00" + bytes(TABLE_BYTES)],
)
def test_what_is_no_table_is_none(parameters: bytes) -> None:
    assert decode_table(parameters) is None


@given(st.binary(min_size=TABLE_BYTES, max_size=TABLE_BYTES))
def test_any_table_of_a_board_can_be_read(data: bytes) -> None:
    found = decode_table(b"\x00\x00\x50" + data[2:])
    assert found is not None
    assert 0.0 <= found.battery_share <= 1.0


def test_it_is_recognised_by_its_answer_to_a_ping() -> None:
    answer = encode_frame(BOARD, STATUS, b"\x00\x00\x50\x04")
    found = recognise(b"\xff" + answer)
    assert found is not None
    assert "firmware 4" in found.words
    for other in (
        encode_frame(1, STATUS, b"\x00\x00\x50\x04"),
        encode_frame(BOARD, STATUS, b"\x00\x50\x01\x04"),
        encode_frame(BOARD, STATUS, b"\x00"), encode_frame(BOARD, 1), b"",
    ):  # fmt: skip
        assert recognise(other) is None
