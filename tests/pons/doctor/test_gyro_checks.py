"""The doctor says whose gyro counts, and names what keeps one from being read."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from pons.doctor import gyro_checks, path_checks
from pons.doctor.finding import HealthVerdict
from pons_assets import ROBOTS
from sensors.imu.bus import ImuTrouble
from sim.twin.imu_chips import Mpu6050Twin
from wire import RobotDescription
from wire.trial_record import TrialRecord, wiring_of

UGV = {"kind": "waveshare", "port": "/dev/x"}
MCU = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 400}
CHIP = {"kind": "mpu6050", "bus": 1}


def robot(drive: dict[str, Any], *, imu: bool = True, **more: Any) -> RobotDescription:
    return RobotDescription.model_validate({"drive": drive, "inputs": {"imu": imu}, **more})


@pytest.mark.parametrize(
    ("described", "verdict", "says"),
    [
        (robot({}), HealthVerdict.OK, "comes with the drive"),
        (robot(UGV, imu=False), HealthVerdict.WARN, "at most 0.3 m/s"),
        (robot(MCU), HealthVerdict.FAIL, "brings no gyro"),
        (robot(UGV), HealthVerdict.WARN, "nobody has seen which way"),
    ],
)
def test_whose_it_is(
    tmp_path: Path, described: RobotDescription, verdict: HealthVerdict, says: str
) -> None:
    found = gyro_checks.gyro(tmp_path, described)
    assert found.verdict is verdict
    assert says in found.found.en
    assert any(ord(letter) > 0x2E80 for letter in found.found.zh)


def test_one_that_was_tried_is_well(tmp_path: Path) -> None:
    made = robot(UGV)
    record = TrialRecord(
        date="2026-11-25", wiring=wiring_of(made), dead_man_s=0.3, brake_s=0.1, gyro=True
    )
    tried = made.model_copy(update={"trial": record})
    assert gyro_checks.gyro(tmp_path, tried).verdict is HealthVerdict.OK
    turned = tried.model_copy(update={"imu": tried.imu.model_copy(update={"up": "-z"})})
    assert gyro_checks.gyro(tmp_path, turned).verdict is HealthVerdict.WARN


def test_a_chip_is_read_and_a_missing_bus_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def missing(_number: int) -> None:
        raise ImuTrouble("i2c_missing", "/dev/i2c-1: No such file or directory")

    monkeypatch.setattr(gyro_checks, "SmBus", missing)
    described = RobotDescription.model_validate({"drive": MCU, "imu": CHIP})
    found = gyro_checks.gyro(tmp_path, described)
    assert (found.verdict, found.fix is None) == (HealthVerdict.FAIL, False)
    assert found.found.en.startswith("i2c_missing")
    monkeypatch.setattr(gyro_checks, "SmBus", lambda _number: Mpu6050Twin())
    found = gyro_checks.gyro(tmp_path, described)
    assert found.verdict is HealthVerdict.WARN, "which way it turns nobody has seen"
    assert "mpu6050" in found.found.en


@pytest.mark.parametrize("preset", sorted(ROBOTS.glob("*.toml")), ids=lambda path: path.stem)
def test_the_doctor_finds_no_fault_in_a_preset(preset: Path, tmp_path: Path) -> None:
    described, robot = path_checks.robot(preset)
    assert described.verdict is not HealthVerdict.FAIL
    assert gyro_checks.gyro(tmp_path, robot).verdict is not HealthVerdict.FAIL
