"""Speak to a motor controller with the pons_mcu firmware (frames: devices/pons_mcu.py).

Its dead-man is the time to live in each command, so robot.toml's ``timeout_s`` is in force from the
first one and a controller reset in mid-drive needs no telling. It counts edges and closes its own
loop on speed; what lies between a wheel and its radius is robot.toml's.
"""

from __future__ import annotations

import logging
import secrets
from math import tau
from typing import TYPE_CHECKING

from bridge.drive.base_trouble import BASE_TROUBLES
from bridge.drive.readings import charge_of, limit_radps
from devices import pons_mcu
from devices.clock import SensorClock, WrappedCounter
from devices.pons_mcu import McuCommand, McuReader, McuState
from wire import DriveState

if TYPE_CHECKING:
    from bridge.drive.base import Braking
    from wire import DriveCommand
    from wire.drive_config import DriveConfig

log = logging.getLogger("bridge.drive")

_TURN_US = 1 << 32
_SEQ = 1 << 32
_TICKS = 1 << 32
_MILLI = 1000.0
FOREIGN = "base_firmware_other"
_FOREIGN = 5
"""So many frames that check by chance in noise: odds of 2^-80."""


class PonsMcuProtocol:
    """Translate between the wire's messages and the controller's frames."""

    kind = "pons_mcu"
    baud = 115_200
    """29 bytes to the controller and 47 from it, 100 times a second: 29 and 47 kbaud."""
    gyro = None
    braking: Braking = "brake"

    def __init__(self, config: DriveConfig, boot: str) -> None:
        if config.ticks_per_turn is None:
            raise ValueError("ticks_per_turn: robot.toml is refused without it")
        self._config = config
        self._boot = boot
        self._number = secrets.randbelow(_SEQ - 1) + 1
        """Stands for ``boot`` in 32 bits; another bridge has the same with odds of 2^-32."""
        self._ticks_per_turn = config.ticks_per_turn
        self._ttl_ms = round(config.timeout_s * _MILLI)
        self._reader = McuReader()
        self._clock = SensorClock()
        self._time_us = WrappedCounter(_TURN_US)
        self._left, self._right = _TickCount(), _TickCount()
        self._mcu: int | None = None
        self._tripped = self._is_foreign = False

    def begin(self) -> bytes:
        """Forget the unfinished frame and the controller's clock; it needs no greeting."""
        self._reader.reset()
        self._forget()
        return b""

    def encode(self, command: DriveCommand) -> bytes:
        """Return the frame of a command."""
        return pons_mcu.encode_command(
            McuCommand(
                seq=command.seq % _SEQ,
                boot=self._number,
                left_mradps=round(command.left_radps * _MILLI),
                right_mradps=round(command.right_radps * _MILLI),
                ticks_per_turn=self._ticks_per_turn,
                ttl_ms=self._ttl_ms,
                flags=pons_mcu.ENABLE if command.enable else 0,
            )
        )

    @property
    def trouble(self) -> str | None:
        """Return what is known to be wrong: frames of another version, and none of ours."""
        return FOREIGN if self._is_foreign and self._mcu is None else None

    def question(self, seq: int) -> bytes:
        """Return nothing: the base speaks by itself."""
        return b""

    @property
    def spoilt(self) -> int:
        """Return how many bytes belonged to no good frame."""
        return self._reader.spoilt_bytes

    def decode(self, data: bytes, now_s: float) -> list[DriveState]:
        """Return the states that bytes read at ``now_s`` complete, oldest first."""
        frames = self._reader.read(data)
        if self._reader.foreign_frames >= _FOREIGN and not self._is_foreign:
            self._is_foreign = True
            log.warning("%s: %s", FOREIGN, BASE_TROUBLES[FOREIGN][0])
        return [self._state(frame, now_s) for frame in frames if isinstance(frame, McuState)]

    def _state(self, frame: McuState, now_s: float) -> DriveState:
        if frame.boot != self._mcu:
            self._forget()
            self._mcu = frame.boot
        self._note_trip(tripped=bool(frame.bits & pons_mcu.TRIPPED))
        rad = tau / self._ticks_per_turn
        bits = frame.bits
        return DriveState(
            boot_id=f"mcu-{frame.boot:08x}",
            seq=frame.seq,
            stamp_s=self._clock.note(self._time_us.unwrap(frame.time_us) * 1e-6, now_s),
            echo_boot=self._name_of(frame.echo_boot),
            echo_seq=frame.echo_seq,
            enabled=bool(bits & pons_mcu.ENABLED),
            timed_out=bool(bits & pons_mcu.TIMED_OUT),
            left_rad=self._left.unwrap(frame.left_ticks) * rad,
            right_rad=self._right.unwrap(frame.right_ticks) * rad,
            left_radps=limit_radps(frame.left_mradps / _MILLI),
            right_radps=limit_radps(frame.right_mradps / _MILLI),
            current_a=_read_optional(frame.current_ma),
            battery=charge_of(_read_optional(frame.battery_mv), self._config),
            estop_pressed=bool(bits & pons_mcu.STOP_PRESSED),
            bumper_front=bool(bits & pons_mcu.BUMPER_FRONT),
            bumper_rear=bool(bits & pons_mcu.BUMPER_REAR),
            cliff=bool(bits & pons_mcu.CLIFF),
        )

    def _note_trip(self, *, tripped: bool) -> None:
        """Log once that the controller took the torque away itself; the rows name what follows."""
        if tripped and not self._tripped:
            log.warning(
                "base_tripped: a wheel stood or turned the wrong way under power, or drew too much "
                "current; arm anew once it is mended (docs/firmware.md)"
            )
        self._tripped = tripped

    def _name_of(self, number: int) -> str | None:
        """Return which bridge the controller obeys, by the name that the core knows it by."""
        if number == 0:
            return None
        return self._boot if number == self._number else f"other-{number:08x}"

    def _forget(self) -> None:
        self._clock.reset()
        self._time_us = WrappedCounter(_TURN_US)
        self._left, self._right = _TickCount(), _TickCount()


class _TickCount:
    """Unwrap a signed 32-bit count of a wheel, which goes both ways."""

    def __init__(self) -> None:
        self._last: int | None = None
        self._whole = 0

    def unwrap(self, ticks: int) -> int:
        step = 0 if self._last is None else (ticks - self._last + _TICKS // 2) % _TICKS
        self._whole = ticks if self._last is None else self._whole + step - _TICKS // 2
        self._last = ticks
        return self._whole


def _read_optional(value: int) -> float | None:
    return None if value == pons_mcu.NOT_MEASURED else value / _MILLI
