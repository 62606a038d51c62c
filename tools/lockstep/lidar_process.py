"""Be a lidar's twin, its line and its process, one turn per tick: bytes in memory, no terminal.

Knows the bus; decides nothing about driving.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from sensors.lidar.kinds import kind_of
from sensors.lidar.reader import LidarReader
from sim.twin.lidar import LidarFirmware
from tools.lockstep.serial_line import PATH, SerialLine
from wire import keys

if TYPE_CHECKING:
    from lockstep.bus import Port
    from sim import SimRobot
    from wire import LidarStatus

STATE_TICKS = 50


class LidarProcess:
    """Connect a lidar's twin, by a line and the shipped reader, to the bus."""

    def __init__(self, robot: SimRobot, port: Port, seed: int) -> None:
        self._robot = robot
        self._firmware = LidarFirmware(robot.robot.lidar)
        self.line = SerialLine(seed)
        self.reader = LidarReader(kind_of(robot.robot.lidar), self.line, str(PATH), "lidar")
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
