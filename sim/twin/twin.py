"""Stand between a serial line and the simulated body, as a base's controller does.

The firmware is pure: told bytes and the time, it says what the motors are to do and what goes back.
Its dead-man is the one that counts here; the body behind it is given a command every tick.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from sim.twin.arduino import ArduinoFirmware
from sim.twin.line import TwinLine
from sim.twin.pons_mcu import PonsMcuFirmware
from sim.twin.turtlebot3 import Turtlebot3Firmware
from sim.twin.waveshare import WaveshareFirmware
from wire import ConfigError, DriveCommand

if TYPE_CHECKING:
    from collections.abc import Mapping

    from wire import DriveState, Imu, RobotDescription

_FASTEST_RADPS = 1000.0


class Firmware(Protocol):
    """Act as one kind of base."""

    def hear(self, data: bytes, now_s: float) -> None:
        """Take the bytes that arrived."""

    def motors(self, now_s: float) -> tuple[float, float, bool]:
        """Return left and right [rad/s] and whether there is torque; the dead-man acts here."""

    def say(self, body: DriveState, now_s: float) -> bytes:
        """Return what is due to the host now, given what the body's sensors read."""


@runtime_checkable
class GyroFirmware(Protocol):
    """Act as a base that reports a gyro of its own."""

    def feel(self, imu: Imu) -> None:
        """Take what the body's gyro reads now."""


class FarEnd(Protocol):
    """Be the base's end of a serial line; never blocks."""

    def read(self) -> bytes:
        """Return the bytes that came."""

    def write(self, data: bytes) -> None:
        """Send bytes; what finds no room is lost."""

    def close(self) -> None:
        """Take the line away."""


Boot = Callable[["RobotDescription"], Firmware]
FIRMWARES: Mapping[str, Boot] = {
    "pons_mcu": lambda robot: PonsMcuFirmware(robot.drive),
    "waveshare": WaveshareFirmware,
    "arduino": ArduinoFirmware,
    "turtlebot3": Turtlebot3Firmware,
}
"""By ``kind`` of robot.toml."""


class DriveTwin:
    """Hold one firmware and its line."""

    def __init__(
        self, robot: RobotDescription, line: Path | FarEnd, boot: Boot | None = None
    ) -> None:
        """Boot the firmware of robot.toml's drive, or another, at a line.

        Args:
            robot: of robot.toml.
            line: the line's far end, or the path of a link that is to lead to its near end.
            boot: makes the firmware; the model of the drive's kind if None.

        Raises:
            ConfigError: ``twin_unknown``, ``twin_line``, or what ``boot`` raises.
        """
        self._robot = robot
        self._boot = boot or _model_of(robot)
        self.firmware = self._boot(robot)
        try:
            self.line = TwinLine(line) if isinstance(line, Path) else line
        except OSError as error:
            raise ConfigError("twin_line", f"{line}: {error.strerror}") from None
        self._seq = 0

    def command(self, now_s: float) -> DriveCommand:
        """Return what the firmware has the motors do in this tick."""
        self.firmware.hear(self.line.read(), now_s)
        left_radps, right_radps, torque = self.firmware.motors(now_s)
        self._seq += 1
        return DriveCommand(
            boot="twin",
            seq=self._seq,
            left_radps=_possible(left_radps),
            right_radps=_possible(right_radps),
            enable=torque,
        )

    @property
    def has_gyro(self) -> bool:
        """Return whether the base itself tells what its gyro reads."""
        return isinstance(self.firmware, GyroFirmware)

    def feel(self, imu: Imu) -> None:
        """Let the base's gyro read the body; it goes out with the next report."""
        if isinstance(self.firmware, GyroFirmware):
            self.firmware.feel(imu)

    def report(self, body: DriveState, now_s: float) -> None:
        """Tell the host what the body's sensors read."""
        data = self.firmware.say(body, now_s)
        if data:
            self.line.write(data)

    def reset(self) -> None:
        """Boot the firmware anew, as a controller does whose supply dipped."""
        self.firmware = self._boot(self._robot)

    def discard(self) -> None:
        """Throw away what came while this process was frozen; a controller would not have been."""
        while self.line.read():
            pass

    def close(self) -> None:
        """Take the line away."""
        self.line.close()


def _model_of(robot: RobotDescription) -> Boot:
    kind = robot.drive.kind
    if kind not in FIRMWARES:
        known = ", ".join(sorted(FIRMWARES))
        raise ConfigError("twin_unknown", f"drive.kind {kind!r} has no twin; these have: {known}")
    return FIRMWARES[kind]


def _possible(radps: float) -> float:
    return min(max(radps, -_FASTEST_RADPS), _FASTEST_RADPS)
