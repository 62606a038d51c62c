"""Sensor messages are numbered one by one and say what was read."""

from __future__ import annotations

from ros2.messages import read_imu, read_scan
from ros2.sensor_messages import SensorMessages
from tests.ros2.frames import imu, scan


def test_each_kind_has_numbers_of_its_own() -> None:
    made = SensorMessages("ros2-1")
    scans = [made.scan(read_scan(scan(1.0)), 5.0) for _ in range(2)]
    turns = [made.imu(read_imu(imu(1.0)), 5.0) for _ in range(3)]
    assert [one.seq for one in scans] == [1, 2]
    assert [one.seq for one in turns] == [1, 2, 3]
    assert {one.boot_id for one in scans} | {one.boot_id for one in turns} == {"ros2-1"}


def test_a_scan_says_where_its_beams_look_and_when_they_were_taken() -> None:
    made = SensorMessages("r").scan(read_scan(scan(1.0, angle_increment=-0.1, angle_min=1.0)), 5.0)
    assert (made.stamp_s, made.clockwise, made.time_increment_s) == (5.0, True, 0.001)
    assert made.ranges_m == (0.05, None, 2.0, 1.0)
