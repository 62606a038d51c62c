"""Everything that can be broken is noticed by the row it belongs to, and nothing is touched."""

from __future__ import annotations

import pytest

from tools.bench.measure.fault_times import trial
from wire import SimFault

pytestmark = pytest.mark.nightly(keep=10)


NOTICED = {
    "drive_deaf": "DRIVER_NACK.0",
    "drive_off": "ENC_STALE.0",
    "encoder_stuck": "POSE_JUMP.0",
    "encoder_garbage": "RUNAWAY.0",
    "encoder_delayed": "ENC_STALE.0",
    "encoder_intermittent": "ENC_STALE.0",
    "lidar_off": "LIDAR_STALE.0",
    "lidar_stuck": "LIDAR_STALE.0",
    "lidar_blind": "LIDAR_BLIND.0",
    "lidar_sector": "LIDAR_SECTOR.0",
    "lidar_garbage": "gate obstacle",
    "lidar_delayed": "LIDAR_STALE.0",
    "lidar_intermittent": "LIDAR_STALE.0",
    "gyro_off": "YAW_DISAGREE.0",
    "gyro_stuck": "YAW_DISAGREE.0",
    "gyro_garbage": "YAW_DISAGREE.0",
    "gyro_delayed": "YAW_DISAGREE.0",
    "wheel_stuck": "STUCK.0",
    "runaway": "RUNAWAY.0",
    "reversed": "RUNAWAY.0",
    "battery_low": "BATTERY.0",
    "battery_sag": "BATTERY.0",
    "bumper_front": "gate contact",
    "cliff": "gate contact",
    "estop_pressed": "ESTOP.0",
}
UNNOTICED = {
    "gyro_intermittent": "no reading is older than 0.25 s for long enough",
    "slip": "at speed, wheels on ice go on as they were told",
    "bumper_rear": "the robot drives away from it, slowly",
}
UNHEARD = {fault for fault in SimFault if fault.startswith("camera_")}
"""The bridge has no link to the camera: what a picture shows can neither stop nor move it."""
SLOWS_ONLY = {"gyro_off", "gyro_stuck", "gyro_garbage", "gyro_delayed", "battery_low"}

SLOW_TO_STAND = {"encoder_stuck"}
"""Frozen at nearly what is meant, encoders show where the robot turns, or gets nowhere in 5 s."""


def test_every_fault_is_told_of_here() -> None:
    assert NOTICED.keys() | UNNOTICED.keys() | UNHEARD == set(SimFault)


@pytest.mark.parametrize("name", NOTICED)
def test_a_broken_thing_is_noticed_by_its_row(name: str) -> None:
    watch_s = 7.0 if name in SLOW_TO_STAND else 3.5
    result = trial(SimFault(name), 1, watch_s=watch_s, after_s=watch_s if watch_s > 4.0 else 2.0)
    assert result.first == NOTICED[name]
    assert (result.stood_ticks is not None) is (name not in SLOWS_ONLY)
    assert result.contacts == 0


@pytest.mark.parametrize("name", UNNOTICED)
def test_what_does_no_harm_stops_nobody(name: str) -> None:
    result = trial(SimFault(name), 1, watch_s=2.0)
    assert (result.first, result.contacts) == ("", 0)
