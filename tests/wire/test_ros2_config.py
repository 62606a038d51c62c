"""The part ros2 of robot.toml comes with its drive, lidar and gyro, or says what does not fit."""

from __future__ import annotations

from typing import Any

import pytest
from pydantic import ValidationError

from pons_assets import ROOT
from wire import RobotDescription, load_robot

URL = {"url": "ws://10.0.0.5:9090"}
DRIVE, LIDAR, BLIND = {"kind": "ros2"}, {"kind": "ros2"}, {"imu": False}


def test_the_preset_is_taken_and_its_defaults_are_those_of_the_page() -> None:
    ros2 = load_robot(ROOT / "robots" / "ros2_diff_drive.toml").ros2
    assert ros2 is not None
    assert (ros2.command, ros2.state) == ("/pons/command", "/pons/state")
    assert (ros2.cmd_vel, ros2.odom, ros2.scan_zero) == ("/cmd_vel", "/odom", "near")


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"drive": DRIVE}, "ros2.url is missing"),
        ({"lidar": LIDAR}, "ros2.scan is missing"),
        ({"camera": {"kind": "ros2", "topic": "/c"}}, "ros2.url is missing: camera.kind 'ros2'"),
        ({"camera": {"kind": "ros2"}}, "camera.topic is missing: kind 'ros2' needs it"),
        ({"camera": {"kind": "none", "topic": "/c"}}, "camera.topic is for kind 'ros2'"),
        ({"camera": {"kind": "ros2", "topic": "c/compressed"}}, "camera.topic"),
        ({"ros2": URL, "inputs": BLIND}, "for drive.kind 'ros2', not for kind 'sim'"),
        ({"drive": DRIVE, "ros2": URL}, "ros2.imu None and inputs.imu true do not fit"),
        ({"drive": DRIVE, "ros2": URL | {"imu": "/imu"}, "inputs": BLIND}, "inputs.imu false"),
        ({"drive": DRIVE, "ros2": URL, "lidar": LIDAR, "inputs": BLIND}, "ros2.scan None"),
        ({"drive": DRIVE, "ros2": URL | {"scan": "/s"}, "inputs": BLIND}, "lidar.kind 'sim'"),
        ({"drive": DRIVE | {"port": "/dev/x"}, "ros2": URL, "inputs": BLIND}, "drive.port is for"),
        ({"drive": DRIVE, "ros2": {"url": "http://x"}, "inputs": BLIND}, "ros2.url"),
        ({"drive": DRIVE, "ros2": {"url": "ws://x y"}, "inputs": BLIND}, "ros2.url"),
        ({"drive": DRIVE, "ros2": URL | {"odom": "odom"}, "inputs": BLIND}, "ros2.odom"),
        ({"drive": DRIVE, "ros2": URL | {"cmdvel": "/x"}, "inputs": BLIND}, "ros2.cmdvel"),
    ],
)
def test_what_does_not_fit_is_refused_by_name(given: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError) as refused:
        RobotDescription.model_validate(given)
    assert says in str(refused.value)


NODE = {"node": "tcp/127.0.0.1:7448"}


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"ros2": NODE | {"odom": "/odom"}}, "ros2.odom is for ros2.transport"),
        ({"ros2": NODE | URL}, "ros2.url is for ros2.transport"),
        ({"ros2": NODE | {"transport": "dds"}}, "ros2.transport is for ros2.transport"),
        ({"ros2": NODE | {"nav2": {"cmd_vel": "/x"}}}, "ros2.nav2.cmd_vel is a parameter"),
        ({"ros2": {"node": "ws://x"}}, "ros2.node"),
        ({"ros2": NODE, "camera": {"kind": "ros2", "topic": "/c"}}, "parameter picture"),
    ],
)
def test_by_the_node_topics_are_named_on_the_robot(given: dict[str, Any], says: str) -> None:
    with pytest.raises(ValidationError) as refused:
        RobotDescription.model_validate({"drive": DRIVE, "inputs": BLIND} | given)
    assert says in str(refused.value)


def test_the_preset_of_the_node_hears_scans_and_gyro() -> None:
    robot = load_robot(ROOT / "robots" / "ros2_node.toml")
    assert robot.ros2 is not None
    assert (robot.ros2.peer, robot.lidar.kind) == ("tcp/127.0.0.1:7448", "ros2")
    blind = {"drive": DRIVE, "inputs": BLIND, "ros2": NODE | {"nav2": {"within_m": 0.5}}}
    assert RobotDescription.model_validate(blind).ros2 is not None


def test_a_camera_of_its_graph_is_read_by_a_process_of_ours() -> None:
    given = {"drive": DRIVE, "ros2": URL, "inputs": BLIND}
    camera = {"kind": "ros2", "topic": "/camera/image_raw/compressed"}
    robot = RobotDescription.model_validate(given | {"camera": camera})
    assert robot.camera.is_real
    assert robot.camera.topic == camera["topic"]
    assert not RobotDescription.model_validate(given).camera.is_real


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"transport": "rosbridge"}, "ros2.url is missing: ros2.transport 'rosbridge'"),
        ({"transport": "dds", **URL}, "ros2.url is for transport rosbridge, not 'dds'"),
        ({"transport": "dds", "router": "tcp/a:1"}, "ros2.router is for transport zenoh"),
        ({"transport": "zenoh", "interface": "lo"}, "ros2.interface is for transport dds"),
        ({"domain": 3, **URL}, "ros2.domain is for transport dds and zenoh, not 'rosbridge'"),
        ({"transport": "dds", "domain": 233}, "ros2.domain"),
        ({"transport": "dds", "interface": 'lo"/>'}, "ros2.interface"),
        ({"transport": "zenoh", "router": "udp/a:1"}, "ros2.router"),
        ({"transport": "udp"}, "ros2.transport"),
        ({**URL, "nav2": {"cmd_vel": "/cmd_vel"}}, "is what the relay drives by"),
        ({**URL, "nav2": {"cmd_vel": "/pons/command"}}, "is what the relay drives by"),
        ({**URL, "nav2": {"goal": "/goal_pose"}}, "ros2.nav2.goal"),
        ({**URL, "nav2": {"within_m": 3.0}}, "ros2.nav2.within_m"),
    ],
)
def test_a_way_that_lacks_a_key_or_has_anothers_is_refused(
    given: dict[str, Any], says: str
) -> None:
    with pytest.raises(ValidationError) as refused:
        RobotDescription.model_validate({"drive": DRIVE, "ros2": given, "inputs": BLIND})
    assert says in str(refused.value)


@pytest.mark.parametrize(
    ("preset", "peer"),
    [
        ("ros2_diff_drive", "ws://127.0.0.1:9090"),
        ("ros2_dds", "DDS domain 0"),
        ("ros2_zenoh", "tcp/127.0.0.1:7447, domain 0"),
    ],
)
def test_each_transport_has_a_preset_that_says_whom_it_reaches(preset: str, peer: str) -> None:
    ros2 = load_robot(ROOT / "robots" / f"{preset}.toml").ros2
    assert ros2 is not None
    assert ros2.peer == peer


def test_a_base_without_lidar_and_gyro_of_ros_is_taken() -> None:
    made = RobotDescription.model_validate({"drive": DRIVE, "ros2": URL, "inputs": BLIND})
    assert not made.drive.virtual
    assert made.ros2 is not None
