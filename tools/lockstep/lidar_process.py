"""Be a lidar's twin, its line and its process, one turn per tick: bytes in memory, no terminal.

The line can be spoilt as lines of metal are. Knows the bus; decides nothing about driving.
"""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING

from devices import PortTrouble
from sensors.lidar.kinds import kind_of
from sensors.lidar.reader import LidarReader
from sim.twin.lidar import LidarFirmware
from wire import keys

if TYPE_CHECKING:
    from sim import SimRobot
    from tools.lockstep.bus import Port
    from wire import LidarStatus

STATE_TICKS = 50
_PATH = Path("/dev/lidar")


class LineFault(StrEnum):
    """Name what a line does to bytes."""

    GARBAGE = "garbage"
    """Each byte is another one in one of ten cases."""
    CUT = "cut"
    """Runs of bytes are missing."""
    FLIPPED = "flipped"
    """One bit in a hundred bytes is another."""
    SILENT = "silent"
    HUNG_UP = "hung_up"
    WRONG_BAUD = "wrong_baud"


class LidarLine:
    """Carry bytes between a lidar and its reader as a port that can be pulled."""

    def __init__(self, seed: int) -> None:
        self.opened = 1
        self.trouble: PortTrouble | None = None
        self.fault: LineFault | None = None
        self.heard = b""
        self._coming = b""
        self._random = Random(f"line {seed}")

    def read(self) -> bytes:
        """Return the bytes that came."""
        data, self._coming = self._coming, b""
        return data

    def write(self, data: bytes) -> bool:
        """Take a whole message or nothing."""
        if self.trouble is not None:
            return False
        if self.fault not in (LineFault.WRONG_BAUD, LineFault.SILENT):
            self.heard += data
        return True

    def take_heard(self) -> bytes:
        """Return what the lidar was told."""
        data, self.heard = self.heard, b""
        return data

    def put(self, data: bytes) -> None:
        """Send bytes the lidar's way, as the line lets them."""
        if self.trouble is None:
            self._coming += self._spoil(data)

    def break_down(self, fault: LineFault | None) -> None:
        """Let one fault stand from now on, or none."""
        if fault is LineFault.HUNG_UP:
            self.trouble = PortTrouble("port_gone", _PATH, "it was hung up")
            self._coming = b""
        elif self.trouble is not None:
            self.trouble = None
            self.opened += 1
        self.fault = fault

    def _spoil(self, data: bytes) -> bytes:
        random = self._random
        if self.fault is LineFault.SILENT:
            return b""
        if self.fault is LineFault.WRONG_BAUD:
            return random.randbytes(len(data))
        if self.fault is LineFault.GARBAGE:
            return bytes(random.randrange(256) if random.random() < 0.1 else b for b in data)
        if self.fault is LineFault.FLIPPED:
            flips = (random.random() < 0.01 for _ in data)
            return bytes(
                b ^ (1 << random.randrange(8)) if flip else b
                for b, flip in zip(data, flips, strict=True)
            )
        if self.fault is LineFault.CUT and data and random.random() < 0.3:
            start = random.randrange(len(data))
            return data[:start] + data[start + random.randint(1, 60) :]
        return data


class LidarProcess:
    """Connect a lidar's twin, by a line and the shipped reader, to the bus."""

    def __init__(self, robot: SimRobot, port: Port, seed: int) -> None:
        self._robot = robot
        self._firmware = LidarFirmware(robot.robot.lidar)
        self.line = LidarLine(seed)
        self.reader = LidarReader(kind_of(robot.robot.lidar), self.line, str(_PATH), "lidar")
        self._scan = port.publisher(keys.SCAN)
        self._state = port.publisher(keys.LIDAR_STATE)
        self._turns = 0
        self.said: LidarStatus | None = None

    def turn(self, now_s: float) -> None:
        """Let the lidar send, read it, say what it saw and how well it was read."""
        troubles = self._robot.faults.of_sensor("lidar")
        heard = self.line.take_heard()
        self.line.put(self._firmware.tick(heard, now_s, self._robot.look, troubles))
        for scan in self.reader.turn(now_s):
            self._scan.put(scan)
        self._turns += 1
        if self._turns % STATE_TICKS == 0:
            self.said = self.reader.status(self._turns // STATE_TICKS, now_s)
            self._state.put(self.said)
