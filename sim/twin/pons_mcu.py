"""Act as a motor controller with the pons_mcu firmware (frames: devices/pons_mcu.py).

On silence it brakes at once and says so; a command that is older than the last within its boot, or
whose time to live is none that it may ask for, is no sign of life.
"""

from __future__ import annotations

import secrets
from math import floor, tau
from typing import TYPE_CHECKING

from devices import pons_mcu
from devices.pons_mcu import McuCommand, McuReader, McuState, encode_state

if TYPE_CHECKING:
    from wire import DriveState
    from wire.drive_config import DriveConfig

_WRAP = 1 << 32
_HALF = 1 << 31
_MICRO = 1e6
_MILLI = 1000.0
_FULL_MV, _EMPTY_MV = 12_600, 9_600
"""Three lithium cells, where robot.toml names no voltages."""


class PonsMcuFirmware:
    """Obey one host, count edges, and stop by itself."""

    def __init__(self, config: DriveConfig, boot: int | None = None) -> None:
        self._boot = boot or secrets.randbelow(_WRAP - 1) + 1
        self._ticks_per_turn = config.ticks_per_turn or 1
        self._empty_mv = (config.battery_empty_v or _EMPTY_MV / _MILLI) * _MILLI
        self._full_mv = (config.battery_full_v or _FULL_MV / _MILLI) * _MILLI
        self._reader = McuReader()
        self._command: McuCommand | None = None
        self._heard_s = 0.0
        self._timed_out = True
        self._seq = 0
        self._zero: tuple[float, float] | None = None

    def hear(self, data: bytes, now_s: float) -> None:
        """Take the bytes that arrived."""
        for frame in self._reader.read(data):
            if isinstance(frame, McuCommand) and self._is_fresh(frame):
                self._command, self._heard_s = frame, now_s

    def motors(self, now_s: float) -> tuple[float, float, bool]:
        """Return left and right [rad/s] and whether there is torque."""
        command = self._command
        age_s = now_s - self._heard_s
        alive = command is not None and 0.0 <= age_s <= command.ttl_ms / _MILLI
        self._timed_out = not alive
        if command is None or not alive or not command.flags & pons_mcu.ENABLE:
            return 0.0, 0.0, False
        return command.left_mradps / _MILLI, command.right_mradps / _MILLI, True

    def say(self, body: DriveState, now_s: float) -> bytes:
        """Return the state that is due, every tick: 100 Hz."""
        if self._zero is None:
            self._zero = body.left_rad, body.right_rad  # it counts from its own start
        command = self._command
        self._seq = (self._seq + 1) % _WRAP
        return encode_state(
            McuState(
                seq=self._seq,
                boot=self._boot,
                echo_boot=0 if command is None else command.boot,
                echo_seq=0 if command is None else command.seq,
                time_us=floor(now_s * _MICRO) % _WRAP,
                left_ticks=self._ticks(body.left_rad - self._zero[0]),
                right_ticks=self._ticks(body.right_rad - self._zero[1]),
                left_mradps=round(body.left_radps * _MILLI),
                right_mradps=round(body.right_radps * _MILLI),
                current_ma=pons_mcu.NOT_MEASURED,
                battery_mv=self._voltage_mv(body.battery),
                bits=self._bits(body),
            )
        )

    def _is_fresh(self, frame: McuCommand) -> bool:
        low_ms, high_ms = pons_mcu.TTL_MS
        if not (low_ms <= frame.ttl_ms <= high_ms and frame.ticks_per_turn == self._ticks_per_turn):
            return False
        last = self._command
        return last is None or frame.boot != last.boot or frame.seq > last.seq

    def _ticks(self, angle_rad: float) -> int:
        return (floor(angle_rad / tau * self._ticks_per_turn) + _HALF) % _WRAP - _HALF

    def _voltage_mv(self, charge: float | None) -> int:
        if charge is None:
            return pons_mcu.NOT_MEASURED
        return round(self._empty_mv + charge * (self._full_mv - self._empty_mv))

    def _bits(self, body: DriveState) -> int:
        bits = 0 if self._timed_out else self._torque_bit()
        bits |= pons_mcu.TIMED_OUT if self._timed_out else 0
        bits |= pons_mcu.STOP_PRESSED if body.estop_pressed else 0
        bits |= pons_mcu.BUMPER_FRONT if body.bumper_front else 0
        bits |= pons_mcu.BUMPER_REAR if body.bumper_rear else 0
        return bits | (pons_mcu.CLIFF if body.cliff else 0)

    def _torque_bit(self) -> int:
        command = self._command
        return pons_mcu.ENABLED if command is not None and command.flags & pons_mcu.ENABLE else 0
