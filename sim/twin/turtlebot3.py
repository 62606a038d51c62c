"""Act as a TurtleBot 3's OpenCR board, as its source was read.

A table of bytes that a host reads and writes by DYNAMIXEL frames, filled every 20 ms. It obeys the
twist in it by its model's geometry, held to what its servos do, and stands half a second after the
heartbeat has changed for the last time.
"""

from __future__ import annotations

import struct
from math import floor, pi, tau
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire import DriveState, Imu, RobotDescription

HEARTBEAT_S = 0.5
_FILL_S = 0.02
_ID = 200
_MODELS = {1: (0.160, 61.0), 2: (0.287, 77.0)}
"""Separation [m] and fastest turn of a wheel [1/min] of Burger and Waffle."""
_RADIUS_M = 0.033
_TICKS, _STEP_RADPS = 4096, 0.229 * tau / 60.0
_TABLE = 256
_WRAP, _HALF = 1 << 32, 1 << 31
_WRITABLE = (range(19, 24), range(50, 51), range(59, 60), range(149, 182))
_HEAD = b"\xff\xff\xfd\x00"
_LONGEST = 512


def _crc(data: bytes) -> int:
    """Reckon bit by bit: another way than the host's table."""
    crc = 0
    for byte in data:
        crc ^= byte << 8
        for _ in range(8):
            crc = (crc << 1 ^ (0x8005 if crc & 0x8000 else 0)) & 0xFFFF
    return crc


class Turtlebot3Firmware:
    """Answer frames, obey the table, count, and stop by itself."""

    def __init__(self, robot: RobotDescription) -> None:
        self._model = 2 if robot.base.wheel_separation_m > 0.22 else 1
        self._table = bytearray(_TABLE)
        struct.pack_into("<HIBBB", self._table, 0, 0x5000, self._model, 4, _ID, 3)
        self._table[149] = 1
        self._rest = b""
        self._said = b""
        self._beat_s: float | None = None
        self._twist = (0.0, 0.0)
        self._began_s: float | None = None
        self._filled_s = 0.0
        self._zero: tuple[float, float] | None = None
        self._felt: Imu | None = None

    def hear(self, data: bytes, now_s: float) -> None:
        """Take the bytes that arrived."""
        if self._began_s is None:
            self._began_s = now_s
        self._rest = (self._rest + data)[-_LONGEST:]
        while (head := self._rest.find(_HEAD)) >= 0:
            self._rest = self._rest[head:]
            if len(self._rest) < 7:
                return
            device, length = struct.unpack_from("<BH", self._rest, 4)
            end = 7 + length
            if length < 3 or end > _LONGEST:
                self._rest = self._rest[1:]
                continue
            if len(self._rest) < end:
                return
            frame, self._rest = self._rest[:end], self._rest[end:]
            if _crc(frame[:-2]) == struct.unpack("<H", frame[-2:])[0] and device == _ID:
                body = frame[7:-2].replace(b"\xff\xff\xfd\xfd", b"\xff\xff\xfd")
                self._obey(body[0], body[1:], now_s)

    def motors(self, now_s: float) -> tuple[float, float, bool]:
        """Return left and right [rad/s] and whether there is torque."""
        if self._beat_s is None or now_s - self._beat_s >= HEARTBEAT_S:
            self._twist = (0.0, 0.0)
        separation_m, rpm = _MODELS[self._model]
        linear, angular = self._twist
        most_radps = rpm * 2.0 * pi / 60.0
        left, right = (
            min(
                max((linear + side * angular * separation_m / 2.0) / _RADIUS_M, -most_radps),
                most_radps,
            )
            for side in (-1.0, 1.0)
        )
        return left, right, self._table[149] != 0

    def feel(self, imu: Imu) -> None:
        """Take what the body's gyro reads now."""
        self._felt = imu

    def say(self, body: DriveState, now_s: float) -> bytes:
        """Return the answers; fill the table every 20 ms."""
        if self._zero is None:
            self._zero = body.left_rad, body.right_rad
        if now_s - self._filled_s >= _FILL_S - 1e-6:
            self._filled_s = now_s
            self._fill(body, *self._zero, now_s)
        said, self._said = self._said, b""
        return said

    def _fill(self, body: DriveState, left_rad: float, right_rad: float, now_s: float) -> None:
        table, charge = self._table, 1.0 if body.battery is None else body.battery
        began_s = self._began_s or 0.0
        struct.pack_into("<II", table, 10, floor((now_s - began_s) * 1e3) % _WRAP,
                         floor((now_s - began_s) * 1e6) % _WRAP)  # fmt: skip
        if (felt := self._felt) is not None:
            struct.pack_into(
                "<ffffff", table, 60, 0.0, 0.0, felt.yaw_rate_radps,
                felt.accel_x_mps2, felt.accel_y_mps2, 9.8,
            )  # fmt: skip
        table[28], table[29] = bool(body.bumper_front), bool(body.bumper_rear)
        struct.pack_into("<iI", table, 42, round(1050 + 180 * charge), round(charge * 10_000))
        struct.pack_into(
            "<iiii", table, 128,
            round(body.left_radps / _STEP_RADPS), round(body.right_radps / _STEP_RADPS),
            _ticks(body.left_rad - left_rad), _ticks(body.right_rad - right_rad),
        )  # fmt: skip

    def _obey(self, instruction: int, given: bytes, now_s: float) -> None:
        if instruction == 1:
            self._answer(0, struct.pack("<HB", 0x5000, 4))
        elif instruction == 2 and len(given) == 4:
            at, count = struct.unpack("<HH", given)
            fits = at + count <= _TABLE
            self._answer(0 if fits else 4, bytes(self._table[at : at + count]) if fits else b"")
        elif instruction == 3 and len(given) > 2:
            self._write(struct.unpack_from("<H", given)[0], given[2:], now_s)

    def _write(self, at: int, data: bytes, now_s: float) -> None:
        if not any(at in area and at + len(data) <= area.stop for area in _WRITABLE):
            self._answer(7, b"")
            return
        if at == 19 and data[0] != self._table[19]:
            self._beat_s = now_s
        self._table[at : at + len(data)] = data
        if at == 150 and len(data) == 24:
            linear, _, _, _, _, angular = struct.unpack("<iiiiii", data)
            self._twist = (linear * 0.01, angular * 0.01)
        self._answer(0, b"")

    def _answer(self, error: int, data: bytes) -> None:
        body = (bytes([0x55, error]) + data).replace(b"\xff\xff\xfd", b"\xff\xff\xfd\xfd")
        frame = _HEAD + struct.pack("<BH", _ID, len(body) + 2) + body
        self._said += frame + struct.pack("<H", _crc(frame))


def _ticks(angle_rad: float) -> int:
    return (floor(angle_rad / tau * _TICKS) + _HALF) % _WRAP - _HALF
