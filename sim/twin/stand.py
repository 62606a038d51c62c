"""Play a base on a stand, wheels off the ground, whose wires may be wrong.

``python -m sim.twin.stand --robot robot.toml [--wrong NAME …]`` plays it at drive.port, and a lidar
at lidar.port, so that a trial (docs/robot-try.md) can be gone through without metal. Standard input
is the hands: ``left 3``, ``right 3`` turn a wheel, ``quarter`` turns the whole robot to the left,
which a base with a gyro feels, ``front``, ``side``, ``away`` hold a box.
"""

from __future__ import annotations

import argparse
import os
import select
import sys
import time
from dataclasses import dataclass, replace
from functools import partial
from math import cos, pi, radians, sin, tau
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from sim.twin.lidar import LidarTwin
from sim.twin.line import TwinLine
from sim.twin.twin import FIRMWARES, GyroFirmware
from wire import DriveState, Imu, load_robot

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from sim.twin.twin import FarEnd
    from wire import RobotDescription

TICK_S = 0.01
LAG_S = 0.03
HAND_TICKS = 200
ROOM_M, BOX_M, BOX_HALF_RAD = 3.0, 0.5, radians(12)
WHEELS = {"left": 0, "right": 1}
BOXES = {"front": 0.0, "side": pi / 2, "away": None}
HANDS = (*WHEELS, "quarter", *BOXES)
"""The words of the hands."""


@dataclass(frozen=True, slots=True)
class Wires:
    """Say what is wrong between controller and wheels, and at the lidar."""

    encoders_swapped: bool = False
    motors_swapped: bool = False
    encoder_sign: tuple[int, int] = (1, 1)
    motor_sign: tuple[int, int] = (1, 1)
    encoder_dead: tuple[bool, bool] = (False, False)
    motor_dead: tuple[bool, bool] = (False, False)
    ticks_times: float = 1.0
    """The encoder's true ticks over those of robot.toml."""
    rolls_radps: float = 0.0
    coast_s: float = LAG_S
    """Time constant of a wheel without torque."""
    deaf: bool = False
    """The base goes on with its last speeds in silence."""
    late_s: float = 0.0
    """So much later than its time-out it stops."""
    stop_pressed: bool = False
    battery: float = 0.8
    gyro_sign: int = 1
    lidar_mirrored: bool = False
    lidar_turned_rad: float = 0.0


WRONG: Final[dict[str, dict[str, Any]]] = {
    "encoders_swapped": {"encoders_swapped": True},
    "motors_swapped": {"motors_swapped": True},
    "left_encoder_reversed": {"encoder_sign": (-1, 1)},
    "right_encoder_reversed": {"encoder_sign": (1, -1)},
    "left_motor_reversed": {"motor_sign": (-1, 1)},
    "right_motor_reversed": {"motor_sign": (1, -1)},
    "ticks_half": {"ticks_times": 0.5},
    "ticks_double": {"ticks_times": 2.0},
    "deaf": {"deaf": True},
    "coasts": {"coast_s": 1.0},
    "stop_pressed": {"stop_pressed": True},
    "battery_empty": {"battery": 0.02},
    "gyro_reversed": {"gyro_sign": -1},
    "lidar_mirrored": {"lidar_mirrored": True},
    "lidar_turned": {"lidar_turned_rad": pi / 2},
}
"""By the name on the command line."""


class WheelStand:
    """Be controller and wheels at the far end of a line."""

    def __init__(self, robot: RobotDescription, wires: Wires, end: FarEnd, now_s: float) -> None:
        self.wires, self.end = wires, end
        self.firmware = FIRMWARES[robot.drive.kind](robot)
        self.radps, self.angle = [0.0, 0.0], [0.0, 0.0]
        self.fastest_radps = 0.0
        self._last: tuple[float, float, bool] = (0.0, 0.0, False)
        self._live_s = now_s
        self._integral = [0.0, 0.0]
        self._todo: list[tuple[int, float]] = []
        self._quarter_ticks = 0

    @property
    def is_turned(self) -> bool:
        """Tell whether hands turn a wheel or the robot now."""
        return bool(self._todo or self._quarter_ticks)

    def turn_by_hand(self, wheel: int, turns: float) -> None:
        """Begin to turn a wheel; it takes two seconds."""
        self._todo = [(wheel, turns)] * HAND_TICKS

    def turn_robot_by_hand(self) -> None:
        """Begin to turn the whole robot a quarter to the left; it takes two seconds."""
        self._quarter_ticks = HAND_TICKS

    def tick(self, now_s: float) -> None:
        """Live for 10 ms."""
        self._feel()
        if self._todo:
            wheel, turns = self._todo.pop()
            self.angle[wheel] += turns * tau / HAND_TICKS
        self.firmware.hear(self.end.read(), now_s)
        told = self.firmware.motors(now_s)
        if told[2]:
            self._last, self._live_s = told, now_s
        elif self.wires.deaf or now_s - self._live_s <= self.wires.late_s:
            told = self._last
        self._turn(told)
        data = self.firmware.say(self._body(), now_s)
        if data:
            self.end.write(data)

    def _feel(self) -> None:
        """Let the base's gyro read what hands do to the robot."""
        if not isinstance(self.firmware, GyroFirmware):
            self._quarter_ticks = 0
            return
        radps = pi / 2 / (HAND_TICKS * TICK_S) if self._quarter_ticks else 0.0
        self._quarter_ticks = max(0, self._quarter_ticks - 1)
        self.firmware.feel(
            Imu(
                boot_id="stand",
                seq=0,
                stamp_s=0.0,
                yaw_rate_radps=self.wires.gyro_sign * radps,
                accel_x_mps2=0.0,
                accel_y_mps2=0.0,
            )
        )

    def _turn(self, told: tuple[float, float, bool]) -> None:
        """Regulate each wheel by the encoder that its controller reads, as a base does."""
        torque = told[2]
        duty = [0.0, 0.0]
        for side in (0, 1):
            asked = told[side]
            if not torque:
                self._integral[side] = 0.0
                continue
            error = asked - self._encoder(side, self.radps)
            grown = self._integral[side] + 5.0 * error * TICK_S
            self._integral[side] = min(max(grown, -20.0), 20.0)
            duty[side] = min(max(asked + self._integral[side], -20.0), 20.0)
        for wheel in (0, 1):
            source = 1 - wheel if self.wires.motors_swapped else wheel
            wanted = duty[source] * self.wires.motor_sign[wheel]
            if self.wires.motor_dead[wheel]:
                wanted = 0.0
            lag_s = LAG_S if torque else self.wires.coast_s
            self.radps[wheel] += (wanted - self.radps[wheel]) * min(1.0, TICK_S / lag_s)
            self.angle[wheel] += (self.radps[wheel] + self.wires.rolls_radps) * TICK_S
            self.fastest_radps = max(self.fastest_radps, abs(self.radps[wheel]))

    def _encoder(self, side: int, values: list[float]) -> float:
        wheel = 1 - side if self.wires.encoders_swapped else side
        if self.wires.encoder_dead[wheel]:
            return 0.0
        return values[wheel] * self.wires.encoder_sign[wheel] * self.wires.ticks_times

    def _body(self) -> DriveState:
        return DriveState(
            boot_id="stand",
            seq=0,
            stamp_s=0.0,
            echo_boot=None,
            echo_seq=0,
            enabled=False,
            timed_out=None,
            left_rad=self._encoder(0, self.angle),
            right_rad=self._encoder(1, self.angle),
            left_radps=self._encoder(0, self.radps),
            right_radps=self._encoder(1, self.radps),
            estop_pressed=self.wires.stop_pressed,
            bumper_front=False,
            bumper_rear=False,
            cliff=False,
            battery=self.wires.battery,
        )


def see_box(
    towards_rad: Sequence[float], shown_rad: float | None, wires: Wires, yaw_rad: float = 0.0
) -> list[float]:
    """Return what beams of a lidar meet: a box held up in a direction of ``base``, or the room.

    Args:
        towards_rad: of each beam, in the lidar's frame.
        shown_rad: where the box is; None where none is held.
        wires: how the lidar is truly mounted, beyond what robot.toml says.
        yaw_rad: of robot.toml.
    """
    found = []
    for angle in towards_rad:
        seen = (-angle if wires.lidar_mirrored else angle) + yaw_rad + wires.lidar_turned_rad
        if shown_rad is None:
            found.append(ROOM_M)
            continue
        box = BOX_M * cos(shown_rad), BOX_M * sin(shown_rad)
        along = box[0] * cos(seen) + box[1] * sin(seen)
        across = abs(-box[0] * sin(seen) + box[1] * cos(seen))
        found.append(along if along > 0.0 and across < BOX_M * BOX_HALF_RAD else ROOM_M)
    return found


def _see(
    shown_rad: float | None, wires: Wires, yaw_rad: float, angles: NDArray[np.float64]
) -> tuple[float, ...]:
    return tuple(see_box(angles.tolist(), shown_rad, wires, yaw_rad))


def main(arguments: list[str] | None = None) -> int:
    """Play until standard input ends or a signal comes."""
    parser = argparse.ArgumentParser(prog="python -m sim.twin.stand", description=__doc__)
    parser.add_argument("--robot", type=Path, required=True, help="robot.toml; ports are made")
    parser.add_argument("--wrong", action="append", default=[], choices=WRONG, help="what is wrong")
    options = parser.parse_args(arguments)
    robot, wires = load_robot(options.robot), Wires()
    for name in options.wrong:
        wires = replace(wires, **WRONG[name])
    line = TwinLine(Path(robot.drive.port or ""))
    lidar = None
    if robot.lidar.has_line:
        lidar = LidarTwin(robot.lidar, Path(robot.lidar.port or ""))
    try:
        _play(WheelStand(robot, wires, line, time.monotonic()), lidar, robot)
    except KeyboardInterrupt:
        return 0
    finally:
        line.close()
        if lidar is not None:
            lidar.close()
    return 0


def _play(stand: WheelStand, lidar: LidarTwin | None, robot: RobotDescription) -> None:
    shown: float | None = None
    next_s = time.monotonic()
    while True:
        for word, turns in _orders():
            if word in BOXES:
                shown = BOXES[word]
            elif word == "quarter":
                stand.turn_robot_by_hand()
            else:
                stand.turn_by_hand(WHEELS[word], turns)
        now_s = time.monotonic()
        stand.tick(now_s)
        if lidar is not None:
            lidar.tick(now_s, partial(_see, shown, stand.wires, robot.lidar.yaw_rad))
        next_s = max(next_s + TICK_S, now_s)
        time.sleep(max(0.0, next_s - time.monotonic()))


def _orders() -> list[tuple[str, float]]:
    """Return what the hands are told now; an end of input ends the play."""
    if not select.select([sys.stdin], [], [], 0.0)[0]:
        return []
    data = os.read(sys.stdin.fileno(), 4096)
    if not data:
        raise KeyboardInterrupt
    return read_hands(data.decode("utf-8", "replace"))


def read_hands(text: str) -> list[tuple[str, float]]:
    """Return what lines of words mean; a word that hands don't know is told."""
    found = []
    for line in text.splitlines():
        word, _, turns = line.strip().partition(" ")
        try:
            count = float(turns or 3.0)
        except ValueError:
            word, count = "", 0.0
        if word in HANDS and -10.0 <= count <= 10.0:
            found.append((word, count))
        elif line.strip():
            told = f"hands know {', '.join(HANDS)}; left and right with turns, 10 at most\n"
            sys.stderr.write(told)
    return found


if __name__ == "__main__":
    sys.exit(main())
