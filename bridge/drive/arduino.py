"""Drive an Arduino with ros_arduino_bridge (lines: devices/ros_arduino.py).

Its answers come in order and carry no number, so that the bridge counts: the oldest question not
yet answered is the one that is answered now. Where a line does not fit, the order is lost; nothing
is asked until the line was silent, so that no late answer is taken for another's. A stop goes out
even then. Speeds are taken from the counts.
"""

from __future__ import annotations

import logging
from collections import deque
from dataclasses import dataclass, field
from math import tau
from typing import TYPE_CHECKING

from bridge.drive.readings import WheelCount, limit_radps
from devices import ros_arduino
from devices.ros_arduino import ArduinoCounts, ArduinoOk, ArduinoReader
from wire import DriveState

if TYPE_CHECKING:
    from bridge.drive.base import Braking
    from devices.ros_arduino import ArduinoLine
    from wire import DriveCommand, RobotDescription

log = logging.getLogger("bridge.drive")

BOOT_TICKS = 250
"""Opening the port resets most Arduinos, and whoever speaks to one that loads keeps it loading."""
QUIET_TICKS = 6
"""An answer takes 7 ms, and 16 more in some USB adapters: after 60 ms of silence none comes."""
LATE_TICKS = 10
MOST_ASKED = 8
STOP_SENDS = 5
"""A stop is sent so often in a row, whatever the line's state: one may be lost."""
SILENT_S = 0.4
"""It answers 50 times a second, and starts for longer: what answers after that is another."""
_MOST_TICKS_A_S = 200_000
_FRESH_TICKS = 2_000
"""Counts of a base that began a moment ago; a spoilt line seldom holds so few."""


@dataclass(slots=True)
class _AskedMove:
    """Hold a command that was sent and what came back of it."""

    seq: int
    enable: bool
    age: int = 0
    """Ticks since it was sent."""
    is_heard: bool = False
    """Its OK came; its counts are due."""


@dataclass(slots=True)
class _KnownArduino:
    """Hold what is known of a base since it began."""

    is_lost: bool = True
    """The order of its answers; nothing that it says counts until it was silent."""
    asked: deque[_AskedMove] = field(default_factory=deque)
    echo: _AskedMove = field(default_factory=lambda: _AskedMove(0, enable=False))
    heard_s: float | None = None
    is_told: bool = False
    """That it is out of step; said once until it is in step again."""
    left: WheelCount = field(default_factory=WheelCount)
    right: WheelCount = field(default_factory=WheelCount)


class ArduinoProtocol:
    """Translate between the wire's messages and the base's lines."""

    kind = "arduino"
    baud = ros_arduino.BAUD
    """A command with its question of 14 bytes and 26 bytes of answers 50 times a second: 7 and 13
    kbaud of 57."""
    gyro = None
    braking: Braking = "brake"
    """L298 with its enables high and both inputs low, as the firmware leaves them at 0."""

    def __init__(self, robot: RobotDescription, boot: str) -> None:
        if robot.drive.ticks_per_turn is None:
            raise ValueError("ticks_per_turn: robot.toml is refused without it")
        self._rad = tau / robot.drive.ticks_per_turn
        self._boot = boot
        self._reader = ArduinoReader()
        self._seq, self._starts = 0, 0
        self._stops, self._quiet = 0, BOOT_TICKS
        self._base = _KnownArduino()

    def begin(self) -> bytes:
        """Forget the unfinished line and the base; it is left alone until it must have started."""
        self._reader.reset()
        self._forget()
        self._quiet = BOOT_TICKS
        return b""

    def encode(self, command: DriveCommand) -> bytes:
        """Return every second command with the question for the counts, and each that stops."""
        moves = command.enable and not command.left_radps == command.right_radps == 0.0
        if moves:
            self._stops = STOP_SENDS
        must_stop = not moves and self._stops > 0
        if not must_stop and not self._may_ask(command.seq):
            return b""
        self._stops -= must_stop
        if len(self._base.asked) >= MOST_ASKED:
            self._lose_order("it does not answer")
        self._base.asked.append(_AskedMove(command.seq, command.enable))
        scale = 1.0 / (self._rad * ros_arduino.FRAMES_HZ) if moves else 0.0
        return ros_arduino.encode_move(
            round(command.left_radps * scale), round(command.right_radps * scale)
        )

    def question(self, seq: int) -> bytes:
        """Return the question for the counts alone: it is no command, and stops no time-out."""
        if not self._may_ask(seq):
            return b""
        echo = self._base.echo
        self._base.asked.append(_AskedMove(echo.seq, echo.enable, is_heard=True))
        return ros_arduino.encode_question()

    @property
    def spoilt(self) -> int:
        """Return how many lines could not be read."""
        return self._reader.spoilt_lines

    def decode(self, data: bytes, now_s: float) -> list[DriveState]:
        """Return the states that bytes read at ``now_s`` complete, oldest first."""
        if data and self._base.is_lost:
            self._quiet = max(self._quiet, QUIET_TICKS)
        states: list[DriveState] = []
        for line in self._reader.read(data):
            state = self._take(line, now_s)
            if state is not None:
                states.append(state)
        return states

    def _may_ask(self, seq: int) -> bool:
        """Tell whether this tick asks; where the order is lost, wait for silence."""
        self._quiet = max(0, self._quiet - 1)
        for asked in self._base.asked:
            asked.age += 1
        if self._base.asked and self._base.asked[0].age > LATE_TICKS:
            self._lose_order("an answer is missing")
        if self._quiet > 0:
            return False
        if self._base.is_lost:
            self._base.is_lost = False
            self._base.asked.clear()
            self._reader.reset()
        return seq % 2 == 0

    def _take(self, line: ArduinoLine, now_s: float) -> DriveState | None:
        if self._base.is_lost or not self._base.asked:
            return None
        oldest = self._base.asked[0]
        match line:
            case ArduinoOk() if not oldest.is_heard:
                oldest.is_heard = True
            case ArduinoCounts() if oldest.is_heard:
                self._base.asked.popleft()
                self._base.echo = oldest
                return self._state(line, now_s)
            case _:
                self._lose_order(f"it said {line}")
        return None

    def _state(self, counts: ArduinoCounts, now_s: float) -> DriveState | None:
        if self._base.heard_s is not None and now_s - self._base.heard_s > SILENT_S:
            log.warning("base_reset: it was silent for %.1f s", now_s - self._base.heard_s)
            echo = self._base.echo
            self._forget()
            self._base.echo = echo
        self._base.is_told = False
        dt_s = now_s - (self._base.heard_s or now_s)
        self._base.heard_s = now_s
        left, right = self._base.left.step(counts.left), self._base.right.step(counts.right)
        if max(abs(left), abs(right)) > _MOST_TICKS_A_S * max(dt_s, 0.02):
            fresh = max(abs(counts.left), abs(counts.right)) <= _FRESH_TICKS
            why = "it counts from nought" if fresh else "not to nought: a line was spoilt"
            code = "base_reset" if fresh else "base_spoilt"
            log.warning("%s: its counts jumped by %d and %d, %s", code, left, right, why)
            self._forget()
            return None
        self._base.left.add(left, now_s)
        self._base.right.add(right, now_s)
        self._seq += 1
        return DriveState(
            boot_id=f"arduino-{self._starts}",
            seq=self._seq,
            stamp_s=now_s,
            echo_boot=self._boot,
            echo_seq=self._base.echo.seq,
            enabled=self._base.echo.enable,
            timed_out=None,
            left_rad=self._base.left.whole * self._rad,
            right_rad=self._base.right.whole * self._rad,
            left_radps=limit_radps(self._base.left.ticks_a_s() * self._rad),
            right_radps=limit_radps(self._base.right.ticks_a_s() * self._rad),
            estop_pressed=False,
            bumper_front=False,
            bumper_rear=False,
            cliff=False,
        )

    def _lose_order(self, why: str) -> None:
        if not self._base.is_told and self._base.heard_s is not None:
            log.warning("base_out_of_step: %s; asked anew after a silence", why)
            self._base.is_told = True
        self._base.is_lost = True
        self._quiet = max(self._quiet, QUIET_TICKS)
        self._base.asked.clear()

    def _forget(self) -> None:
        self._starts += 1
        self._quiet = max(self._quiet, QUIET_TICKS)
        self._base = _KnownArduino()
