"""Drive a ROS 2 base for Pons: ``ros2 run pons_ros2 base``, beside the robot's own driver.

Hears Pons' commands over zenoh and drives cmd_vel by them until each ends by the dead-man; says
odometry, scans and the rest back. Without a command, and when it ends, the base gets zeros.
"""

from __future__ import annotations

import os
import secrets
import signal
import sys
import threading
import time
import traceback
from typing import Any

import rclpy
import zenoh
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import String

from .dead_man import CmdVelDeadMan, key_of, strip_signature
from .display import RvizDisplay
from .graph_check import STAMPED, TopicCheck, TopicPublishers, judge_cmd_vel
from .link import OpenToAll, PlannerLink
from .nav2 import Nav2Topics
from .senses import Senses

PERIOD_S = 0.01
LOOK_S = 0.5
LAST_S = 0.1
"""What the last zeros may take to the base before this process ends."""
ENDED = ("ros2_relay_silent", "the node ends")
STEADY = Clock(clock_type=ClockType.STEADY_TIME)
"""Of all timers: a simulation that stands must not stop the dead-man."""
TOPICS = {
    "cmd_vel": "/cmd_vel", "odom": "/odom", "scan": "/scan", "imu": "/imu", "map": "/map",
    "picture": "", "depth": "", "battery": "", "estop": "", "bumper_front": "", "bumper_rear": "",
    "cliff": "", "goal_pose": "/goal_pose", "nav2_cmd_vel": "/cmd_vel_nav",
    "nav2_status": "/navigate_to_pose/_action/status",
}  # fmt: skip


class PonsBase(Node):
    """Pass on what may move the base, and what the base says."""

    def __init__(self) -> None:
        super().__init__("pons_base")
        names = {name: self._topic(name, default) for name, default in TOPICS.items()}
        names["map_frame"] = self._ask("map_frame", "map")
        self.topic, self.frame = names["cmd_vel"], self._ask("frame", "base_link")
        self.key = key_of(self._ask("key", ""))
        boot = f"relay-{secrets.token_hex(4)}"
        self.dead_man, self.lock = CmdVelDeadMan(boot, self.key), threading.Lock()
        self.kind, self.heard, self.others = "", "", 0
        self.trouble: tuple[str, str] | None = ("ros2_starting", "the graph was not looked at yet")
        self.drives: Any = None
        self.ticks = 0
        self._rise(self._ask("rank", 0))  # before the threads that inherit it
        listen = self._ask("listen", "tcp/127.0.0.1:7448")
        self.link = PlannerLink(listen, has_key=bool(self.key))
        given = self._ask("scan_zero", "near"), self._ask("picture_hz", 10.0)
        self.senses = Senses(self, self.link, names, *given)
        self.graph = TopicCheck(self.senses.needs())
        self.nav2 = Nav2Topics(self, self.link, boot, names) if self._ask("nav2", False) else None
        self.display = RvizDisplay(self, names["map_frame"])
        if self.nav2 is not None and names["nav2_cmd_vel"] == self.topic:
            raise ValueError(f"nav2_cmd_vel and cmd_vel are both {self.topic}")
        self.says = self.create_publisher(String, "pons/state", 10)
        self.tells = self.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self.link.hear("command", self.hear)
        self.link.hear("nav2/goal", self.hear_goal)
        self.link.hear("plan", self.hear_plan)
        self.ending = threading.Event()
        self.keeper = threading.Thread(target=self.keep, name="dead-man", daemon=True)
        self.keeper.start()
        if self.nav2 is not None:
            self.create_timer(PERIOD_S, self.tell_nav2, clock=STEADY)
        self.create_timer(LOOK_S, self.look, clock=STEADY)
        self.get_logger().info(f"{boot} listens at {listen}, drives {self.topic}")

    def _ask(self, name: str, default: Any) -> Any:
        return self.declare_parameter(name, default).value

    def _rise(self, rank: int) -> None:
        """Take a real-time rank, where the system lets this user."""
        try:
            if rank > 0:
                os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(rank))
        except OSError as why:
            self.get_logger().warning(f"rank {rank}: {why}; see /etc/security/limits.d, rtprio")

    def _topic(self, name: str, default: str) -> str:
        given = self._ask(name, default)
        return self.resolve_topic_name(given) if given else ""

    def hear(self, words: str) -> None:
        """Take a command, on a thread of zenoh's."""
        with self.lock:
            if self.dead_man.hear(words, time.monotonic()):
                self.drive()

    def hear_goal(self, words: str) -> None:
        """Take the planner's order for Nav2, on a thread of zenoh's."""
        text = strip_signature(words, self.key)
        if self.nav2 is not None and text is not None:
            self.nav2.hear(text)

    def hear_plan(self, words: str) -> None:
        """Take what the planner shows, on a thread of zenoh's."""
        text = strip_signature(words, self.key)
        if text is not None:
            self.display.hear(text, time.monotonic())

    def keep(self) -> None:
        """Be the dead-man's own thread: it waits behind no picture and no scan of the executor."""
        try:
            while not self.ending.wait(PERIOD_S):
                self.turn()
        except Exception:  # noqa: BLE001  # without a dead-man this process must not live
            traceback.print_exc()  # the guard sends zeros, and the launch file starts it again
            os._exit(1)

    def turn(self) -> None:
        """Say how it stands; while no command holds, send zeros again and again."""
        now_s = time.monotonic()
        with self.lock:
            if self.dead_man.twist(now_s)[2] or self.trouble is not None:
                self.drive()
            state = self.state(now_s)
        self.link.say("state", state)
        self.ticks += 1
        if self.ticks % 2 == 0:
            self.says.publish(String(data=state))

    def tell_nav2(self) -> None:
        """Publish the goal that is due, and tell the planner what is new of Nav2."""
        if self.nav2 is not None:
            self.nav2.turn(time.monotonic())

    def state(self, now_s: float, **more: object) -> str:
        """Return what Pons and the guard are told."""
        code, found = self.trouble or (None, "")
        ros_s = self.get_clock().now().nanoseconds * 1e-9
        graph = {"cmd_vel": self.heard, "others": self.others, "code": code, "found": found[:300]}
        wrong = self.senses.wrong(now_s)
        return self.dead_man.state(now_s, ros_s, **graph, wrong=wrong, **more)

    def look(self) -> None:
        """Ask the graph who listens on cmd_vel and with which type, and what the topics are."""
        kinds = {one.topic_type for one in self.get_subscriptions_info_by_topic(self.topic)}
        publishers = len(self.get_publishers_info_by_topic(self.topic))
        others = max(0, publishers - (0 if self.drives is None else 1))
        trouble = judge_cmd_vel(self.topic, kinds, others)
        self.graph.look({need.topic: self.read_publishers(need.topic) for need in self.graph.needs})
        with self.lock:
            only = next(iter(kinds), "")
            if (trouble is None or trouble[0] == "ros2_cmd_vel_shared") and only != self.kind:
                self.publish_as(only)
            self.heard = self.kind if self.kind in kinds else ""
            self.others, self.trouble = others, trouble or self.graph.trouble
        self.senses.look(time.monotonic())
        if self.nav2 is not None:
            self.nav2.look()
        self.diagnose(self.display.look(time.monotonic()))

    def read_publishers(self, topic: str) -> TopicPublishers:
        """Return what the graph says of a topic's publishers."""
        infos = self.get_publishers_info_by_topic(topic)
        return TopicPublishers(tuple(sorted({one.topic_type for one in infos})), len(infos))

    def publish_as(self, kind: str) -> None:
        """Publish on cmd_vel as this type; those who hear the other must not go on by it."""
        self.get_logger().info(f"{self.topic}: publishes {kind}")
        if self.drives is not None:
            self.dead_man.until_s = 0.0
            self.drive()
            former, self.drives = self.drives, None
            self.destroy_publisher(former)
        made = TwistStamped if kind == STAMPED else Twist
        self.drives, self.kind = self.create_publisher(made, self.topic, 1), kind

    def diagnose(self, planner: str) -> None:
        """Tell rqt and the like how base and planner stand."""
        code, found = self.trouble or ("", "the base is heard")
        level = DiagnosticStatus.ERROR if code else DiagnosticStatus.OK
        base = DiagnosticStatus(
            level=level, name="pons_ros2: base", message=f"{code} {found}".strip()
        )
        level = DiagnosticStatus.OK if planner else DiagnosticStatus.STALE
        said = DiagnosticStatus(
            level=level, name="pons_ros2: planner", message=planner or "not heard"
        )
        array = DiagnosticArray(status=[base, said])
        array.header.stamp = self.get_clock().now().to_msg()
        self.tells.publish(array)

    def stop(self) -> None:
        """Send zeros, whatever is asked for, and tell the guard that this is no death."""
        self.ending.set()
        self.keeper.join()
        with self.lock:
            self.trouble = ENDED  # a command that comes now moves nothing
            self.drive()
            self.says.publish(String(data=self.state(time.monotonic(), ended=True)))
        self.link.close()
        with self.lock:
            self.drive()

    def drive(self) -> None:
        """Publish the twist that holds now; the caller holds the lock."""
        if self.drives is None:
            return
        twist = Twist()
        if self.trouble is None:
            twist.linear.x, twist.angular.z, _ = self.dead_man.twist(time.monotonic())
        if self.kind == STAMPED:
            stamped = TwistStamped(twist=twist)
            stamped.header.stamp = self.get_clock().now().to_msg()
            stamped.header.frame_id = self.frame
            self.drives.publish(stamped)
        else:
            self.drives.publish(twist)


def main() -> int:
    """Be the node."""
    rclpy.init(args=sys.argv, signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))  # ROS would end before the last zeros
    try:
        node = PonsBase()
    except (OpenToAll, OSError, ValueError, zenoh.ZError) as why:
        print(f"pons_ros2: {why}", file=sys.stderr)
        return 2
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, SystemExit):
        node.stop()
        time.sleep(LAST_S)
    return 0


if __name__ == "__main__":
    sys.exit(main())
