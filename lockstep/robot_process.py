"""Be the robot's process, one turn per tick. Knows no planner."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wire import keys

if TYPE_CHECKING:
    from lockstep.bus import Port
    from lockstep.parts import LineBase
    from sim import Report, SimRobot


class RobotProcess:
    """Connect a simulated robot to the bus."""

    def __init__(self, robot: SimRobot, port: Port, base: LineBase | None = None) -> None:
        """Take commands from the wire, or from a base on a line, which then has the answers."""
        self.robot = robot
        self._base = base
        self._base_tells = base is not None and base.twin.has_gyro and not robot.robot.imu.is_on_i2c
        self._commands = port.subscriber(keys.DRIVE_COMMAND)
        self._drive = port.publisher(keys.DRIVE_STATE)
        self._imu = port.publisher(keys.IMU)
        self._scan = port.publisher(keys.SCAN)
        self._truth = port.publisher(keys.SIM_TRUTH)

    def turn(self, now_s: float) -> None:
        """Take the newest command, advance the physics by a tick, report."""
        command = self._commands.newest()
        if self._base is not None:
            command = self._base.twin.command(now_s)
        if command is not None:
            self.robot.command(command, now_s)
        self._say(self.robot.tick(now_s), now_s)

    def _say(self, report: Report, now_s: float) -> None:
        if report.imu is not None and self._base is not None and self._base_tells:
            self._base.twin.feel(report.imu)
        elif report.imu is not None:
            self._imu.put(report.imu)
        if report.drive is not None and self._base is not None:
            self._base.twin.report(report.drive, now_s)
        elif report.drive is not None:
            self._drive.put(report.drive)
        if report.scan is not None:
            self._scan.put(report.scan)
        if report.truth is not None:
            self._truth.put(report.truth)
