"""The doctor opens a camera itself, or hears the process that has it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from pons.doctor import camera_checks
from pons.doctor.camera_checks import camera
from pons.doctor.finding import HealthFinding, HealthVerdict
from tests.known import known
from tests.sensors.camera.films import film
from tests.sensors.camera.test_ros2_source import RosCamera
from wire import RobotDescription

METAL = {"kind": "pons_mcu", "port": "/dev/x", "ticks_per_turn": 400}


def looked(home: Path, drive: dict[str, Any] | None = None, **keys: Any) -> HealthFinding:
    told = {"camera": keys, "drive": drive or {}}
    return camera(home, RobotDescription.model_validate(told))


def test_what_no_process_of_ours_reads_is_well(tmp_path: Path) -> None:
    for kind in ("none", "node", "sim"):
        assert looked(tmp_path, kind=kind).verdict is HealthVerdict.OK
    on_metal = looked(tmp_path, METAL, kind="sim")
    assert on_metal.verdict is HealthVerdict.WARN, "a robot drives without pictures"
    assert on_metal.fix is not None


def test_a_camera_that_gives_pictures_is_named_with_their_size(tmp_path: Path) -> None:
    path = film(tmp_path / "rooms.avi", hz=30.0)
    found = looked(tmp_path, kind="stream", url=f"file://{path}")
    assert found.verdict is HealthVerdict.OK
    assert "160 x 120" in found.found.en


def test_a_picture_of_ros_that_is_missing_has_its_cure_in_both_languages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sensors.camera.ros2_source.OPEN_S", 1.5)
    robot = RosCamera(code="ros2_topic_type", found="picture /camera is a Pose")
    told = {"drive": {"kind": "ros2"}, "ros2": {"node": robot.node}, "inputs": {"imu": False}}
    told["camera"] = {"kind": "ros2"}
    found = camera(tmp_path, RobotDescription.model_validate(told))
    robot.close()
    assert found.verdict is HealthVerdict.WARN
    assert found.found.en.startswith("ros2_topic_type: picture /camera is a Pose")
    assert "expected type" in known(found.fix).en
    assert "类型正确" in known(found.fix).zh


def test_one_that_is_missing_has_its_cure_in_both_languages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(camera_checks, "READ_S", 0.3)
    found = looked(tmp_path, kind="uvc", device=str(tmp_path / "video0"))
    assert found.verdict is HealthVerdict.WARN
    assert found.found.en.startswith("camera_missing")
    assert any(ord(letter) > 0x2E80 for letter in known(found.fix).zh)
