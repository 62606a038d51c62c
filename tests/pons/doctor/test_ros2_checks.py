"""The doctor says of a ROS 2 base what is missing, by its process or by asking its node."""

from __future__ import annotations

from pathlib import Path

import pytest

from pons.doctor import ros2_checks, running_process
from pons.doctor.finding import HealthVerdict
from tests.known import known
from tests.pons.doctor.speaking import speaking
from tests.ros2.words import robot
from tests.wire.examples import EXAMPLES
from wire import Nav2State, RobotDescription, Ros2Status, keys
from wire.keys import Party
from wire.ros2_config import Nav2Config
from wire.session import open_session


@pytest.mark.parametrize(
    ("node", "is_open"),
    [
        ("tcp/127.0.0.1:7448", False),
        ("tcp/localhost:7448", False),
        ("tcp/[::1]:7448", False),
        ("tcp/192.168.1.7:7448", True),
        ("tls/robot.local:7448", True),
    ],
)
def test_a_node_that_others_reach_is_told(node: str, is_open: bool) -> None:
    config = known(robot(node=node).ros2)
    verdict = HealthVerdict.WARN if is_open else HealthVerdict.OK
    assert ros2_checks._describe(config, None, "").verdict is verdict


def test_without_ros2_there_is_nothing_to_look_at(tmp_path: Path) -> None:
    assert ros2_checks.ros2(tmp_path, RobotDescription()).verdict is HealthVerdict.OK


def test_a_process_that_runs_is_heard_instead(tmp_path: Path) -> None:
    with speaking(Party.ROS2, tmp_path, (keys.ROS2_STATE, EXAMPLES[Ros2Status])):
        found = ros2_checks.ros2(tmp_path, robot())
    assert found.verdict is HealthVerdict.FAIL
    assert "ros2_no_base" in found.found.en


def test_where_nav2_drives_its_velocity_is_looked_at_too(tmp_path: Path) -> None:
    by_nav2 = robot()
    ros2 = known(by_nav2.ros2).model_copy(update={"nav2": Nav2Config()})
    by_nav2 = by_nav2.model_copy(update={"ros2": ros2})
    well = EXAMPLES[Ros2Status].model_copy(update={"code": None, "detail": ""})
    missing = {"code": "ros2_topic_missing", "detail": "the graph has no /cmd_vel_nav; start it"}
    state = EXAMPLES[Nav2State].model_copy(update=missing)
    hears = keys.ROS2_STATE, well
    with speaking(Party.ROS2, tmp_path, hears, (keys.NAV2_STATE, state)):
        found = ros2_checks.ros2(tmp_path, by_nav2)
    assert found.verdict is HealthVerdict.FAIL
    assert found.found.en == "ros2_topic_missing: the graph has no /cmd_vel_nav"
    with speaking(Party.ROS2, tmp_path, hears, (keys.NAV2_STATE, EXAMPLES[Nav2State])):
        assert ros2_checks.ros2(tmp_path, by_nav2).verdict is HealthVerdict.OK


def test_a_process_that_says_nothing_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(running_process, "HEAR_S", 0.1)
    with open_session(Party.ROS2, "r1", tmp_path):
        found = ros2_checks.ros2(tmp_path, robot())
    assert (found.verdict, "says nothing" in found.found.en) == (HealthVerdict.FAIL, True)
