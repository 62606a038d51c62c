"""Every sensor's process takes one command line, and refuses in one line what it can't read."""

from __future__ import annotations

from pathlib import Path

import pytest

from sensors.camera.__main__ import main as camera
from sensors.imu.__main__ import main as imu
from sensors.lidar.__main__ import main as lidar

MAINS = {"camera": camera, "imu": imu, "lidar": lidar}
WRONG = {"camera": "camera_not_real", "imu": "imu_not_on_i2c"}


@pytest.mark.parametrize("name", MAINS)
def test_a_robot_toml_that_can_not_be_used_is_refused_in_one_line(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("[lidar]\nkind = ")
    assert MAINS[name](["--robot", str(path), "--home", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"{name}: robot_toml_syntax")
    assert said.count("\n") == 1


@pytest.mark.parametrize("name", WRONG)
def test_a_robot_without_that_sensor_is_refused(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text('id = "r1"\n')
    assert MAINS[name](["--robot", str(path), "--home", str(tmp_path)]) == 2
    assert WRONG[name] in capsys.readouterr().err


def test_only_a_sensor_on_a_line_takes_another_port(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        camera(["--robot", "robot.toml", "--port", "/dev/x"])
    assert "--port" in capsys.readouterr().err
