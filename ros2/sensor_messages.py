"""Make scans and gyro readings of the wire from those of ROS."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wire import Imu, Scan

if TYPE_CHECKING:
    from ros2.messages import ImuReading, ScanReading


class SensorMessages:
    """Number and stamp the messages of one run."""

    def __init__(self, boot_id: str) -> None:
        self._boot_id = boot_id
        self._scans = self._imus = 0

    def scan(self, reading: ScanReading, stamp_s: float) -> Scan:
        """Return a scan whose first beam was taken at ``stamp_s`` on our clock."""
        self._scans += 1
        return Scan(
            boot_id=self._boot_id,
            seq=self._scans,
            stamp_s=stamp_s,
            angle_min_rad=reading.angle_min_rad,
            angle_increment_rad=reading.angle_increment_rad,
            range_min_m=reading.range_min_m,
            range_max_m=reading.range_max_m,
            ranges_m=reading.ranges_m,
            time_increment_s=reading.time_increment_s,
            clockwise=reading.clockwise,
        )

    def imu(self, reading: ImuReading, stamp_s: float) -> Imu:
        """Return the gyro's and accelerometer's reading of ``stamp_s`` on our clock."""
        self._imus += 1
        return Imu(
            boot_id=self._boot_id,
            seq=self._imus,
            stamp_s=stamp_s,
            yaw_rate_radps=reading.yaw_rate_radps,
            accel_x_mps2=reading.accel_x_mps2,
            accel_y_mps2=reading.accel_y_mps2,
        )
