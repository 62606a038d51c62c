"""Put a base on a stand: its wheels turn freely, and wires may be wrong."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi, tau
from typing import Literal

from bridge.drive import SerialDrive
from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from sim.twin.twin import FIRMWARES, GyroFirmware
from tests.wire.examples import EXAMPLES
from tools.lockstep.drive_process import BaseEnd
from tools.lockstep.serial_line import SerialLine
from wire import DriveCommand, DriveState, Imu, RobotDescription

TICK_S = 0.01
LAG_S = 0.03
START_S = 1000.0
HAND_TICKS = 200


@dataclass
class Wires:
    """Say what is wrong between controller and wheels."""

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


@dataclass
class Stand:
    """Be base, line, wheels, time and person; what a test tries is the shipped drive on it."""

    robot: RobotDescription
    wires: Wires = field(default_factory=Wires)
    hand: dict[str, tuple[Literal[0, 1], float]] = field(
        default_factory=lambda: {"hand_left": (0, 3.0), "hand_right": (1, 3.0)}
    )
    """Which wheel a person turns when asked, and how many turns."""

    def __post_init__(self) -> None:
        self.line = SerialLine(1)
        self.end = BaseEnd(self.line)
        self.firmware = FIRMWARES[self.robot.drive.kind](self.robot)
        protocol = SERIAL_PROTOCOLS[self.robot.drive.kind](self.robot, "trial")
        self.drive = SerialDrive(protocol, self.line, "trial", self.now_s)
        self.time_s = START_S
        self.radps = [0.0, 0.0]
        self.angle = [0.0, 0.0]
        self.asked: list[str] = []
        self.fastest_radps = 0.0
        self._last: tuple[float, float, bool] = (0.0, 0.0, False)
        self._live_s = START_S
        self._integral = [0.0, 0.0]
        self._todo: list[tuple[int, float]] = []
        self._turns_left = False
        self._seq = 0

    def now_s(self) -> float:
        """Return the time [s]."""
        return self.time_s

    def ask(self, code: str) -> None:
        """Begin to do what a person is asked to do; it takes two seconds."""
        self.asked.append(code)
        self._todo = [self.hand.get(code, (0, 0.0))] * HAND_TICKS
        self._turns_left = code == "gyro_left"

    def has_answered(self) -> bool:
        """Tell whether it is done."""
        return not self._todo

    def wait(self) -> None:
        """Let 10 ms pass."""
        self.time_s += TICK_S
        if self._todo:
            wheel, turns = self._todo.pop()
            self.angle[wheel] += turns * tau / HAND_TICKS
        self.firmware.hear(self.end.read(), self.time_s)
        told = self.firmware.motors(self.time_s)
        if told[2]:
            self._last, self._live_s = told, self.time_s
        elif self.wires.deaf or self.time_s - self._live_s <= self.wires.late_s:
            told = self._last
        self._turn(told)
        if isinstance(self.firmware, GyroFirmware):
            self.firmware.feel(self._gyro())
        data = self.firmware.say(self._body(), self.time_s)
        if data:
            self.end.write(data)

    def command_zero(self) -> None:
        """Tell the base to stand, as whoever drives it does."""
        self._seq += 1
        self.drive.write(
            DriveCommand(boot="trial", seq=self._seq, left_radps=0.0, right_radps=0.0, enable=False)
        )

    def _gyro(self) -> Imu:
        """Read what a hand that turns the whole robot a quarter to the left does to it."""
        radps = pi / 2 / (HAND_TICKS * TICK_S) if self._todo and self._turns_left else 0.0
        imu = EXAMPLES[Imu]
        assert isinstance(imu, Imu)
        return imu.model_copy(update={"yaw_rate_radps": radps})

    def _turn(self, told: tuple[float, float, bool]) -> None:
        """Regulate each wheel by the encoder that its controller reads, as a base does."""
        torque = told[2]
        duty = [0.0, 0.0]
        for side in (0, 1):
            asked = told[side]
            if not torque:
                self._integral[side] = 0.0
                continue
            error = asked - self._encoder_radps(side)
            self._integral[side] = min(
                max(self._integral[side] + 5.0 * error * TICK_S, -20.0), 20.0
            )
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

    def _encoder_radps(self, side: int) -> float:
        return self._encoder(side, self.radps)

    def _body(self) -> DriveState:
        body = EXAMPLES[DriveState]
        assert isinstance(body, DriveState)
        return body.model_copy(
            update={
                "left_rad": self._encoder(0, self.angle),
                "right_rad": self._encoder(1, self.angle),
                "left_radps": self._encoder(0, self.radps),
                "right_radps": self._encoder(1, self.radps),
                "estop_pressed": self.wires.stop_pressed,
                "bumper_front": False,
                "bumper_rear": False,
                "cliff": False,
            }
        )
