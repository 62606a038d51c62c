"""Run the simulated robot as a process: read, tick, write, at the pace of the monotonic clock.

Knows the wire's session and the clock; decides nothing about driving. What arrived while this
process was frozen is thrown away: it would look fresh at receipt, and nobody can say how old it is.
"""

from __future__ import annotations

import logging
import time
from typing import TYPE_CHECKING

from sim.hardware import PERIODS
from sim.rate import RealTimeFactor, SimPacer
from wire import ConfigError, keys

if TYPE_CHECKING:
    from collections.abc import Callable

    from sim.messages import Report
    from sim.robot import SimRobot
    from sim.twin import DriveTwin, LidarTwin, Ros2Twin
    from wire import Imu, SimControl
    from wire.session import Session

log = logging.getLogger("sim")

STALE_TICKS = 10
"""Ticks after a freeze in which arrivals are dropped: what lay in the socket takes a moment to come
through on a busy machine. The dead-man has fired by then, so nothing is lost but 0.1 s."""


class SimNode:
    """Connect one SimRobot to the wire."""

    def __init__(
        self,
        robot: SimRobot,
        session: Session,
        twin: DriveTwin | None = None,
        lidar: LidarTwin | None = None,
        ros2: Ros2Twin | None = None,
    ) -> None:
        """Take commands from the wire, or from a twin's line, which then has the answers.

        A lidar's twin says on its line what the scans would have said; a ROS 2 robot's says all.
        """
        self._robot = robot
        self._twin: DriveTwin | Ros2Twin | None = twin or ros2
        self._ros2 = ros2
        base_tells = twin is not None and twin.has_gyro and not robot.robot.imu.is_on_i2c
        self._base_gyro = twin if base_tells else None
        self._lidar = lidar
        self._commands = session.subscriber(keys.DRIVE_COMMAND)
        self._controls = session.subscriber(keys.SIM_CONTROL)
        self._drive = session.publisher(keys.DRIVE_STATE)
        self._imu = session.publisher(keys.IMU)
        self._scan = session.publisher(keys.SCAN)
        self._truth = session.publisher(keys.SIM_TRUTH)
        draws = robot.robot.camera.kind == "sim" or robot.robot.camera.is_real
        self._scene = session.publisher(keys.SIM_SCENE) if draws else None
        self._ticks = 0
        self._distrust = 0

    def run(self, stopped: Callable[[], bool]) -> None:
        """Tick until told to stop."""
        pacer = SimPacer(PERIODS.tick_s, time.monotonic())
        factor = RealTimeFactor(PERIODS.tick_s)
        frozen = round(self._robot.robot.drive.timeout_s / PERIODS.tick_s)
        while not stopped():
            time.sleep(max(0.0, pacer.next_s - time.monotonic()))
            now_s = time.monotonic()
            missed = pacer.woke(now_s)
            if missed >= frozen:
                log.warning("frozen for %.2f s; skipped, not caught up", missed * PERIODS.tick_s)
                self._distrust_arrivals()
            self._receive(now_s)
            self._say(self._robot.tick(now_s, real_time_factor=factor.note_tick(now_s)), now_s)
            if self._lidar is not None:
                troubles = self._robot.faults.of_sensor("lidar")
                self._lidar.tick(now_s, self._robot.look, troubles)
            self._show(now_s)

    def _distrust_arrivals(self) -> None:
        """Let nothing count that came while this process was frozen."""
        if self._twin is not None:
            self._twin.discard()  # a serial line holds all of it already, a socket does not
        else:
            self._distrust = STALE_TICKS

    def _receive(self, now_s: float) -> None:
        command = self._commands.newest() if self._twin is None else self._twin.command(now_s)
        if self._distrust > 0:
            self._distrust -= 1
        elif command is not None:
            self._robot.command(command, now_s)
        for control in self._controls.drain().items:
            if isinstance(control, keys.SIM_CONTROL.message):
                self._obey(control)
            else:
                log.warning("sim/control refused: %s", control)

    def _obey(self, control: SimControl) -> None:
        try:
            self._robot.control(control)
        except ConfigError as refusal:  # a test's mistake must not end the robot
            log.warning("sim/control refused: %s", refusal)

    def _say(self, report: Report, now_s: float) -> None:
        if report.imu is not None:
            self._hear_imu(report.imu)
        if report.drive is not None and self._twin is not None:
            self._twin.report(report.drive, now_s)
        elif report.drive is not None:
            self._drive.put(report.drive)
        if report.scan is not None:
            (self._scan.put if self._ros2 is None else self._ros2.hear_scan)(report.scan)
        if report.truth is not None:
            self._truth.put(report.truth)

    def _hear_imu(self, imu: Imu) -> None:
        """Say what the gyro reads, or let a twin's base say it."""
        if self._ros2 is not None:
            self._ros2.hear_imu(imu)
        elif self._base_gyro is not None:
            self._base_gyro.feel(imu)
        else:
            self._imu.put(imu)

    def _show(self, now_s: float) -> None:
        """Publish the scene for the simulated camera."""
        self._ticks += 1
        if self._scene is not None and self._ticks % PERIODS.scene_ticks == 0:
            self._scene.put(self._robot.scene(now_s))
