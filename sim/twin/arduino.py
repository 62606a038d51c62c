"""Act as an Arduino with ros_arduino_bridge, as its source was read.

Each command is a letter with numbers, ended by CR, and answered by one line. It stops 2 s after the
last one that moves, and keeps its loader's silence after a start.
"""

from __future__ import annotations

from math import floor, tau
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wire import DriveState, RobotDescription

LOADING_S = 1.0
AUTO_STOP_S = 2.0
_FRAMES_HZ = 30.0
_LONGEST = 32
_WRAP, _HALF = 1 << 32, 1 << 31
_SHORT = 1 << 15


class ArduinoFirmware:
    """Obey letters, count edges, and stop by itself, late."""

    def __init__(self, robot: RobotDescription) -> None:
        self._ticks_per_turn = robot.drive.ticks_per_turn or 1
        self._rest = b""
        self._said = b""
        self._left_ticks = self._right_ticks = 0
        self._moved_s = 0.0
        self._began_s: float | None = None
        self._counts = (0, 0)
        self._zero: tuple[float, float] | None = None

    def hear(self, data: bytes, now_s: float) -> None:
        """Take the bytes that arrived; while it loads, none."""
        if self._began_s is None:
            self._began_s = now_s
        if now_s - self._began_s < LOADING_S:
            return
        *lines, self._rest = (self._rest + data).split(b"\r")
        self._rest = self._rest[-_LONGEST:]
        for line in lines:
            self._said += self._answer(line.replace(b"\n", b""), now_s) + b"\r\n"

    def motors(self, now_s: float) -> tuple[float, float, bool]:
        """Return left and right [rad/s] and whether there is torque."""
        if now_s - self._moved_s > AUTO_STOP_S:
            self._left_ticks = self._right_ticks = 0
        rad = _FRAMES_HZ * tau / self._ticks_per_turn
        moves = self._left_ticks != 0 or self._right_ticks != 0
        return self._left_ticks * rad, self._right_ticks * rad, moves

    def say(self, body: DriveState, _now_s: float) -> bytes:
        """Return the answers; it says nothing unasked."""
        if self._zero is None:
            self._zero = body.left_rad, body.right_rad
        self._counts = (
            self._count(body.left_rad - self._zero[0]),
            self._count(body.right_rad - self._zero[1]),
        )
        said, self._said = self._said, b""
        return said

    def _answer(self, line: bytes, now_s: float) -> bytes:
        letter, *words = line.split(b" ")
        numbers = [_read_number(word) for word in [*words, b"", b""]]
        if letter == b"m":
            self._left_ticks, self._right_ticks = numbers[0], numbers[1]
            self._moved_s = now_s
            return b"OK"
        if letter == b"e":
            return b"%d %d" % self._counts
        return b"57600" if letter == b"b" else b"Invalid Command"

    def _count(self, angle_rad: float) -> int:
        return (floor(angle_rad / tau * self._ticks_per_turn) + _HALF) % _WRAP - _HALF


def _read_number(word: bytes) -> int:
    """Read as atoi does: what is no digit ends it, and 16 bits are all that fit."""
    digits = word.removeprefix(b"-")
    count = next((k for k, sign in enumerate(digits) if not 48 <= sign <= 57), len(digits))
    number = int(digits[:count][:9] or b"0")
    number = -number if word.startswith(b"-") else number
    return (number + _SHORT) % (2 * _SHORT) - _SHORT
