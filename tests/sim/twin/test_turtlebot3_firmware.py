"""The twin of an OpenCR keeps a table, guards it, and stands half a second after the last beat."""

from __future__ import annotations

import struct
from typing import cast

import pytest

from devices.dynamixel import PING, READ, STATUS, WRITE, DynamixelReader, encode_frame
from devices.turtlebot3 import encode_command, encode_heartbeat, encode_question
from sim.twin.turtlebot3 import HEARTBEAT_S, Turtlebot3Firmware
from tests.wire.examples import EXAMPLES
from wire import DriveState, RobotDescription

ROBOT = RobotDescription.model_validate({
    "base": {"wheel_radius_m": 0.033, "wheel_separation_m": 0.16, "radius_m": 0.14},
    "limits": {"max_speed_mps": 0.2},
    "drive": {"kind": "turtlebot3", "port": "/dev/x"},
})  # fmt: skip
BODY = cast("DriveState", EXAMPLES[DriveState])


def said(board: Turtlebot3Firmware, data: bytes, now_s: float) -> list[bytes]:
    board.hear(data, now_s)
    frames = DynamixelReader().read(board.say(BODY, now_s))
    assert {(frame.id, frame.instruction) for frame in frames} <= {(200, STATUS)}
    return [frame.parameters for frame in frames]


def test_it_answers_a_ping_with_its_model() -> None:
    assert said(Turtlebot3Firmware(ROBOT), encode_frame(200, PING), 0.0) == [b"\x00\x00\x50\x04"]
    assert said(Turtlebot3Firmware(ROBOT), encode_frame(1, PING), 0.0) == []


@pytest.mark.parametrize("beats_until_s", [1.0, 3.0])
def test_it_stands_half_a_second_after_the_last_beat(beats_until_s: float) -> None:
    board = Turtlebot3Firmware(ROBOT)
    for k in range(round(100 * beats_until_s)):
        board.hear(encode_command(10, 0) + encode_heartbeat(k + 1), 0.01 * k)
        assert board.motors(0.01 * k)[0] == pytest.approx(0.1 / 0.033)
    last_s = beats_until_s - 0.01
    for k in range(30):  # commands without a beat keep nothing alive, nor does a beat that stays
        board.hear(encode_command(10, 0), last_s + 0.01 * k)
    board.hear(encode_heartbeat(round(100 * beats_until_s)), last_s + 0.3)
    assert board.motors(last_s + HEARTBEAT_S - 0.01)[0] > 0.0
    assert board.motors(last_s + HEARTBEAT_S + 0.01)[:2] == (0.0, 0.0)


def test_its_servos_do_no_more_than_they_can() -> None:
    board = Turtlebot3Firmware(ROBOT)
    board.hear(encode_command(1000, 0) + encode_heartbeat(1), 0.0)
    assert board.motors(0.0)[0] == pytest.approx(61.0 / 60.0 * 6.2831853)


def test_its_table_may_be_written_only_where_it_allows() -> None:
    board = Turtlebot3Firmware(ROBOT)
    assert said(board, encode_frame(200, WRITE, b"\x80\x00\x01"), 0.0) == [b"\x07"]
    assert said(board, encode_frame(200, READ, struct.pack("<HH", 250, 20)), 0.0) == [b"\x04"]
    assert said(board, encode_heartbeat(7), 0.0) == [b"\x00"]
    (answer,) = said(board, encode_question(), 1.0)
    assert answer[1 + 19] == 7
    assert len(answer) == 183


def test_frames_that_are_cut_or_spoilt_are_passed_over() -> None:
    board = Turtlebot3Firmware(ROBOT)
    spoilt = bytearray(encode_heartbeat(7))
    spoilt[9] ^= 1
    ping = encode_frame(200, PING)
    assert said(board, bytes(spoilt) + b"\xff\xff\xfd\x00\xc8\xff\xff" + ping[:4], 0.0) == []
    assert said(board, ping[4:] + ping, 0.1)
