"""Nothing is driven before each topic had its type once, nor after one had a wrong one."""

from __future__ import annotations

import pytest

from ros2.pons_ros2.pons_ros2.graph_check import (
    STAMPED,
    TWIST,
    Need,
    TopicCheck,
    TopicPublishers,
    judge_cmd_vel,
)

ODOM = Need("odom", "/odom", "nav_msgs/msg/Odometry")
RIGHT, GONE = TopicPublishers((ODOM.kind,), 1), TopicPublishers((), 0)
WRONG, TWO = TopicPublishers(("std_msgs/msg/String",), 1), TopicPublishers((ODOM.kind,), 2)


def code_after(*seen: TopicPublishers) -> str | None:
    check = TopicCheck([ODOM])
    for one in seen:
        check.look({"/odom": one})
    return check.trouble[0] if check.trouble else None


@pytest.mark.parametrize(
    ("seen", "code"),
    [
        ([], "ros2_starting"),
        ([GONE], "ros2_topic_missing"),
        ([RIGHT], None),
        ([RIGHT, GONE], None),
        ([WRONG], "ros2_topic_type"),
        ([RIGHT, WRONG], "ros2_topic_type"),
        ([RIGHT, WRONG, GONE], "ros2_topic_missing"),
        ([RIGHT, TWO], "ros2_two_robots"),
        ([TWO, RIGHT], None),
    ],
)
def test_a_topic_that_went_is_silent_and_one_that_is_wrong_is_named(
    seen: list[TopicPublishers], code: str | None
) -> None:
    assert code_after(*seen) == code


@pytest.mark.parametrize(
    ("kinds", "others", "code"),
    [
        (set(), 0, "ros2_no_base"),
        ({TWIST}, 0, None),
        ({STAMPED}, 0, None),
        ({TWIST, STAMPED}, 0, "ros2_cmd_vel_type"),
        ({"std_msgs/msg/String"}, 0, "ros2_cmd_vel_type"),
        ({TWIST}, 1, "ros2_cmd_vel_shared"),
    ],
)
def test_cmd_vel_has_one_type_and_one_publisher(
    kinds: set[str], others: int, code: str | None
) -> None:
    trouble = judge_cmd_vel("/cmd_vel", kinds, others)
    assert (trouble[0] if trouble else None) == code
