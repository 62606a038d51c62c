"""Map and lidar's place come from the node on a robot, over a true socket."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from pons import ros2_robot, site
from pons.doctor import ros2_checks
from pons.doctor.finding import HealthVerdict
from pons.robot.command import run
from pons.robot_processes import free_port
from pons.ros2_robot import fetch_map, print_mounting
from pons.settings import LaunchSettings
from ros2.pons_ros2.pons_ros2.link import PlannerLink
from ros2.trouble import TopicFailure
from tests.ros2.test_mounting import transform
from tests.ros2.words import odometry, robot, scan, state
from wire import RobotDescription

MAP = {
    "topic": "/map", "resolution_m": 0.1, "width": 3, "height": 2, "x_m": -3.0, "y_m": 0.0,
    "yaw_rad": 0.0,
}  # fmt: skip


@pytest.fixture
def frames() -> list[dict[str, Any]]:
    """Return what the robot's /tf_static says; a test may say something else."""
    return [transform("base_link", "laser", (0.12, -0.03, 0.2), yaw_rad=1.5)]


@pytest.fixture
def head() -> dict[str, Any]:
    """Return what the robot says of its map; a test may say something else."""
    return dict(MAP)


@pytest.fixture
def locator(frames: list[dict[str, Any]], head: dict[str, Any]) -> Iterator[str]:
    """Return where a robot says all that it knows, again and again."""
    where = f"tcp/127.0.0.1:{free_port()}"
    link, ending = PlannerLink(where, has_key=False), threading.Event()

    def say() -> None:
        seq = 0
        while not ending.wait(0.02):
            seq += 1
            link.say_bytes("map", head, bytes([0, 100, 255, 0, 0, 0]))
            link.say("scan", scan(seq / 50).decode())
            link.say("frames", frames)
            link.say("state", state(seq / 50, seq).decode())
            link.say("odom", odometry(seq / 50).decode())

    thread = threading.Thread(target=say)
    thread.start()
    yield where
    ending.set()
    thread.join()
    link.close()


def test_a_map_is_read_as_every_map_is(locator: str) -> None:
    made = fetch_map(locator, "/map").grid
    assert (made.width, made.height, made.resolution_m) == (3, 2, 0.1)
    with pytest.raises(TopicFailure, match="parameter map names /map, not /other"):
        fetch_map(locator, "/other")


def test_a_map_that_the_node_could_not_read_is_told(locator: str, head: dict[str, Any]) -> None:
    head |= {"code": "ros2_unreadable", "found": "/map: info.origin.orientation is tilted"}
    with pytest.raises(TopicFailure, match="tilted"):
        fetch_map(locator, "/map")


def test_where_the_lidar_sits_is_printed_as_a_part_of_robot_toml(
    locator: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert print_mounting(robot(node=locator)) == 0
    printed = capsys.readouterr().out
    assert '[lidar]\nkind = "ros2"\nx_m = 0.120\ny_m = -0.030\nyaw_rad = 1.5000\n' in printed
    assert "# robot.toml has (0, 0, 0): 0.120 m off" in printed


def test_a_lidar_that_hangs_head_down_is_refused_with_the_cure(
    locator: str,
    frames: list[dict[str, Any]],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(ros2_robot, "FRAMES_S", 1.0)
    frames[:] = [transform("base_link", "laser", roll_rad=3.14159)]
    assert print_mounting(robot(node=locator)) == 3
    refused = capsys.readouterr().err
    assert "ros2_no_mounting" in refused
    assert "head down" in refused
    assert "robot_state_publisher" in refused


def test_without_a_robot_that_can_be_asked_it_says_why(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ros2_robot, "FRAMES_S", 0.2)
    assert print_mounting(RobotDescription()) == 3
    assert "ros2_not_configured" in capsys.readouterr().err
    assert print_mounting(robot(node=f"tcp/127.0.0.1:{free_port()}")) == 3
    assert "ros2_no_node" in capsys.readouterr().err


def test_a_site_is_not_imported_from_a_robot_that_is_none_of_ros_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("")
    settings = LaunchSettings(tmp_path, path, tmp_path, "127.0.0.1", 1)
    for locale, told in (("C", "add the part ros2"), ("zh_CN.UTF-8", "请添加 ros2 部分")):
        monkeypatch.setenv("LC_ALL", locale)
        assert site.run(settings, ["import", "ros2:/map", "mine"]) == 3
        said = capsys.readouterr().err
        assert "ros2_not_configured" in said
        assert told in said


def test_the_doctor_hears_the_node_and_says_where_nobody_answers(
    locator: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    described = robot(scan=False, imu=False, node=locator)
    assert ros2_checks.ros2(tmp_path, described).verdict is HealthVerdict.OK
    monkeypatch.setattr(ros2_checks, "ASK_S", 0.2)
    absent = robot(node=f"tcp/127.0.0.1:{free_port()}")
    found = ros2_checks.ros2(tmp_path, absent)
    assert found.verdict is HealthVerdict.FAIL
    assert "ros2_no_node" in json.dumps([str(found)])


def test_the_package_is_written_into_a_new_folder_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    settings = LaunchSettings(tmp_path, tmp_path, tmp_path, "127.0.0.1", 1)
    folder = tmp_path / "src" / "pons_ros2"
    assert run(settings, ["node", str(folder)]) == 0
    for name in ("package.xml", "setup.py", "launch/pons.launch.py", "config/pons.yaml",
                 "resource/pons_ros2", "pons_ros2/node.py"):  # fmt: skip
        assert (folder / name).is_file(), name
    assert run(settings, ["node", str(folder)]) == 3
    assert "node_not_written" in capsys.readouterr().err


def test_who_asks_for_the_relay_is_told_of_the_package(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = LaunchSettings(tmp_path, tmp_path, tmp_path, "127.0.0.1", 1)
    for locale, told in (("C", "it is a part of pons_ros2"), ("zh_CN.UTF-8", "中继节点现在是")):
        monkeypatch.setenv("LC_ALL", locale)
        assert run(settings, ["relay"]) == 3
        refused = capsys.readouterr().err
        for words in ("relay_gone", "pons robot node FOLDER", "docs/ros2.md", told):
            assert words in refused
