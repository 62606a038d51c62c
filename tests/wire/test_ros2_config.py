"""The part ros2 of robot.toml comes with its drive, lidar and camera, or says what does not fit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from pons.launch_words import chinese_line
from pons_assets import ROOT
from wire import ConfigError, RobotDescription, load_robot

NODE = {"node": "tcp/127.0.0.1:7448"}
DRIVE, KIND, BLIND = {"kind": "ros2"}, {"kind": "ros2"}, {"imu": False}


def test_the_preset_hears_scans_and_gyro_of_the_node() -> None:
    robot = load_robot(ROOT / "robots" / "ros2_diff_drive.toml")
    assert robot.ros2 is not None
    assert (robot.ros2.node, robot.lidar.kind, robot.inputs.imu) == (NODE["node"], "ros2", True)
    assert not robot.drive.virtual


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"drive": DRIVE}, "ros2.node is missing: drive.kind 'ros2'"),
        ({"lidar": KIND}, "ros2.node is missing: lidar.kind 'ros2'"),
        ({"camera": KIND}, "ros2.node is missing: camera.kind 'ros2'"),
        ({"ros2": NODE, "inputs": BLIND}, "for drive.kind 'ros2', not for kind 'sim'"),
        ({"drive": DRIVE | {"port": "/dev/x"}, "ros2": NODE}, "drive.port is for"),
        ({"drive": DRIVE, "ros2": {}}, "ros2.node"),
        ({"drive": DRIVE, "ros2": {"node": "ws://x"}}, "ros2.node"),
        ({"drive": DRIVE, "ros2": {"node": "tcp/x y"}}, "ros2.node"),
        ({"drive": DRIVE, "ros2": NODE | {"cmdvel": "/x"}}, "ros2.cmdvel"),
        ({"drive": DRIVE, "ros2": NODE | {"nav2": {"goal": "/goal_pose"}}}, "ros2.nav2.goal"),
        ({"drive": DRIVE, "ros2": NODE | {"nav2": {"within_m": 3.0}}}, "ros2.nav2.within_m"),
    ],
)
def test_what_does_not_fit_is_refused_by_name(given: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError) as refused:
        RobotDescription.model_validate(given)
    assert says in str(refused.value)


def test_a_base_with_neither_lidar_nor_gyro_of_ros_is_taken_and_so_is_a_camera() -> None:
    given = {"drive": DRIVE, "inputs": BLIND, "ros2": NODE | {"nav2": {"within_m": 0.5}}}
    assert not RobotDescription.model_validate(given).camera.is_real
    assert RobotDescription.model_validate(given | {"camera": KIND}).camera.is_real


FORMER = """
[drive]
kind = "ros2"
[ros2]
{}
"""


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ('url = "ws://10.0.0.5:9090"', ["ros2.url"]),
        ('transport = "dds"\ndomain = 7\ninterface = "eth0"', ["ros2.transport", "ros2.domain"]),
        ('transport = "zenoh"\nrouter = "tcp/10.0.0.5:7447"', ["ros2.router"]),
        ('relay = "/guard"', ["ros2.relay"]),
        ('transport = 7', ["ros2.transport"]),
        ('node = "tcp/127.0.0.1:7448"\nodom = "/base/odom"', ["ros2.odom", 'odom: "/base/odom"']),
        (
            'scan = "/s"\nnav2 = {cmd_vel = "/nav", status = "/s"}\n[camera]\ntopic = "/c/packed"',
            ['scan: "/s"', 'nav2_cmd_vel: "/nav"', 'nav2_status: "/s"', "nav2: true",
             'picture: "/c/packed"', "camera.topic"],
        ),
    ],
)  # fmt: skip
def test_a_robot_toml_of_the_relay_and_its_transports_is_told_what_to_install_and_write(
    tmp_path: Path, keys: str, says: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "robot.toml"
    path.write_text(FORMER.format(keys))
    with pytest.raises(ConfigError) as refused:
        load_robot(path)
    told = str(refused.value)
    assert refused.value.code == "ros2_former_keys"
    for words in ("pons robot node", "eclipse-zenoh", 'node = "tcp/127.0.0.1:7448"', *says):
        assert words in told, words
    assert not chinese_line(told)
    monkeypatch.setenv("LC_ALL", "zh_CN.UTF-8")
    chinese = chinese_line(told)
    assert "pons robot node" in chinese
    assert "docs/ros2.md" in chinese
    assert not chinese.isascii()


@pytest.mark.parametrize("text", ["ros2 = 7", "ros2 = []", "[ros2]\nnav2 = 7", "camera = 7"])
def test_a_part_that_is_none_is_refused_as_any_other(tmp_path: Path, text: str) -> None:
    path = tmp_path / "robot.toml"
    path.write_text(text)
    with pytest.raises(ConfigError) as refused:
        load_robot(path)
    assert refused.value.code == "robot_toml_invalid"
