"""Read and write the control table of a TurtleBot 3's OpenCR board (frames: devices/dynamixel.py).

The board is device 200 on its USB port and copies its state into the table 50 times a second. What
is told is a twist in whole centimetres and hundredths of a radian a second, which the board turns
into wheel speeds by its own model's geometry.
"""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import Final

from devices.dynamixel import PING, READ, STATUS, WRITE, DynamixelReader, encode_frame
from devices.inertial import InertialReading
from devices.port_probe import PortAnswer, PortProbe

BAUD: Final = 1_000_000
BOARD: Final = 200
MODEL_NUMBER: Final = 0x5000
TABLE_BYTES: Final = 182
"""From model number to profile acceleration; ROBOTIS' own node reads nearly as much at once."""

HEARTBEAT: Final = 19
COMMAND: Final = 150
WHEEL_RADIUS_M: Final = 0.033
"""Of every model, and in the firmware."""
SEPARATIONS_M: Final = {1: 0.160, 2: 0.287}
"""By the table's model: Burger, and Waffle with Waffle Pi."""
MODELS: Final = {1: "Burger", 2: "Waffle or Waffle Pi"}
TICKS_PER_TURN: Final = 4096
RADPS_A_STEP: Final = 0.229 * 6.283185307179586 / 60.0
STEPS_A_UNIT: Final = 100.0
"""A command's step: 1 cm/s, 0.01 rad/s."""

_HEAD: Final = Struct("<HIB")
_MILLIS: Final = Struct("<I")
_WHEELS: Final = Struct("<iiii")
_TWIST: Final = Struct("<iiiiii")
_BATTERY: Final = Struct("<iI")
_INERTIAL: Final = Struct("<ffffff")
"""Gyro [rad/s] and accelerometer [m/s2]."""
_AT_INERTIAL: Final = 60
_AT_MILLIS, _AT_STATUS, _AT_BUMPERS, _AT_BATTERY, _AT_WHEELS, _AT_TORQUE = 10, 18, 28, 42, 128, 149
_MOST_STEPS: Final = 1_000
_READ: Final = Struct("<HH")
_WRITE: Final = Struct("<H")


@dataclass(frozen=True, slots=True)
class OpenCrTable:
    """Hold what a board's table says."""

    model: int
    firmware: int
    millis: int
    """Of its clock, begins again at 2^32."""
    device_status: int
    """Below 0: it does not reach its motors, or can't go on."""
    heartbeat: int
    """As written last."""
    bumpers: tuple[bool, bool]
    """Front and rear."""
    battery_v: float
    battery_share: float
    left_step: int
    """Speed, 0.229 revolutions a minute."""
    right_step: int
    left_ticks: int
    right_ticks: int
    inertial: InertialReading
    """In the board's axes, as it came: any float."""
    torque: bool
    linear_cmps: int
    """As commanded last."""
    angular_cradps: int


def encode_command(linear_cmps: int, angular_cradps: int) -> bytes:
    """Return the frame that sets the twist [cm/s, 0.01 rad/s]."""
    linear, angular = (
        min(max(steps, -_MOST_STEPS), _MOST_STEPS) for steps in (linear_cmps, angular_cradps)
    )
    twist = _TWIST.pack(linear, 0, 0, 0, 0, angular)
    return encode_frame(BOARD, WRITE, _WRITE.pack(COMMAND) + twist)


def encode_heartbeat(beat: int) -> bytes:
    """Return the frame that shows that the host lives: the byte must change."""
    return encode_frame(BOARD, WRITE, _WRITE.pack(HEARTBEAT) + bytes([beat % 256]))


def encode_question() -> bytes:
    """Return the frame that asks for the whole table."""
    return encode_frame(BOARD, READ, _READ.pack(0, TABLE_BYTES))


def decode_table(parameters: bytes) -> OpenCrTable | None:
    """Return the table that a status frame carries; None where it carries something else."""
    error, table = parameters[:1], parameters[1:]
    if error not in {b"\x00", b"\x80"} or len(table) != TABLE_BYTES:  # 80: an alert of the device
        return None
    number, model, firmware = _HEAD.unpack_from(table)
    if number != MODEL_NUMBER:
        return None
    left_step, right_step, left_ticks, right_ticks = _WHEELS.unpack_from(table, _AT_WHEELS)
    linear, _, _, _, _, angular = _TWIST.unpack_from(table, COMMAND)
    gx, gy, gz, ax, ay, az = _INERTIAL.unpack_from(table, _AT_INERTIAL)
    centivolts, share = _BATTERY.unpack_from(table, _AT_BATTERY)
    status = table[_AT_STATUS]
    return OpenCrTable(
        model=model,
        firmware=firmware,
        millis=int(_MILLIS.unpack_from(table, _AT_MILLIS)[0]),
        device_status=status - 256 if status > 127 else status,
        heartbeat=table[HEARTBEAT],
        bumpers=(table[_AT_BUMPERS] != 0, table[_AT_BUMPERS + 1] != 0),
        battery_v=centivolts / 100.0,
        battery_share=min(max(share / 10_000.0, 0.0), 1.0),
        left_step=left_step,
        right_step=right_step,
        left_ticks=left_ticks,
        right_ticks=right_ticks,
        inertial=InertialReading((gx, gy, gz), (ax, ay, az)),
        torque=table[_AT_TORQUE] != 0,
        linear_cmps=linear,
        angular_cradps=angular,
    )


_QUESTION: Final = encode_frame(BOARD, PING)
_PONG: Final = Struct("<BHB")


def recognise(data: bytes) -> PortAnswer | None:
    """Return what answers a ping as device 200 with the board's model number."""
    for frame in DynamixelReader().read(data):
        if (frame.id, frame.instruction) != (BOARD, STATUS):
            continue
        if len(frame.parameters) != _PONG.size:
            continue
        _, number, firmware = _PONG.unpack(frame.parameters)
        if number == MODEL_NUMBER:
            return PortAnswer(f"TurtleBot 3, OpenCR with firmware {firmware}")
    return None


PROBES: Final = (PortProbe("drive", "turtlebot3", BAUD, recognise, _QUESTION),)
