"""The graph must have each topic with a right type, and a bare cmd_vel is refused."""

from __future__ import annotations

import pytest

from ros2.graph import ANSWER_S, GraphCheck
from ros2.operations import NoAnswer, TopicType
from ros2.trouble import CODES, STARTING
from tests.ros2.frames import TYPES, robot
from wire.ros2_config import Ros2Config


def config() -> Ros2Config:
    ros2 = robot().ros2
    assert ros2 is not None
    return ros2


def told(**types: str) -> GraphCheck:
    check = GraphCheck(config())
    check.begin(0.0)
    for topic, kind in (TYPES | {f"/{name}": kind for name, kind in types.items()}).items():
        check.note(TopicType(topic, kind))
    return check


@pytest.mark.parametrize("kind", ["geometry_msgs/msg/Twist", "geometry_msgs/TwistStamped"])
def test_a_graph_that_has_all_is_sound_with_either_twist(kind: str) -> None:
    check = told(cmd_vel=kind)
    assert (check.is_sound, check.trouble(1.0)) == (True, None)
    assert check.kind_of("/cmd_vel") == kind


@pytest.mark.parametrize(
    ("types", "code", "says"),
    [
        ({"cmd_vel": ""}, "ros2_no_base", "ros2.cmd_vel"),
        ({"cmd_vel": "std_msgs/msg/Bool"}, "ros2_cmd_vel_type", "expected geometry_msgs/msg/Twist"),
        ({"pons/state": ""}, "ros2_no_relay", "TwistStamped), but no /pons/state"),
        ({"pons/state": "std_msgs/msg/Bool"}, "ros2_topic_type", "std_msgs/msg/String"),
        ({"odom": ""}, "ros2_topic_missing", "/odom"),
        ({"odom": "geometry_msgs/msg/Pose"}, "ros2_topic_type", "nav_msgs/msg/Odometry"),
        ({"scan": "sensor_msgs/msg/PointCloud2"}, "ros2_topic_type", "sensor_msgs/msg/LaserScan"),
        ({"imu": ""}, "ros2_topic_missing", "ros2.imu"),
    ],
)
def test_a_graph_that_lacks_something_is_named(types: dict[str, str], code: str, says: str) -> None:
    check = told(**types)
    trouble = check.trouble(0.1)
    assert not check.is_sound
    assert trouble is not None
    assert (trouble.code, says in trouble.found) == (code, True), trouble
    assert CODES[code][0] in trouble.detail


def test_the_refusal_of_a_bare_cmd_vel_says_how_to_start_the_relay() -> None:
    trouble = told(**{"pons/state": ""}).trouble(0.1)
    assert trouble is not None
    assert "pons robot relay > relay.py; python3 relay.py" in trouble.detail
    assert "no dead-man" in trouble.detail


def test_without_answers_it_is_starting_and_then_there_is_no_rosapi() -> None:
    check = GraphCheck(config())
    check.begin(5.0)
    for now_s, code in ((5.1, STARTING), (5.1 + ANSWER_S, "ros2_no_rosapi")):
        trouble = check.trouble(now_s)
        assert trouble is not None
        assert trouble.code == code
    check.note(NoAnswer("/cmd_vel", "Service does not exist"))
    trouble = check.trouble(5.2)
    assert trouble is not None
    assert (trouble.code, "does not exist" in trouble.found) == ("ros2_no_rosapi", True)


def test_a_sound_graph_outlives_a_topic_that_goes_and_not_one_that_changes() -> None:
    check = told()
    check.note(TopicType("/odom", ""))
    check.note(NoAnswer("/scan", "timed out"))
    assert check.is_sound, "a node that ended is silent; the silence is judged where it counts"
    check.note(TopicType("/cmd_vel", "std_msgs/msg/String"))
    assert not check.is_sound
    trouble = check.trouble(1.0)
    assert trouble is not None
    assert trouble.code == "ros2_cmd_vel_type"


def test_another_connection_is_asked_anew() -> None:
    check = told()
    check.begin(9.0)
    assert not check.is_sound
    assert check.kind_of("/cmd_vel") == ""
