"""The doctor says of a ROS 2 base what is missing, by its process or by asking the server."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from pons.doctor import ros2_checks, running_process
from pons.doctor.finding import HealthVerdict
from pons.robot_processes import free_port
from ros2.trouble import CODES
from tests.ros2.frames import robot
from tests.ros2.test_process import Base
from tests.wire.examples import EXAMPLES
from wire import Nav2State, Record, RobotDescription, Ros2Status, keys
from wire.keys import Key, Party
from wire.ros2_config import Nav2Config
from wire.session import open_session

TYPES = {
    "/cmd_vel": "geometry_msgs/msg/TwistStamped",
    "/pons/state": "std_msgs/msg/String",
    "/odom": "nav_msgs/msg/Odometry",
}


def described(port: int) -> RobotDescription:
    return robot(url=f"ws://127.0.0.1:{port}", scan=None, imu=None)


@pytest.fixture
def base() -> Iterator[Base]:
    made = Base(0, dict(TYPES))
    made.start()
    yield made
    made.end()


@pytest.mark.parametrize(
    ("said", "is_open"),
    [
        ({"url": "ws://127.0.0.1:9090"}, False),
        ({"url": "ws://localhost:9090"}, False),
        ({"url": "ws://[::1]:9090"}, False),
        ({"url": "ws://192.168.1.7:9090"}, True),
        ({"url": "ws://robot.local:9090"}, True),
        ({"transport": "dds", "url": None, "interface": "lo"}, False),
        ({"transport": "dds", "url": None, "interface": "eth0"}, True),
        ({"transport": "dds", "url": None}, True),
        ({"transport": "zenoh", "url": None}, False),
        ({"transport": "zenoh", "url": None, "router": "tcp/10.0.0.2:7447"}, True),
    ],
)
def test_a_transport_that_others_reach_is_told(said: dict[str, Any], is_open: bool) -> None:
    config = robot(**said).ros2
    assert config is not None
    assert ros2_checks.open_beyond_loopback(config) is is_open
    verdict = HealthVerdict.WARN if is_open else HealthVerdict.OK
    assert ros2_checks._describe(config, None, "").verdict is verdict


def test_without_ros2_there_is_nothing_to_look_at(tmp_path: Path) -> None:
    assert ros2_checks.ros2(tmp_path, RobotDescription()).verdict is HealthVerdict.OK


def test_without_a_server_it_says_how_to_start_one(tmp_path: Path) -> None:
    found = ros2_checks.ros2(tmp_path, described(free_port()))
    assert found.verdict is HealthVerdict.FAIL
    assert "ros2_no_server" in found.found.en
    assert found.fix is not None
    assert (found.fix.en, found.fix.zh) == CODES["ros2_no_server"]


def test_a_base_that_speaks_is_well_and_a_bare_cmd_vel_is_not(tmp_path: Path, base: Base) -> None:
    found = ros2_checks.ros2(tmp_path, described(base.server.port))
    assert found.verdict is HealthVerdict.OK, found
    assert base.accepted == [], "the doctor drives nothing"
    del base.server.types["/pons/state"]
    found = ros2_checks.ros2(tmp_path, described(base.server.port))
    assert found.verdict is HealthVerdict.FAIL
    assert "ros2_no_relay" in found.found.en


@contextmanager
def speaking(home: Path, *said: tuple[Key[Any], Record]) -> Iterator[None]:
    """Let the process say these again and again."""
    ending = threading.Event()
    with open_session(Party.ROS2, "r1", home) as session:
        publishers = [(session.publisher(key), message) for key, message in said]

        def say() -> None:
            while not ending.wait(0.02):
                for publisher, message in publishers:
                    publisher.put(message)

        thread = threading.Thread(target=say, daemon=True)
        thread.start()
        try:
            yield
        finally:
            ending.set()
            thread.join()


def test_a_process_that_runs_is_heard_instead(tmp_path: Path) -> None:
    with speaking(tmp_path, (keys.ROS2_STATE, EXAMPLES[Ros2Status])):
        found = ros2_checks.ros2(tmp_path, described(1))
    assert found.verdict is HealthVerdict.FAIL
    assert "ros2_no_relay" in found.found.en


def test_where_nav2_drives_its_velocity_is_looked_at_too(tmp_path: Path) -> None:
    by_nav2 = described(1)
    assert by_nav2.ros2 is not None
    ros2 = by_nav2.ros2.model_copy(update={"nav2": Nav2Config()})
    by_nav2 = by_nav2.model_copy(update={"ros2": ros2})
    well = EXAMPLES[Ros2Status].model_copy(update={"code": None, "detail": ""})
    missing = {"code": "ros2_topic_missing", "detail": "the graph has no /cmd_vel_nav; start it"}
    state = EXAMPLES[Nav2State].model_copy(update=missing)
    with speaking(tmp_path, (keys.ROS2_STATE, well), (keys.NAV2_STATE, state)):
        found = ros2_checks.ros2(tmp_path, by_nav2)
    assert found.verdict is HealthVerdict.FAIL
    assert found.found.en == "ros2_topic_missing: the graph has no /cmd_vel_nav"
    with speaking(tmp_path, (keys.ROS2_STATE, well), (keys.NAV2_STATE, EXAMPLES[Nav2State])):
        assert ros2_checks.ros2(tmp_path, by_nav2).verdict is HealthVerdict.OK


def test_a_process_that_says_nothing_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(running_process, "HEAR_S", 0.1)
    with open_session(Party.ROS2, "r1", tmp_path):
        found = ros2_checks.ros2(tmp_path, described(1))
    assert (found.verdict, "says nothing" in found.found.en) == (HealthVerdict.FAIL, True)
