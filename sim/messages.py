"""Write the simulated robot's state as messages of the wire. Knows neither physics nor noise."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wire import DriveState, Imu, Pose2, Scan, SimScene, SimThing, SimTruth, Twist2
from wire.value import value

if TYPE_CHECKING:
    from sim.command_watchdog import DeadMan, WheelTargets
    from sim.contacts import Episodes
    from sim.sensors import Encoder, ImuSample, LidarModel, Ranges
    from wire import SimFault


@value
class Report:
    """Hold the robot's messages after one tick; None where none was due or a fault drops it."""

    drive: DriveState | None
    imu: Imu | None
    scan: Scan | None
    truth: SimTruth | None


@value
class Buttons:
    """Hold the inputs wired to the drive: stop, bumpers, cliff; True where pressed."""

    estop: bool = False
    bumper_front: bool = False
    bumper_rear: bool = False
    cliff: bool = False


class Speaker:
    """Stamp and number messages of one boot; ``seq`` of a key rises by one each time it is due."""

    def __init__(self, boot_id: str) -> None:
        self._boot_id = boot_id
        self._seqs = dict.fromkeys(("drive", "imu", "scan", "truth", "scene"), 0)

    def _next(self, key: str) -> int:
        self._seqs[key] += 1
        return self._seqs[key]

    def drive(
        self,
        now_s: float,
        dead_man: DeadMan,
        wheels: WheelTargets,
        encoders: tuple[Encoder, Encoder],
        battery: float,
        buttons: Buttons,
    ) -> DriveState:
        """Return the drive's state."""
        echo_boot, echo_seq = dead_man.echo
        left, right = encoders
        return DriveState(
            boot_id=self._boot_id,
            seq=self._next("drive"),
            stamp_s=now_s,
            echo_boot=echo_boot,
            echo_seq=echo_seq,
            enabled=wheels.torque,
            timed_out=wheels.timed_out,
            left_rad=left.angle_rad,
            right_rad=right.angle_rad,
            left_radps=left.speed_radps,
            right_radps=right.speed_radps,
            battery=battery,
            estop_pressed=buttons.estop,
            bumper_front=buttons.bumper_front,
            bumper_rear=buttons.bumper_rear,
            cliff=buttons.cliff,
        )

    def imu(self, now_s: float, sample: ImuSample) -> Imu:
        """Return the gyro's and accelerometer's readings."""
        return Imu(
            boot_id=self._boot_id,
            seq=self._next("imu"),
            stamp_s=now_s,
            yaw_rate_radps=sample.yaw_rate_radps,
            accel_x_mps2=sample.accel_x_mps2,
            accel_y_mps2=sample.accel_y_mps2,
        )

    def scan(self, now_s: float, lidar: LidarModel, ranges_m: Ranges, swept_s: float) -> Scan:
        """Return the lidar's scan, whose first beam was taken ``swept_s`` ago."""
        return Scan(
            boot_id=self._boot_id,
            seq=self._next("scan"),
            stamp_s=now_s - swept_s,
            time_increment_s=swept_s / max(1, len(ranges_m) - 1),
            angle_min_rad=lidar.angle_min_rad,
            angle_increment_rad=lidar.angle_increment_rad,
            range_min_m=lidar.config.range_min_m,
            range_max_m=lidar.config.range_max_m,
            ranges_m=ranges_m,
        )

    def truth(
        self,
        now_s: float,
        base_in_map: Pose2,
        twist: Twist2,
        contacts: Episodes,
        real_time_factor: float,
        faults: tuple[SimFault, ...],
    ) -> SimTruth:
        """Return the true pose, for judges and the localization stand-in."""
        return SimTruth(
            boot_id=self._boot_id,
            seq=self._next("truth"),
            stamp_s=now_s,
            base_in_map=base_in_map,
            twist=twist,
            contacts=contacts.now,
            contacts_total=contacts.total,
            real_time_factor=real_time_factor,
            faults=faults,
        )

    def scene(
        self,
        now_s: float,
        base_in_map: Pose2,
        things: tuple[SimThing, ...],
        faults: tuple[SimFault, ...],
    ) -> SimScene:
        """Return the scene that the camera's process draws."""
        return SimScene(
            boot_id=self._boot_id,
            seq=self._next("scene"),
            stamp_s=now_s,
            base_in_map=base_in_map,
            things=things,
            faults=faults,
        )
