"""Be a base of metal on a serial line, one turn per tick: firmware, bytes in memory, shipped drive.

The firmware is the kind's model, or the pons_mcu firmware's own bytes on a simulated board.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from bridge.drive import SerialDrive
from bridge.drive.serial_drive import SERIAL_PROTOCOLS
from sim.twin import DriveTwin
from tools.lockstep.serial_line import SerialLine

if TYPE_CHECKING:
    from collections.abc import Callable

    from sim import SimRobot
    from sim.twin.twin import Boot


class BaseEnd:
    """Be the base's end of a line in memory."""

    def __init__(self, line: SerialLine) -> None:
        self._line = line

    def read(self) -> bytes:
        """Return the bytes that came."""
        return self._line.take_heard()

    def write(self, data: bytes) -> None:
        """Send bytes, as the line lets them."""
        self._line.put(data)

    def close(self) -> None:
        """Do nothing: it is memory."""


class DriveProcess:
    """Hold a base's firmware, its line, and the drive that the bridge speaks to it with."""

    def __init__(
        self,
        robot: SimRobot,
        boot: str,
        seed: int,
        clock: Callable[[], float],
        firmware: Boot | None = None,
    ) -> None:
        described = robot.robot
        self.line = SerialLine(seed)
        self.twin = DriveTwin(described, BaseEnd(self.line), firmware)
        protocol = SERIAL_PROTOCOLS[described.drive.kind](described, boot)
        self.drive = SerialDrive(protocol, self.line, boot, clock)
