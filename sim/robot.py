"""Simulate a robot in a home: commands in, sensor messages out, tick by tick.

The one object that the process shell and the lockstep harness both drive. Deterministic: the same
site, seed and calls give the same messages. It owns no clock; it is told the time of each receipt
and tick, and simulated time advances by one period per tick, however late the tick came.
"""

from __future__ import annotations

from math import copysign
from typing import TYPE_CHECKING

import numpy as np

from sim.battery import Battery
from sim.command_watchdog import DeadMan
from sim.contacts import Episodes
from sim.domain import Domain
from sim.domain_script import DomainScript
from sim.faults import Faults
from sim.hardware import PERIODS, Hardware
from sim.message_delays import MessageDelays
from sim.messages import Report, Speaker
from sim.mjcf import OBSTACLES
from sim.movable_objects import Things
from sim.sensor_channel import Channel
from sim.sensors import Encoder, Garbage, ImuModel, LidarModel
from sim.site import Home, load_home, pose2, solids
from sim.site.objects import uprights
from sim.staging import null_patches, staged_home
from sim.true_parameters import true_base
from sim.world import PhysicsWorld
from wire import Pose2, RobotDescription, SimFault, Twist2, compose

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from sim.command_watchdog import WheelTargets
    from sim.domain_script import DomainActs
    from sim.sensors import Ranges
    from wire import DriveCommand, DriveState, Imu, Scan, SimControl, SimScene, SimTruth

_STEPS = round(PERIODS.tick_s / PERIODS.step_s)
_BEYOND_RANGE_M = 0.1
"""Rays reach a little further than the lidar, so that noise works on both sides of its range."""


class SimRobot:
    """Simulate one robot in one home."""

    def __init__(
        self,
        site_dir: Path,
        robot: RobotDescription | None = None,
        *,
        seed: int = 0,
        start: Pose2 | None = None,
        hardware: Hardware | None = None,
        domain: Domain | None = None,
        boot_id: str = "sim",
        home: Home | None = None,
    ) -> None:
        """Build the home of ``site_dir``, or ``home``; stand the robot at its dock, or ``start``.

        Raises:
            ConfigError: the site's home.yaml is refused, or the domain can't be in that home.
        """
        self.robot = robot or RobotDescription()
        self.domain = domain or Domain()
        self.home: Home = staged_home(home or load_home(site_dir), self.domain)
        self.boot_id = boot_id
        self.faults = Faults()
        self._ice = (False, False)
        self._hardware = self.domain.hardware(self.robot.base, hardware or Hardware())
        base = true_base(self.robot.base, self._hardware)
        self._world = PhysicsWorld(
            solids(self.home), base, self._hardware, PERIODS.step_s, uprights(self.home)
        )
        self.things = Things(self.home)
        start = start or pose2(self.home.places[self.home.dock].pose)
        self.script = self._script(start)
        self._patches = null_patches(self.home, self.domain)
        self._world.place_robot(start)
        self._dead_man = DeadMan(self.robot.drive.timeout_s, self._hardware.timeout_ramp_radps2)
        left_rad, right_rad = self._world.wheel_angles()
        counts = self._hardware.encoder_counts
        self._encoders = (
            Encoder(counts, PERIODS.tick_s, left_rad),
            Encoder(counts, PERIODS.tick_s, right_rad),
        )
        # One stream per sensor: adding a beam must not change the gyro.
        streams = [np.random.default_rng(part) for part in np.random.SeedSequence(seed).spawn(3)]
        self._imu = ImuModel(self._hardware, PERIODS.tick_s, streams[0])
        self._lidar = LidarModel(self.robot.lidar, self._hardware, streams[1])
        self._scan_ticks = max(1, round(self.robot.lidar.scan_s / PERIODS.tick_s))
        self._true_m = np.full(self._hardware.lidar_beams, -1.0)
        self._garbage = garbage = Garbage(streams[2])
        self._drive_out = Channel["DriveState"](garbage.WHEELS, garbage.wheels)
        self._imu_out = Channel["Imu"](garbage.TURN, garbage.turn)
        self._scan_out = Channel["Scan"](garbage.RANGES, garbage.ranges)
        self._ways_out = MessageDelays(self.domain, PERIODS.tick_s)
        self._battery = Battery(self._hardware, PERIODS.tick_s)
        self._contacts = Episodes(PERIODS.tick_s)
        self._speaker = Speaker(boot_id)
        self._ticks = 0
        self._last_control: str | None = None

    def _script(self, start: Pose2) -> DomainScript | None:
        """Return what plays the domain; None where all knobs are neutral, which costs nothing."""
        if self.domain.is_neutral:
            return None
        radius_m = self.robot.base.radius_m
        script = DomainScript(self.domain, self.home, self.things, radius_m, PERIODS.tick_s)
        self._act(script.start(start))
        return script

    def _act(self, acts: DomainActs) -> None:
        """Let happen what the domain wants of this tick."""
        for name, pose in acts.moved:
            self.place_thing(name, pose)
        if acts.carried_to is not None:
            self._world.place_robot(acts.carried_to)
        self._world.push(acts.force_n)
        if acts.ice != self._ice:
            self._ice = acts.ice
            self._grip()

    def _grip(self) -> None:
        slips = SimFault.SLIP in self.faults
        self._world.make_slippery(left=slips or self._ice[0], right=slips or self._ice[1])

    @property
    def time_s(self) -> float:
        """Return how much time was simulated [s]."""
        return self._ticks * PERIODS.tick_s

    @property
    def base_in_map(self) -> Pose2:
        """Return where the robot truly is."""
        return self._world.pose()

    @property
    def twist(self) -> Twist2:
        """Return how the robot truly moves."""
        return self._world.twist()

    @property
    def contacts_total(self) -> int:
        """Return how often the robot began to touch something since start."""
        return self._contacts.total

    def command(self, command: DriveCommand, now_s: float) -> bool:
        """Receive a drive command; False for a repeated seq, which counts for nothing."""
        return SimFault.DRIVE_DEAF not in self.faults and self._dead_man.receive(command, now_s)

    def tick(self, now_s: float, *, real_time_factor: float = 1.0) -> Report:
        """Advance one period and report, stamped ``now_s`` on the caller's clock."""
        if self.script is not None:
            self._act(self.script.turn(self._ticks + 1, self._world.pose()))
        wheels = self._dead_man.wheels(now_s)
        left, right = self.faults.wheels_radps(
            wheels.left_radps, wheels.right_radps, torque=wheels.torque
        )
        self._world.step(
            self._past_dead_zone(left, self._hardware.left_gain),
            self._past_dead_zone(right, self._hardware.right_gain),
            braked=not wheels.torque,
            steps=_STEPS,
        )
        self._ticks += 1
        self._battery.tick(turning=left != 0.0 or right != 0.0)
        self._contacts.sample(self._world.contacts())
        left_rad, right_rad = self._world.wheel_angles()
        self._encoders[0].sample(left_rad)
        self._encoders[1].sample(right_rad)
        return Report(
            drive=self._ways_out.drive.carry(self._drive_due(now_s, wheels)),
            imu=self._ways_out.imu.carry(self._imu_due(now_s)),
            scan=self._ways_out.scan.carry(self._scan_due(now_s)),
            truth=self._truth_due(now_s, real_time_factor),
        )

    def scene(self, now_s: float) -> SimScene:
        """Return the scene that a camera on the robot could draw now."""
        return self._speaker.scene(
            now_s, self._world.pose(), self.things.elsewhere, self.faults.standing
        )

    def step_to(self, time_s: float) -> list[Report]:
        """Tick on simulated time alone until it reaches ``time_s``."""
        reports = []
        while self.time_s < time_s - PERIODS.step_s / 2:
            reports.append(self.tick(self.time_s + PERIODS.tick_s))
        return reports

    def place_robot(self, base_in_map: Pose2) -> None:
        """Carry the robot to a pose; wheels and odometry notice nothing."""
        self._world.place_robot(base_in_map)

    def place_obstacle(
        self, x_m: float, y_m: float, yaw_rad: float = 0.0, name: str = OBSTACLES[0]
    ) -> None:
        """Stand a spare obstacle (a person or a crate) in the home.

        Raises:
            ConfigError: ``obstacle_unknown``; sim.OBSTACLES lists them.
        """
        self.place_thing(name, Pose2(x_m, y_m, yaw_rad))

    def remove_obstacle(self, name: str = OBSTACLES[0]) -> None:
        """Remove a spare obstacle from the home."""
        self.place_thing(name, None)

    def place_thing(self, name: str, pose: Pose2 | None) -> None:
        """Put a person, an object or an obstacle down somewhere, or take it away.

        People and what stood on the floor stay solid; a small thing is for the camera alone.

        Raises:
            ConfigError: ``obstacle_unknown``.
        """
        self.things.move(name, pose)
        if name not in self._world.carried:
            return
        if pose is None:
            self._world.remove_obstacle(name)
        else:
            self._world.place_obstacle(name, pose.x_m, pose.y_m, pose.yaw_rad)

    def control(self, control: SimControl) -> None:
        """Carry out a test's request over the wire; the same id again is the same request.

        Raises:
            ConfigError: ``obstacle_unknown``; what stood before it in the wish is done.
        """
        if control.id == self._last_control:
            return
        self._last_control = control.id
        if control.place_robot is not None:
            self.place_robot(control.place_robot)
        if control.place_obstacle is not None:
            self.place_obstacle(*control.place_obstacle)
        if control.remove_obstacle:
            self.remove_obstacle()
        if control.place_thing is not None:
            self.place_thing(control.place_thing.name, control.place_thing.pose)
        if control.faults is not None:
            self.break_down(*control.faults)

    def break_down(self, *faults: SimFault) -> None:
        """Let exactly these faults stand from now on; none mends everything."""
        self.faults = Faults(faults)
        self._world.block_left_wheel(blocked=SimFault.WHEEL_STUCK in self.faults)
        self._grip()

    def _past_dead_zone(self, wheel_radps: float, gain: float) -> float:
        """Return the speed that a motor follows: friction takes the first part of every target."""
        left_over = gain * max(0.0, abs(wheel_radps) - self._hardware.dead_zone_radps)
        return copysign(min(left_over, self._hardware.motor_max_radps), wheel_radps)

    def _drive_due(self, now_s: float, wheels: WheelTargets) -> DriveState | None:
        turning = wheels.left_radps != 0.0 or wheels.right_radps != 0.0
        battery = self.faults.charge(self._battery.charge, turning=turning)
        state = self._speaker.drive(
            now_s, self._dead_man, wheels, self._encoders, battery, self.faults.buttons
        )
        return self._drive_out.through(state, self.faults.of_sensor("encoder"))

    def _imu_due(self, now_s: float) -> Imu | None:
        if not self.robot.inputs.imu:
            return None
        message = self._speaker.imu(now_s, self._imu.sample(self._world.twist()))
        return self._imu_out.through(message, self.faults.of_sensor("gyro"))

    def look(self, directions_rad: NDArray[np.float64]) -> Ranges:
        """Cast a lidar twin's beams from where the robot is now.

        Args:
            directions_rad: in the lidar's frame, counter-clockwise, shape (n,).

        Returns ranges [m] with the hardware's noise; None where nothing came back.
        """
        angles = directions_rad + self._lidar_in_map().yaw_rad
        directions = np.stack((np.cos(angles), np.sin(angles), np.zeros_like(angles)), axis=1)
        ranges_m = self._hide_beams(self._lidar.measure(self._cast(directions)), directions_rad)
        if SimFault.LIDAR_GARBAGE in self.faults:
            return self._garbage.beams(len(ranges_m), self.robot.lidar.range_max_m)
        return ranges_m

    def _hide_beams(self, ranges_m: Ranges, directions_rad: NDArray[np.floating]) -> Ranges:
        """Return what a cover over all of the lidar, or over a sector, leaves of a scan."""
        if SimFault.LIDAR_BLIND in self.faults:
            return (None,) * len(ranges_m)
        if SimFault.LIDAR_SECTOR in self.faults:
            return self._lidar.without_sector(ranges_m, directions_rad)
        return ranges_m

    def _scan_due(self, now_s: float) -> Scan | None:
        if self.robot.lidar.has_line:
            return None  # its twin casts its own rays
        ticks_left = -self._ticks % self._scan_ticks
        if ticks_left < self._lidar.sweep_ticks(PERIODS.tick_s):
            self._sweep(ticks_left)
        message = self._scan(now_s) if ticks_left == 0 else None
        return self._scan_out.through(message, self.faults.of_sensor("lidar"))

    def _sweep(self, ticks_left: int) -> None:
        """Measure the beams of this tick from where the lidar is now."""
        beams = self._lidar.beams_due(ticks_left, PERIODS.tick_s)
        self._true_m[beams] = self._cast(self._lidar.directions(self._lidar_in_map())[beams])

    def _lidar_in_map(self) -> Pose2:
        config = self.robot.lidar
        lidar_in_base = Pose2(
            config.x_m + self._hardware.lidar_x_error_m,
            config.y_m,
            config.yaw_rad + self._hardware.lidar_yaw_error_rad,
        )
        return compose(self._world.pose(), lidar_in_base)

    def _cast(self, directions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return true distances along unit vectors in ``map``; -1 where nothing is."""
        lidar_in_map = self._lidar_in_map()
        return self._world.rays(
            (lidar_in_map.x_m, lidar_in_map.y_m),
            directions,
            (self.robot.lidar.range_max_m + _BEYOND_RANGE_M) / self._hardware.lidar_range_scale,
            self._patches,
        )

    def _scan(self, now_s: float) -> Scan:
        ranges_m = self._hide_beams(self._lidar.measure(self._true_m), self._lidar.angles_rad)
        ticks = self._lidar.sweep_ticks(PERIODS.tick_s)
        # Beams are cast at the end of their tick; on average half a tick after they were due.
        swept_s = (ticks - 0.5) * PERIODS.tick_s if ticks > 1 else 0.0
        return self._speaker.scan(now_s, self._lidar, ranges_m, swept_s)

    def _truth_due(self, now_s: float, real_time_factor: float) -> SimTruth | None:
        if self._ticks % PERIODS.truth_ticks != 0:
            return None
        return self._speaker.truth(
            now_s,
            self._world.pose(),
            self._world.twist(),
            self._contacts,
            real_time_factor,
            self.faults.standing,
        )
