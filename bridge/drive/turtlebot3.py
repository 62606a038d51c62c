"""Drive a TurtleBot 3 through its OpenCR board (table: devices/turtlebot3.py).

The heartbeat, a byte that must change, carries the low bits of the command's number, and the
board's table shows it again beside the twist that it holds: an echo, where both belong
together. Half a second after the last beat the board stands; it does not say so. Its servos keep
their torque and hold speed 0, which is how it brakes.
"""

from __future__ import annotations

import logging
from collections import deque
from dataclasses import dataclass, field
from math import tau
from typing import TYPE_CHECKING, NamedTuple

from bridge.drive.base_gyro import BaseGyro
from bridge.drive.base_trouble import BASE_TROUBLES
from bridge.drive.readings import WheelCount, limit_radps
from devices import turtlebot3
from devices.clock import SensorClock, WrappedCounter
from devices.dynamixel import STATUS, DynamixelReader
from devices.turtlebot3 import (
    BOARD,
    MODELS,
    RADPS_A_STEP,
    SEPARATIONS_M,
    STEPS_A_UNIT,
    TICKS_PER_TURN,
    WHEEL_RADIUS_M,
)
from wire import DriveState

if TYPE_CHECKING:
    from bridge.drive.base import Braking
    from devices.turtlebot3 import OpenCrTable
    from wire import DriveCommand, RobotDescription

log = logging.getLogger("bridge.drive")

KEPT = 100
"""Commands that an echo may name; 255 would let a byte mean two."""
_BEATS = 256
_WRAP_MS = 1 << 32
_BACK_MS = 1 << 31


class _SentCommand(NamedTuple):
    seq: int
    twist: tuple[int, int]
    enable: bool


@dataclass(slots=True)
class _KnownBoard:
    """Hold what is known of a board since it began."""

    sent: deque[_SentCommand] = field(default_factory=lambda: deque(maxlen=KEPT))
    echo: _SentCommand | None = None
    last_ms: int | None = None
    clock: SensorClock = field(default_factory=SensorClock)
    millis: WrappedCounter = field(default_factory=lambda: WrappedCounter(_WRAP_MS))
    left: WheelCount = field(default_factory=WheelCount)
    right: WheelCount = field(default_factory=WheelCount)


class Turtlebot3Protocol:
    """Translate between the wire's messages and the board's table."""

    kind = "turtlebot3"
    baud = turtlebot3.BAUD
    """Nominal: its USB port has none. Command, beat and question are 64 bytes, the answer 195."""
    braking: Braking = "brake"

    def __init__(self, robot: RobotDescription, boot: str) -> None:
        self._separation_m = robot.base.wheel_separation_m
        """Until the board has told its model."""
        self.gyro = BaseGyro(robot)
        self._boot = boot
        self._reader = DynamixelReader()
        self._seq, self._starts = 0, 0
        self.trouble: str | None = None
        self._moves = False
        self._board = _KnownBoard()

    def begin(self) -> bytes:
        """Forget the unfinished frame and the board; it needs no greeting."""
        self._reader.reset()
        self._forget()
        return b""

    def encode(self, command: DriveCommand) -> bytes:
        """Return the frames of every second command, and ask for the table in between.

        The board takes a frame once a turn of its loop, and fills its table every 20 ms.
        """
        moves = command.enable and not command.left_radps == command.right_radps == 0.0
        stops, self._moves = self._moves and not moves, moves
        if command.seq % 2 and not stops:
            return turtlebot3.encode_question()
        twist = self._twist_of(command) if moves else (0, 0)
        self._board.sent.append(_SentCommand(command.seq, twist, command.enable))
        return turtlebot3.encode_command(*twist) + turtlebot3.encode_heartbeat(command.seq)

    def question(self, seq: int) -> bytes:
        """Return the question for the table alone, every second time; no beat goes with it."""
        return turtlebot3.encode_question() if seq % 2 else b""

    @property
    def spoilt(self) -> int:
        """Return how many bytes belonged to no good frame."""
        return self._reader.spoilt_bytes

    def decode(self, data: bytes, now_s: float) -> list[DriveState]:
        """Return the states that bytes read at ``now_s`` complete, oldest first."""
        states: list[DriveState] = []
        for frame in self._reader.read(data):
            if (frame.id, frame.instruction) != (BOARD, STATUS):
                continue
            table = turtlebot3.decode_table(frame.parameters)
            if table is not None and self._knows(table):
                states.append(self._state(table, now_s))
        return states

    def _twist_of(self, command: DriveCommand) -> tuple[int, int]:
        """Return the steps that the board turns into these wheel speeds by its own geometry."""
        left_mps = command.left_radps * WHEEL_RADIUS_M
        right_mps = command.right_radps * WHEEL_RADIUS_M
        linear, angular = (left_mps + right_mps) / 2.0, (right_mps - left_mps) / self._separation_m
        return round(linear * STEPS_A_UNIT), round(angular * STEPS_A_UNIT)

    def _knows(self, table: OpenCrTable) -> bool:
        """Tell whether the board is one that can be driven now; say once why it is not."""
        code = None
        if table.model not in SEPARATIONS_M:
            code = "base_model_unknown"
        elif table.device_status < 0:
            code = "base_motors_missing"
        if code is not None and code != self.trouble:
            words = BASE_TROUBLES[code][0]
            known = ", ".join(f"{number} ({name})" for number, name in MODELS.items())
            log.error("%s: %s; its model is %d, of %s", code, words, table.model, known)
        self.trouble = code
        if code is None:
            self._separation_m = SEPARATIONS_M[table.model]
        return code is None

    def _state(self, table: OpenCrTable, now_s: float) -> DriveState:
        last_ms = self._board.last_ms
        if last_ms is not None and 0 < (last_ms - table.millis) % _WRAP_MS < _BACK_MS:
            log.warning("base_reset: its clock went back from %d to %d ms", last_ms, table.millis)
            self._forget()
        self._board.last_ms = table.millis
        stamp_s = self._board.clock.note(self._board.millis.unwrap(table.millis) * 1e-3, now_s)
        self._board.left.add(self._board.left.step(table.left_ticks), now_s)
        self._board.right.add(self._board.right.step(table.right_ticks), now_s)
        self._note_echo(table)
        self._seq += 1
        echo, rad = self._board.echo, tau / TICKS_PER_TURN
        state = DriveState(
            boot_id=f"opencr-{self._starts}",
            seq=self._seq,
            stamp_s=stamp_s,
            echo_boot=None if echo is None else self._boot,
            echo_seq=0 if echo is None else echo.seq,
            enabled=echo is not None and echo.enable and table.torque,
            timed_out=None,
            left_rad=self._board.left.whole * rad,
            right_rad=self._board.right.whole * rad,
            left_radps=limit_radps(table.left_step * RADPS_A_STEP),
            right_radps=limit_radps(table.right_step * RADPS_A_STEP),
            battery=table.battery_share if table.battery_v > 0.0 else None,
            estop_pressed=False,
            bumper_front=table.bumpers[0],
            bumper_rear=table.bumpers[1],
            cliff=False,
        )
        self.gyro.note(table.inertial, state)
        return state

    def _note_echo(self, table: OpenCrTable) -> None:
        """Note which command the table shows: the newest with its beat, if its twist is there too.

        Between a command and its beat the table shows the one with the other's twist; then what was
        known stays.
        """
        twist = (table.linear_cmps, table.angular_cradps)
        for sent in reversed(self._board.sent):
            if sent.seq % _BEATS == table.heartbeat:
                if sent.twist == twist:
                    self._board.echo = sent
                return

    def _forget(self) -> None:
        self._starts += 1
        self._board = _KnownBoard()
