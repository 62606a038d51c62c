"""Join Nav2's topics to the dialogue of goals."""

from __future__ import annotations

import time
from math import cos, sin
from typing import Any

from action_msgs.msg import GoalStatusArray
from geometry_msgs.msg import PoseStamped, Twist, TwistStamped

from .goals import Nav2Dialogue, Pose, read_order
from .graph_check import STAMPED, TWIST, Trouble
from .link import PlannerLink
from .readings import UnusableMessage, stamp_of
from .senses import KEPT

STATE_S = 0.1


class Nav2Topics:
    """Publish goals, hear twists and the action's status, for one node."""

    def __init__(self, node: Any, link: PlannerLink, boot: str, names: dict[str, str]) -> None:
        """Begin; the type of Nav2's velocity is asked of the graph."""
        self._node, self._link, self._boot, self._names = node, link, boot, names
        self.goals = Nav2Dialogue(time.monotonic())
        self._kind, self._said_s, self._told = "", 0.0, 0
        self._subscription: Any = None
        self._poses = node.create_publisher(PoseStamped, names["goal_pose"], 10)
        node.create_subscription(GoalStatusArray, names["nav2_status"], self._hear_status, KEPT)

    def hear(self, text: str) -> None:
        """Take the planner's order."""
        try:
            self.goals.take(read_order(text), time.monotonic())
        except UnusableMessage as why:
            self._node.get_logger().warning(str(why))

    def look(self) -> None:
        """Ask the graph what Nav2 says its velocity with."""
        topic = self._names["nav2_cmd_vel"]
        infos = self._node.get_publishers_info_by_topic(topic)
        kinds = {one.topic_type for one in infos}
        self.goals.trouble = _judge(topic, kinds, len(infos))
        kind = kinds.pop() if self.goals.trouble is None else self._kind
        if kind != self._kind:
            if self._subscription is not None:
                self._node.destroy_subscription(self._subscription)
            made = TwistStamped if kind == STAMPED else Twist
            self._kind = kind
            self._subscription = self._node.create_subscription(made, topic, self._hear_twist, 10)

    def turn(self, now_s: float) -> None:
        """Publish the goal that is due, and tell the planner what is new."""
        pose = self.goals.due(now_s)
        if pose is not None:
            self._poses.publish(self._stamp_pose(pose))
        if pose or self.goals.twists != self._told or now_s - self._said_s >= STATE_S:
            self._told, self._said_s = self.goals.twists, now_s
            self._link.say("nav2/state", self.goals.state(self._boot, now_s))

    def _hear_twist(self, message: Any) -> None:
        stamp_s = stamp_of(message) if hasattr(message, "header") else 0.0
        ros_s = self._node.get_clock().now().nanoseconds * 1e-9
        now_s = time.monotonic()
        self.goals.hear_twist(message, ros_s - stamp_s if stamp_s > 0.0 else 0.0, now_s)
        self.turn(now_s)

    def _hear_status(self, message: Any) -> None:
        self.goals.hear_status(message, time.monotonic())

    def _stamp_pose(self, pose: Pose) -> PoseStamped:
        """Return a goal of no particular time: the newest transform counts."""
        made = PoseStamped()
        made.header.frame_id = self._names["map_frame"]
        made.pose.position.x, made.pose.position.y = pose[0], pose[1]
        made.pose.orientation.z, made.pose.orientation.w = sin(pose[2] / 2.0), cos(pose[2] / 2.0)
        return made


def _judge(topic: str, kinds: set[str], publishers: int) -> Trouble | None:
    if not kinds:
        return "ros2_topic_missing", f"the graph has no {topic}"
    if len(kinds) > 1 or not kinds <= {TWIST, STAMPED}:
        found = " and ".join(sorted(kinds))
        return "ros2_cmd_vel_type", f"{topic} is {found}, expected {TWIST} or {STAMPED}"
    if publishers > 1:
        return "ros2_two_robots", f"{publishers} publish on {topic}, expected one"
    return None
