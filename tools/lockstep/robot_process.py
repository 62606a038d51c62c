"""Be the robot's process and the localization stand-in's, one turn per tick. Knows no planner."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wire import Odometry, SimTruth, keys

if TYPE_CHECKING:
    from localization.standin import StandIn
    from sim import Report, SimRobot
    from tools.lockstep.bus import Port


class RobotProcess:
    """Connect a simulated robot to the bus."""

    def __init__(self, robot: SimRobot, port: Port) -> None:
        self.robot = robot
        self._commands = port.subscriber(keys.DRIVE_COMMAND)
        self._drive = port.publisher(keys.DRIVE_STATE)
        self._imu = port.publisher(keys.IMU)
        self._scan = port.publisher(keys.SCAN)
        self._truth = port.publisher(keys.SIM_TRUTH)

    def turn(self, now_s: float) -> None:
        """Take the newest command, advance the physics by a tick, report."""
        command = self._commands.newest()
        if command is not None:
            self.robot.command(command, now_s)
        self._say(self.robot.tick(now_s))

    def _say(self, report: Report) -> None:
        if report.drive is not None:
            self._drive.put(report.drive)
        if report.imu is not None:
            self._imu.put(report.imu)
        if report.scan is not None:
            self._scan.put(report.scan)
        if report.truth is not None:
            self._truth.put(report.truth)


class LocalizationProcess:
    """Connect the localization stand-in to the bus."""

    def __init__(self, stand_in: StandIn, port: Port) -> None:
        self._stand_in = stand_in
        self._truth = port.subscriber(keys.SIM_TRUTH)
        self._odometry = port.subscriber(keys.ODOM)
        self._out = port.publisher(keys.LOCALIZATION)

    def turn(self, now_s: float) -> None:
        """Hear both sources and answer where ``odom`` is."""
        for truth in self._truth.drain().items:
            if isinstance(truth, SimTruth):
                self._stand_in.hear_truth(truth)
        for odometry in self._odometry.drain().items:
            if isinstance(odometry, Odometry):
                self._stand_in.hear_odometry(odometry)
        answer = self._stand_in.answer(now_s)
        if answer is not None:
            self._out.put(answer)
