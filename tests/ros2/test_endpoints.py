"""What the graph has is told when it is asked and when it changes, and two types are no type."""

from __future__ import annotations

from ros2.endpoints import GraphEndpoint, GraphEndpoints
from ros2.operations import TopicType

TWIST, STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"


def graph(*endpoints: GraphEndpoint) -> GraphEndpoints:
    made = GraphEndpoints()
    for number, endpoint in enumerate(endpoints):
        made.add(str(number), endpoint)
    return made


def test_an_empty_domain_answers_nothing_so_that_nobody_can_be_named_missing() -> None:
    made = GraphEndpoints()
    made.ask("/odom")
    assert made.news() == []
    made.was_reached = True
    assert made.news() == [TopicType("/odom", "", 0)]


def test_a_topic_is_told_once_and_again_when_it_changes() -> None:
    made = graph(GraphEndpoint("/cmd_vel", TWIST, publishes=False))
    made.ask("/cmd_vel")
    assert made.news() == [TopicType("/cmd_vel", TWIST, 0)]
    assert made.news() == []
    made.add("late", GraphEndpoint("/cmd_vel", STAMPED, publishes=True))
    assert made.news() == [TopicType("/cmd_vel", f"{TWIST} and {STAMPED}", 1)]
    made.remove("late")
    made.remove("never there")
    assert made.news() == [TopicType("/cmd_vel", TWIST, 0)]


def test_what_nobody_asked_for_is_not_told() -> None:
    made = graph(GraphEndpoint("/odom", "nav_msgs/msg/Odometry", publishes=True))
    made.ask("/cmd_vel")
    assert [one.topic for one in made.news()] == ["/cmd_vel"]
    assert made.topics() == ["/odom"]


def test_hashes_are_those_of_the_topic_and_type() -> None:
    made = graph(
        GraphEndpoint("/a", TWIST, publishes=False, type_hash="RIHS01_2"),
        GraphEndpoint("/a", TWIST, publishes=False, type_hash="RIHS01_1"),
        GraphEndpoint("/a", TWIST, publishes=True, type_hash="RIHS01_1"),
        GraphEndpoint("/a", STAMPED, publishes=True, type_hash="RIHS01_3"),
        GraphEndpoint("/b", TWIST, publishes=True, type_hash="RIHS01_4"),
    )
    assert made.type_hashes("/a", TWIST) == ["RIHS01_1", "RIHS01_2"]
    assert made.type_hashes("/c", TWIST) == []
