"""What a ROS 2 robot says of its lidar's place is printed, or refused with a cure."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from pons import ros2_topics, site
from pons.robot_processes import free_port
from pons.settings import LaunchSettings
from sim.twin.rosbridge_server import RosbridgeServer
from tests.ros2.frames import robot
from tests.ros2.test_mounting import transform
from wire import RobotDescription

TYPES = {"/scan": "sensor_msgs/msg/LaserScan", "/tf_static": "tf2_msgs/msg/TFMessage"}


@pytest.fixture
def speaking() -> Iterator[Callable[..., RobotDescription]]:
    """Return what makes a robot that says its scans and frames again and again."""
    ending, made = threading.Event(), list[tuple[RosbridgeServer, threading.Thread]]()

    def start(*transforms: dict[str, Any]) -> RobotDescription:
        server = RosbridgeServer(0, dict(TYPES))

        def say() -> None:
            while not ending.wait(0.02):
                server.publish("/scan", {"header": {"frame_id": "laser"}})
                server.publish("/tf_static", {"transforms": list(transforms)})

        made.append((server, threading.Thread(target=say)))
        made[-1][1].start()
        return robot(url=f"ws://127.0.0.1:{server.port}", imu=None)

    yield start
    ending.set()
    for server, thread in made:
        thread.join()
        server.close()


def test_where_the_lidar_sits_is_printed_as_a_part_of_robot_toml(
    speaking: Callable[..., RobotDescription], capsys: pytest.CaptureFixture[str]
) -> None:
    described = speaking(transform("base_link", "laser", (0.12, -0.03, 0.2), yaw_rad=1.5))
    assert ros2_topics.print_mounting(described) == 0
    printed = capsys.readouterr().out
    assert '[lidar]\nkind = "ros2"\nx_m = 0.120\ny_m = -0.030\nyaw_rad = 1.5000\n' in printed
    assert "# robot.toml has (0, 0, 0): 0.120 m off" in printed


def test_a_lidar_that_hangs_head_down_is_refused_with_the_cure(
    speaking: Callable[..., RobotDescription],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(ros2_topics, "FRAMES_S", 1.0)
    described = speaking(transform("base_link", "laser", roll_rad=3.14159))
    assert ros2_topics.print_mounting(described) == 3
    refused = capsys.readouterr().err
    assert "ros2_no_mounting" in refused
    assert "head down" in refused
    assert "robot_state_publisher" in refused


@pytest.mark.parametrize(
    ("described", "code"),
    [
        (RobotDescription(), "ros2_not_configured"),
        (robot(scan=None, imu=None), "ros2_topic_missing"),
        (robot(url=f"ws://127.0.0.1:{free_port()}"), "ros2_no_server"),
    ],
)
def test_without_a_robot_that_can_be_asked_it_says_why(
    described: RobotDescription, code: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert ros2_topics.print_mounting(described) == 3
    assert code in capsys.readouterr().err


def test_a_site_is_not_imported_from_a_robot_that_is_none_of_ros_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text("")
    settings = LaunchSettings(tmp_path, path, tmp_path, "127.0.0.1", 1)
    assert site.run(settings, ["import", "ros2:/map", "mine"]) == 3
    said = capsys.readouterr().err
    assert "ros2_not_configured" in said
    assert "请添加 ros2 部分" in said
