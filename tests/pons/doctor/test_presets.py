"""A preset as shipped has nothing that the doctor would call a fault of the file."""

from __future__ import annotations

from pathlib import Path

import pytest

from pons.doctor import gyro_checks, path_checks
from pons.doctor.finding import HealthVerdict
from pons_assets import ROBOTS


@pytest.mark.parametrize("preset", sorted(ROBOTS.glob("*.toml")), ids=lambda path: path.stem)
def test_the_doctor_finds_no_fault_in_a_preset(preset: Path, tmp_path: Path) -> None:
    described, robot = path_checks.robot(preset)
    assert described.verdict is not HealthVerdict.FAIL
    assert gyro_checks.gyro(tmp_path, robot).verdict is not HealthVerdict.FAIL
