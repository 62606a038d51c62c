"""``pons robot find`` says what is there in words, as JSON, and as a part of robot.toml."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import cast

import pytest

from devices.camera_listing import CameraEntry
from devices.port_listing import PORT_TAKERS, UsbIdentity
from devices.port_probe import PortAnswer
from pons.__main__ import main
from pons.robot.command import CODES, camera_part, describe, describe_cameras, robot_part
from pons.robot.port_finder import PortFinding
from tests.pons.robot.twin_ports import PlayedBase, PlayedLidar, entry, played
from wire import RobotDescription

LIDAR = PortFinding(
    entry(Path("/dev/ttyUSB0"), lasting=Path("/dev/serial/by-id/usb-x")),
    "port_found", "lidar", "rplidar", 115_200, PortAnswer("RPLidar A1", {"model": "a1"}),
)  # fmt: skip
DRIVE = PortFinding(
    entry(Path("/dev/ttyACM0")),
    "port_found", "drive", "pons_mcu", 115_200,
    PortAnswer("a controller", missing={"ticks_per_turn": "of a wheel"}),
)  # fmt: skip


def test_the_part_of_robot_toml_is_taken_as_it_is_once_what_is_missing_is_filled_in() -> None:
    lines = list(robot_part([DRIVE, LIDAR]))
    filled = "\n".join(lines).replace("# ticks_per_turn = ", "ticks_per_turn = 400")
    robot = RobotDescription.model_validate(tomllib.loads(filled))
    assert (robot.drive.kind, robot.drive.port) == ("pons_mcu", "/dev/ttyACM0")
    assert (robot.lidar.kind, robot.lidar.model) == ("rplidar", "a1")
    assert robot.lidar.port == "/dev/serial/by-id/usb-x"


def test_a_second_device_of_a_part_is_commented_out() -> None:
    content = tomllib.loads("\n".join(robot_part([LIDAR, LIDAR])))
    assert content == {
        "lidar": {"kind": "rplidar", "port": "/dev/serial/by-id/usb-x", "model": "a1"}
    }


def test_cameras_are_named_and_the_first_is_a_part_of_robot_toml() -> None:
    first = CameraEntry(Path("/dev/video0"), Path("/dev/v4l/by-id/usb-x"), "Webcam\x1b[2J", True)
    second = CameraEntry(Path("/dev/video2"), Path("/dev/video2"), "Other", False)
    lines = list(describe_cameras([first, second]))
    assert lines[:3] == [
        "/dev/video0  Webcam?[2J", "  camera uvc: /dev/v4l/by-id/usb-x", "/dev/video2  Other",
    ]  # fmt: skip
    assert lines[3].startswith("  camera_forbidden: ")
    robot = RobotDescription.model_validate(tomllib.loads("\n".join(camera_part([first, second]))))
    assert (robot.camera.kind, robot.camera.device) == ("uvc", "/dev/v4l/by-id/usb-x")
    assert list(camera_part([])) == []


def test_nothing_found_is_no_part_and_says_what_to_do(monkeypatch: pytest.MonkeyPatch) -> None:
    assert list(robot_part([])) == []
    [english] = describe([])
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    [chinese] = describe([])
    assert english.startswith("  port_none: ")
    assert any(ord(letter) > 0x2E80 for letter in chinese)


@pytest.mark.parametrize("code", sorted(set(CODES) - {"port_none"}))
def test_every_code_is_said_in_both_languages(code: str, monkeypatch: pytest.MonkeyPatch) -> None:
    one = PortFinding(entry(Path("/dev/x")), code, detail="DETAIL")
    _, english = describe([one])
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    _, chinese = describe([one])
    assert english.startswith(f"  {code}: ")
    assert "{" not in english + chinese
    assert any(ord(letter) > 0x2E80 for letter in chinese)


def test_twins_and_who_takes_ports_are_told_and_nothing_moves_the_cursor() -> None:
    usb = UsbIdentity("10c4", "ea60", "Ev\x1b[2Jil", "x", "1")
    one = PortFinding(entry(Path("/dev/x"), usb=usb, twins=(Path("/dev/y"),)), "port_silent")
    said = "\n".join(describe([one], PORT_TAKERS))
    assert "port_twins" in said
    assert "/dev/y" in said
    for code in ("port_modem_manager", "port_brltty", "port_gpsd"):
        assert code in said
        assert code in "\n".join(describe([], PORT_TAKERS)), "told where no port is left, too"
    assert "\x1b" not in said


def test_a_person_finds_base_and_lidar(capsys: pytest.CaptureFixture[str]) -> None:
    with TemporaryDirectory(prefix="pons-find-") as folder:
        base, lidar = Path(folder, "base"), Path(folder, "lidar")
        with played([PlayedBase(base, "pons_mcu"), PlayedLidar(lidar, "ld19", None)]):
            assert main(["robot", "find", "--port", str(base), "--port", str(lidar)]) == 0
            said = capsys.readouterr().out
            assert main(["robot", "find", "--port", str(lidar), "--json"]) == 0
            content = json.loads(capsys.readouterr().out)
    assert "drive pons_mcu, 115200 baud" in said
    assert '[lidar]\nkind = "ld19"' in said
    (one,) = cast("list[dict[str, object]]", content["ports"])
    assert (one["code"], one["kind"], one["path"]) == ("port_found", "ld19", str(lidar))


def test_a_port_that_is_none_ends_with_a_refusal(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["robot", "find", "--port", str(tmp_path / "none")]) == 1
    assert "port_missing" in capsys.readouterr().out
