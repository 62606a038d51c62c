"""Hold the ROS graph against what a base must have. Pure.

A topic of the wrong type is silence in ROS 2, without an error anywhere; so nothing moves before
the graph has named each topic's type.
"""

from __future__ import annotations

from dataclasses import dataclass

TWIST, STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"
Trouble = tuple[str, str]
"""A stable code, and what came where something else was expected."""


@dataclass(frozen=True)
class Need:
    """Name a topic that must be published, by one, as this type."""

    name: str
    """Its parameter."""
    topic: str
    kind: str


@dataclass(frozen=True)
class TopicPublishers:
    """Hold what the graph says of a topic's publishers."""

    kinds: tuple[str, ...]
    publishers: int


class TopicCheck:
    """Remember whether each topic had its right type once, and none a wrong one since.

    A node that ends takes its topic along: that it is silent shows in what it says.
    """

    def __init__(self, needs: list[Need]) -> None:
        """Begin with nothing seen."""
        self.needs, self.is_sound = needs, False
        self.trouble: Trouble | None = ("ros2_starting", "the graph was not looked at yet")

    def look(self, graph: dict[str, TopicPublishers]) -> None:
        """Judge the graph as it is now."""
        found = [trouble for need in self.needs if (trouble := _judge(need, graph[need.topic]))]
        if not found:
            self.is_sound = True
        elif any(code != "ros2_topic_missing" for code, _ in found):
            self.is_sound = False
        self.trouble = None if self.is_sound else found[0]


def _judge(need: Need, seen: TopicPublishers) -> Trouble | None:
    if not seen.kinds:
        return "ros2_topic_missing", f"the graph has no {need.topic}, which {need.name} names"
    if seen.kinds != (need.kind,):
        found = " and ".join(seen.kinds)
        return "ros2_topic_type", f"{need.name} {need.topic} is {found}, expected {need.kind}"
    if seen.publishers > 1:
        found = f"{seen.publishers} publish on {need.topic}, expected one"
        return "ros2_two_robots", found
    return None


def judge_cmd_vel(topic: str, kinds: set[str], others: int) -> Trouble | None:
    """Return why the base can't be driven by this topic."""
    if not kinds:
        return "ros2_no_base", f"nobody listens on {topic}"
    if len(kinds) > 1 or not kinds <= {TWIST, STAMPED}:
        found = " and ".join(sorted(kinds))
        return "ros2_cmd_vel_type", f"{topic} is {found}, expected {TWIST} or {STAMPED}"
    if others > 0:
        return "ros2_cmd_vel_shared", f"{others} more publish on {topic}"
    return None
