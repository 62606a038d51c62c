"""Lines of ros_arduino_bridge are read as they are, and nothing else is."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from devices.ros_arduino import (
    LONGEST,
    ArduinoCounts,
    ArduinoOk,
    ArduinoOther,
    ArduinoReader,
    encode_move,
    recognise,
)


def test_a_command_is_two_lines_of_the_firmwares_own() -> None:
    assert encode_move(20, -7) == b"m 20 -7\re\r"
    assert encode_move(10**9, -(10**9)) == b"m 9999 -9999\re\r", "16 bits are all that it reads"


def test_its_answers_are_read() -> None:
    assert ArduinoReader().read(b"OK\r\n-12 34567\r\nInvalid Command\r\n") == [
        ArduinoOk(), ArduinoCounts(-12, 34567), ArduinoOther(b"Invalid Command"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    "line",
    [b"", b"OK ", b"ok", b"1", b"1 2 3", b"1  2", b"1 2x", b"--1 2", b"2147483648 0", b"1 \xff",
     b"0 -2147483649", b"12345678901 1"],
)  # fmt: skip
def test_what_is_spoilt_is_told_as_such(line: bytes) -> None:
    assert ArduinoReader().read(line + b"\r\n") == [ArduinoOther(line)]


@given(st.binary(max_size=200), st.data())
def test_lines_may_come_in_any_pieces(whole: bytes, data: st.DataObject) -> None:
    whole = b"\n".join(line[:LONGEST] for line in whole.split(b"\n"))
    cut = data.draw(st.integers(0, len(whole)))
    reader = ArduinoReader()
    pieces = reader.read(whole[:cut]) + reader.read(whole[cut:])
    assert pieces == ArduinoReader().read(whole)


def test_a_line_without_end_is_not_kept() -> None:
    reader = ArduinoReader()
    for _ in range(50):
        reader.read(b"x" * 40)
    assert len(reader._rest) <= LONGEST
    reader.reset()
    assert reader.read(b"OK\r\n") == [ArduinoOk()]


def test_it_is_recognised_by_the_speed_of_its_line() -> None:
    found = recognise(b"57600\r\n")
    assert found is not None
    assert "ticks_per_turn" in found.missing
    for other in (b"57600", b"157600\r\n", b"OK\r\n", b""):
        assert recognise(other) is None
