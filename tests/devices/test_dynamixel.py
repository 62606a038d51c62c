"""Frames of DYNAMIXEL's protocol 2.0: the manual's, any, cut and spoilt."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from devices.dynamixel import (
    LONGEST,
    PING,
    STATUS,
    DynamixelFrame,
    DynamixelReader,
    encode_frame,
)

PARAMETERS = st.binary(max_size=200) | st.lists(
    st.sampled_from([b"\xff", b"\xfd", b"\x00", b"\xff\xff\xfd", b"\xff\xff\xfd\x00"]), max_size=40
).map(b"".join)


def test_the_manuals_ping_is_ours() -> None:
    assert encode_frame(1, PING) == bytes.fromhex("fffffd000103000119 4e")
    assert encode_frame(200, PING) == bytes.fromhex("fffffd00c80300013bfa")


@given(st.integers(0, 252), PARAMETERS)
def test_what_is_framed_is_read_again(device: int, parameters: bytes) -> None:
    frame = encode_frame(device, STATUS, parameters)
    assert DynamixelReader().read(frame) == [DynamixelFrame(device, STATUS, parameters)]
    assert b"\xff\xff\xfd\x00" not in frame[4:], "no frame seems to begin within another"


@given(st.lists(PARAMETERS, min_size=1, max_size=4), st.data())
def test_frames_may_come_in_any_pieces(given_parameters: list[bytes], data: st.DataObject) -> None:
    whole = b"".join(encode_frame(7, STATUS, each) for each in given_parameters)
    reader, found, at = DynamixelReader(), [], 0
    while at < len(whole):
        step = data.draw(st.integers(1, 60))
        found += reader.read(whole[at : at + step])
        at += step
    assert [frame.parameters for frame in found] == given_parameters
    assert reader.spoilt_bytes == 0


@given(st.binary(max_size=40), PARAMETERS)
def test_after_noise_the_next_frame_is_found(noise: bytes, parameters: bytes) -> None:
    frame = encode_frame(7, STATUS, parameters)
    reader = DynamixelReader()
    found = reader.read(noise + frame + encode_frame(7, STATUS, b"last") * 20)
    assert found[-1].parameters == b"last"


@given(PARAMETERS, st.data())
def test_one_flipped_bit_is_no_frame(parameters: bytes, data: st.DataObject) -> None:
    frame = bytearray(encode_frame(7, STATUS, parameters))
    bit = data.draw(st.integers(8 * 4, 8 * len(frame) - 1))
    frame[bit // 8] ^= 1 << bit % 8
    found = DynamixelReader().read(bytes(frame))
    assert DynamixelFrame(7, STATUS, parameters) not in found


@pytest.mark.parametrize("length", [0, 2, LONGEST + 1, 65_535])
def test_a_length_that_is_none_waits_for_nothing(length: int) -> None:
    reader = DynamixelReader()
    broken = b"\xff\xff\xfd\x00\x07" + length.to_bytes(2, "little")
    assert reader.read(broken + encode_frame(7, PING)) == [DynamixelFrame(7, PING, b"")]


@given(st.lists(st.binary(max_size=60), max_size=60))
def test_it_keeps_no_more_than_a_frame(pieces: list[bytes]) -> None:
    reader = DynamixelReader()
    for piece in pieces:
        reader.read(b"\xff\xff\xfd" + piece)
    assert len(reader._rest) <= LONGEST + 7
    reader.reset()
    assert reader._rest == b""
