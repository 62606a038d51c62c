"""Hold the ROS graph's answers against what a base must have. Pure.

A topic of the wrong type is silence in ROS 2, without an error anywhere; so nothing is advertised
or subscribed before the graph has named each topic's type.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ros2.operations import NoAnswer, TopicType, plain_type
from ros2.relay import STRING
from ros2.trouble import STARTING, Ros2Trouble

if TYPE_CHECKING:
    from wire.ros2_config import Ros2Config

TWIST = "geometry_msgs/msg/Twist"
TWIST_STAMPED = "geometry_msgs/msg/TwistStamped"
ODOMETRY = "nav_msgs/msg/Odometry"
LASER_SCAN = "sensor_msgs/msg/LaserScan"
IMU = "sensor_msgs/msg/Imu"
ANSWER_S = 3.0
TWO = "ros2_two_robots"


@dataclass(frozen=True, slots=True)
class RequiredTopic:
    """Say which types a topic may have, and the codes where it has none of them."""

    key: str
    topic: str
    kinds: tuple[str, ...]
    missing: str
    other: str


def needs_of(ros2: Ros2Config) -> tuple[RequiredTopic, ...]:
    """Return what the graph must have, the base first."""
    missing, other = "ros2_topic_missing", "ros2_topic_type"
    twists = (TWIST, TWIST_STAMPED)
    needs = [
        RequiredTopic("cmd_vel", ros2.cmd_vel, twists, "ros2_no_base", "ros2_cmd_vel_type"),
        RequiredTopic("relay", ros2.state, (STRING,), "ros2_no_relay", other),
        RequiredTopic("odom", ros2.odom, (ODOMETRY,), missing, other),
    ]
    if ros2.scan is not None:
        needs.append(RequiredTopic("scan", ros2.scan, (LASER_SCAN,), missing, other))
    if ros2.imu is not None:
        needs.append(RequiredTopic("imu", ros2.imu, (IMU,), missing, other))
    return tuple(needs)


class GraphCheck:
    """Collect the answers of one connection."""

    def __init__(self, ros2: Ros2Config) -> None:
        self._peer, self._has_server = ros2.peer, ros2.transport == "rosbridge"
        self.needs = needs_of(ros2)
        self._asked_s: float | None = None
        self._answers: dict[str, TopicType | NoAnswer] = {}
        self.is_sound = False
        """Each topic had a right type once on this connection, and none has had a wrong one since.
        A node that ends takes its topic along: that it is silent shows in what it says."""

    def begin(self, now_s: float) -> None:
        """Forget all answers: the server may be another."""
        self._asked_s, self.is_sound = now_s, False
        self._answers.clear()

    def note(self, answer: TopicType | NoAnswer) -> None:
        """Take one answer."""
        self._answers[answer.topic] = answer
        found = [self._judge(need) for need in self.needs]
        if all(trouble is None for trouble in found):
            self.is_sound = True
        elif any(
            trouble and trouble.code in (need.other, TWO)
            for trouble, need in zip(found, self.needs, strict=True)
        ):
            self.is_sound = False

    def kind_of(self, topic: str) -> str:
        """Return a topic's type as the graph says; empty where it has none, or none was told."""
        answer = self._answers.get(topic)
        return answer.kind if isinstance(answer, TopicType) else ""

    def trouble(self, now_s: float) -> Ros2Trouble | None:
        """Return what keeps this graph from being driven."""
        if self.is_sound:
            return None
        late = self._asked_s is not None and now_s - self._asked_s > ANSWER_S
        for need in self.needs:
            answer = self._answers.get(need.topic)
            if answer is None and late:
                return self._silence()
            if answer is None:
                return Ros2Trouble(STARTING, f"{self._peer}: the graph was not heard yet")
            trouble = self._judge(need)
            if trouble is not None:
                return trouble
        return None

    def _silence(self) -> Ros2Trouble:
        if self._has_server:
            found = f"{self._peer} did not answer /rosapi/topic_type within {ANSWER_S:g} s"
            return Ros2Trouble("ros2_no_rosapi", found)
        found = f"{self._peer}: no ROS 2 node was found within {ANSWER_S:g} s"
        return Ros2Trouble("ros2_no_peer", found)

    def _judge(self, need: RequiredTopic) -> Ros2Trouble | None:
        answer = self._answers.get(need.topic)
        if not isinstance(answer, TopicType):
            why = "no answer yet" if answer is None else answer.reason
            return Ros2Trouble(
                "ros2_no_rosapi", f"{self._peer}: /rosapi/topic_type of {need.topic}: {why}"
            )
        if not answer.kind:
            return Ros2Trouble(need.missing, self._absent(need))
        if plain_type(answer.kind) not in {plain_type(kind) for kind in need.kinds}:
            expected = " or ".join(need.kinds)
            found = f"ros2.{need.key} {need.topic} is {answer.kind}, expected {expected}"
            return Ros2Trouble(need.other, found)
        if need.key != "cmd_vel" and answer.publishers is not None and answer.publishers > 1:
            found = f"{answer.publishers} publish on {need.topic}, expected one"
            return Ros2Trouble(TWO, found)
        return None

    def _absent(self, need: RequiredTopic) -> str:
        if need.key != "relay":
            return f"the graph has no {need.topic}, which ros2.{need.key} names"
        cmd_vel = self.needs[0].topic
        has = self.kind_of(cmd_vel) or "no type"
        return f"the graph has {cmd_vel} ({has}), but no {need.topic}: no relay node runs"
