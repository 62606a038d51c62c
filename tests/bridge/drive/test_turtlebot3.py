"""A TurtleBot is told twists in its own steps; its table shows which of them it has."""

from __future__ import annotations

import struct
from math import pi
from typing import cast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bridge.drive.turtlebot3 import Turtlebot3Protocol
from devices.dynamixel import READ, STATUS, WRITE, DynamixelReader, encode_frame
from devices.turtlebot3 import BOARD, TABLE_BYTES
from sim.twin.turtlebot3 import Turtlebot3Firmware
from tests.wire.examples import EXAMPLES
from wire import DriveCommand, DriveState, RobotDescription

ROBOT = RobotDescription.model_validate({
    "base": {"wheel_radius_m": 0.033, "wheel_separation_m": 0.16, "radius_m": 0.14},
    "limits": {"max_speed_mps": 0.2},
    "drive": {"kind": "turtlebot3", "port": "/dev/x"},
})  # fmt: skip
BODY = cast("DriveState", EXAMPLES[DriveState]).model_copy(
    update={"left_rad": 0.0, "right_rad": 0.0, "battery": 0.5}
)


def command(seq: int, left: float, right: float, *, enable: bool = True) -> DriveCommand:
    return DriveCommand(boot="b1", seq=seq, left_radps=left, right_radps=right, enable=enable)


def answer(
    millis: int = 1000, beat: int = 0, model: int = 1, status: int = 0, **more: int
) -> bytes:
    table = bytearray(TABLE_BYTES)
    struct.pack_into("<HI", table, 0, 0x5000, model)
    struct.pack_into("<I", table, 10, millis)
    table[18], table[19], table[149] = status % 256, beat, more.get("torque", 1)
    table[28], table[29] = more.get("front", 0), more.get("rear", 0)
    struct.pack_into("<iI", table, 42, more.get("volts", 1140), 5000)
    struct.pack_into("<iiii", table, 128, 10, -10, more.get("left", 0), more.get("right", 0))
    struct.pack_into("<i", table, 150, more.get("linear", 0))
    struct.pack_into("<i", table, 170, more.get("angular", 0))
    return encode_frame(BOARD, STATUS, b"\x00" + bytes(table))


def frames(data: bytes) -> list[tuple[int, bytes]]:
    return [(frame.instruction, frame.parameters) for frame in DynamixelReader().read(data)]


def one(protocol: Turtlebot3Protocol, data: bytes, now_s: float = 10.0) -> DriveState:
    (state,) = protocol.decode(data, now_s)
    return state


def test_commands_and_questions_take_turns() -> None:
    protocol = Turtlebot3Protocol(ROBOT, "b1")
    assert protocol.begin() == b""
    kinds = [[kind for kind, _ in frames(protocol.encode(command(k, 3.0, 3.0)))] for k in (2, 3, 4)]
    assert kinds == [[WRITE, WRITE], [READ], [WRITE, WRITE]]
    assert [kind for kind, _ in frames(protocol.encode(command(5, 0.0, 0.0)))] == [WRITE, WRITE]
    assert [kind for kind, _ in frames(protocol.encode(command(7, 0.0, 0.0)))] == [READ]


@given(st.floats(-6.0, 6.0), st.floats(-6.0, 6.0), st.booleans())
def test_wheels_come_out_of_the_board_as_they_were_meant_to_a_step(
    left: float, right: float, enable: bool
) -> None:
    protocol, board = Turtlebot3Protocol(ROBOT, "b1"), Turtlebot3Firmware(ROBOT)
    board.hear(protocol.encode(command(8, left, right, enable=enable)), 1.0)
    got_left, got_right, _ = board.motors(1.0)
    step = (0.005 + 0.005 * 0.08) / 0.033 + 1e-6
    assert got_left == pytest.approx(left if enable else 0.0, abs=step)
    assert got_right == pytest.approx(right if enable else 0.0, abs=step)


def test_a_state_says_what_the_table_says() -> None:
    protocol = Turtlebot3Protocol(ROBOT, "b1")
    one(protocol, answer())
    state = one(protocol, answer(1020, left=2048, right=-1024, front=1), 10.02)
    assert (state.left_rad, state.right_rad) == pytest.approx((pi, -pi / 2))
    assert state.left_radps == pytest.approx(10 * 0.229 * 2 * pi / 60)
    assert (state.bumper_front, state.bumper_rear, state.cliff) == (True, False, False)
    assert (state.battery, state.timed_out, state.estop_pressed) == (0.5, None, False)
    assert one(protocol, answer(1040, volts=0), 10.04).battery is None


def test_an_echo_is_a_beat_with_its_own_twist() -> None:
    protocol = Turtlebot3Protocol(ROBOT, "b1")
    assert one(protocol, answer()).echo_boot is None
    protocol.encode(command(254, 3.0, 3.0))
    protocol.encode(command(258, 6.0, 6.0))
    state = one(protocol, answer(1020, beat=254, linear=10))
    assert (state.echo_boot, state.echo_seq, state.enabled) == ("b1", 254, True)
    assert one(protocol, answer(1040, beat=254, linear=20)).echo_seq == 254, "half of the next"
    assert one(protocol, answer(1060, beat=2, linear=10)).echo_seq == 254, "a beat alone is none"
    assert one(protocol, answer(1080, beat=2, linear=20)).echo_seq == 258
    assert one(protocol, answer(1100, beat=77, linear=20)).echo_seq == 258, "nobody's"
    assert not one(protocol, answer(1120, beat=2, linear=20, torque=0)).enabled


@pytest.mark.parametrize(
    ("wrong", "code"),
    [({"model": 9}, "base_model_unknown"), ({"status": -1}, "base_motors_missing")],
)
def test_a_board_that_can_not_drive_says_nothing_and_is_named_once(
    wrong: dict[str, int], code: str, caplog: pytest.LogCaptureFixture
) -> None:
    protocol = Turtlebot3Protocol(ROBOT, "b1")
    for k in range(5):
        assert protocol.decode(answer(1000 + 20 * k, **wrong), 10.0) == []
    assert caplog.text.count(code) == 1
    assert protocol.trouble == code
    assert len(protocol.decode(answer(1100), 10.1)) == 1
    assert protocol.trouble is None


def test_a_waffle_is_told_by_its_own_track() -> None:
    protocol = Turtlebot3Protocol(ROBOT, "b1")
    one(protocol, answer(model=2))
    (_, twist), _ = frames(protocol.encode(command(2, -1.0, 1.0)))
    assert struct.unpack_from("<i", twist, 22)[0] == round(100 * 2 * 0.033 / 0.287)


def test_a_clock_that_went_back_is_a_board_that_began_anew(
    caplog: pytest.LogCaptureFixture,
) -> None:
    protocol = Turtlebot3Protocol(ROBOT, "b1")
    before = one(protocol, answer(90_000, left=4096))
    after = one(protocol, answer(100, left=7), 10.1)
    assert "base_reset" in caplog.text
    assert after.boot_id != before.boot_id
    assert after.left_rad == 0.0


def test_a_clock_that_wraps_goes_on() -> None:
    protocol = Turtlebot3Protocol(ROBOT, "b1")
    before = one(protocol, answer(2**32 - 10), 10.0)
    after = one(protocol, answer(10), 10.02)
    assert after.boot_id == before.boot_id
    assert after.stamp_s - before.stamp_s == pytest.approx(0.02)


def test_other_frames_are_no_state() -> None:
    protocol = Turtlebot3Protocol(ROBOT, "b1")
    for data in (encode_frame(BOARD, STATUS, b"\x00"), encode_frame(1, STATUS, b"\x00"), b"\xff"):
        assert protocol.decode(data, 1.0) == []
    protocol.decode(answer()[:50], 1.0)
    assert protocol.begin() == b""
    assert protocol.decode(answer()[50:], 1.1) == []
