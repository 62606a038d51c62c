"""A trial holds for the wiring that it was made with, and changes nothing else of a robot."""

from __future__ import annotations

from typing import Any

import pytest

from wire import RobotDescription
from wire.trial_record import TrialRecord, wiring_of

DRIVE = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 400}
LIDAR = {"kind": "ld19", "port": "/dev/y"}


def robot(
    drive: dict[str, Any] | None = None, lidar: dict[str, Any] | None = None, **more: Any
) -> RobotDescription:
    return RobotDescription.model_validate(
        {"drive": DRIVE | (drive or {}), "lidar": LIDAR | (lidar or {}), **more}
    )


def record(of: RobotDescription) -> TrialRecord:
    return TrialRecord(date="2026-11-24", wiring=wiring_of(of), dead_man_s=0.25, brake_s=0.05)


def test_a_robot_that_nobody_tried_has_none() -> None:
    assert robot().valid_trial is None


def test_a_trial_of_this_wiring_counts_whatever_else_is_tuned() -> None:
    made = record(robot())
    tuned = robot({"kp": 0.5, "lag_s": 0.1}, {"x_m": 0.1}, trial=made, base={"radius_m": 0.31})
    assert tuned.valid_trial == made


@pytest.mark.parametrize(
    ("drive", "lidar"),
    [
        ({"port": "/dev/z"}, {}),
        ({"ticks_per_turn": 401}, {}),
        ({"timeout_s": 0.3}, {}),
        ({"baud": 57_600}, {}),
        ({}, {"port": "/dev/z"}),
        ({}, {"upside_down": True}),
        ({}, {"yaw_rad": 0.5}),
    ],
)
def test_a_trial_of_another_wiring_does_not(drive: dict[str, Any], lidar: dict[str, Any]) -> None:
    assert robot(drive, lidar, trial=record(robot())).valid_trial is None


def test_it_is_no_part_of_the_robots_fingerprint() -> None:
    assert robot(trial=record(robot())).hash == robot().hash


def test_a_gyro_on_a_bus_of_its_own_is_part_of_the_wiring() -> None:
    made = record(robot())
    assert robot(trial=made, imu={"kind": "mpu6050", "bus": 1}).valid_trial is None
