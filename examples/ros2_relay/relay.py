"""Give a ROS 2 base the dead-man that cmd_vel lacks. Run it on the robot: `python3 relay.py`.

Hears Pons on /pons/command, drives /cmd_vel, and says on /pons/state which command it obeys. A
command moves the base until `seen` + `ttl` on this computer's clock, however late it came; then the
base gets zeros. With `-p key:=FILE` it obeys only commands signed with that key, which Pons has in
relay.key. This one file needs rclpy and nothing of Pons (docs/ros2.md).
"""

from __future__ import annotations

import hashlib
import hmac
import json
import secrets
import signal
import sys
import time
from math import inf
from pathlib import Path
from typing import Any

try:
    import rclpy
    from geometry_msgs.msg import Twist, TwistStamped
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from rclpy.signals import SignalHandlerOptions
    from std_msgs.msg import String
except ImportError as missing:  # the dead-man is tested without ROS too
    MISSING = f"{missing}: source ROS 2 first, e.g. . /opt/ros/jazzy/setup.bash"
    Node = object
else:
    MISSING = ""

TWIST, STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"
TTL_S = (0.05, 0.5)
PERIOD_S = 0.01
MIN_KEY_BYTES = 16
LAST_S = 0.1
"""What the last zeros may take to the base before this process ends."""


class RelayDeadMan:
    """Decide what the base is told now. Told JSON and the time; knows no ROS."""

    def __init__(self, boot: str, key: bytes = b"") -> None:
        self.boot, self.seq, self.until_s, self.key = boot, 0, 0.0, key
        self.command: dict[str, Any] | None = None

    def hear(self, text: str, now_s: float) -> bool:
        """Take a command; False where it is unreadable, unsigned, old, long-lived or another's."""
        try:
            if self.key:
                text, _, mac = text.rpartition(" ")
                signed = hmac.new(self.key, text.encode(), hashlib.sha256).hexdigest()
                if not hmac.compare_digest(signed.encode(), mac.encode()):
                    return False
            raw = json.loads(text)
            boot, seq, seen_s, ttl_s = raw["boot"], raw["seq"], raw["seen"], raw["ttl"]
            raw["v"], raw["w"] = float(raw["v"]), float(raw["w"])
            fresh = raw["relay"] == self.boot and 0.0 <= now_s - seen_s < ttl_s
            sane = TTL_S[0] <= ttl_s <= TTL_S[1] and abs(raw["v"]) < 10.0 and abs(raw["w"]) < 20.0
            last = self.command
            newer = last is None or boot != last["boot"] or seq > last["seq"]
            named = isinstance(boot, str) and isinstance(seq, int) and 0 <= seq < 2**53
            if not (named and fresh and sane and newer):
                return False
        except (ValueError, KeyError, TypeError, OverflowError, RecursionError):
            return False
        self.command, self.until_s = raw, seen_s + ttl_s
        return True

    def twist(self, now_s: float) -> tuple[float, float, bool]:
        """Return forward [m/s], turning [rad/s], and whether the dead-man has fired."""
        if self.command is None or not now_s < self.until_s:
            return 0.0, 0.0, True
        on = self.command.get("on") is True
        return (self.command["v"], self.command["w"], False) if on else (0.0, 0.0, False)

    def state(self, now_s: float, ros_s: float, cmd_vel: str, others: int) -> str:
        """Return what Pons is told."""
        self.seq += 1
        obeyed = self.command or {"boot": None, "seq": 0, "on": False}
        return json.dumps(
            {
                "relay": self.boot, "seq": self.seq, "t": now_s, "ros": ros_s,
                "echo_boot": obeyed["boot"], "echo_seq": obeyed["seq"],
                "timed_out": self.twist(now_s)[2], "on": obeyed.get("on") is True,
                "cmd_vel": cmd_vel, "others": others, "keyed": bool(self.key),
            }
        )  # fmt: skip


def key_of(path: str) -> bytes:
    """Return the key in a file; empty where none is named. A short one ends this program."""
    key = Path(path).read_bytes().strip() if path else b""
    if path and len(key) < MIN_KEY_BYTES:
        sys.exit(f"{path} holds {len(key)} bytes, expected at least {MIN_KEY_BYTES}")
    return key


class Relay(Node):
    """Pass on what may move the base."""

    def __init__(self) -> None:
        super().__init__("pons_relay")
        ask = self.declare_parameter
        self.topic = self.resolve_topic_name(ask("cmd_vel", "/cmd_vel").value)
        self.frame = ask("frame", "base_link").value
        below = ask("relay", "/pons").value
        self.dead_man = RelayDeadMan(f"relay-{secrets.token_hex(4)}", key_of(ask("key", "").value))
        self.kind, self.heard, self.others, self.look_s = "", "", 0, 0.0
        self.drives: Any = None
        self.says = self.create_publisher(String, f"{below}/state", 10)
        self.create_subscription(String, f"{below}/command", self.hear, 10)
        self.create_timer(PERIOD_S, self.turn)
        scan = ask("scan", "").value
        if scan:
            from sensor_msgs.msg import LaserScan

            self.scans = self.create_publisher(LaserScan, f"{below}/scan", qos_profile_sensor_data)
            self.create_subscription(LaserScan, scan, self.hear_scan, qos_profile_sensor_data)

    def hear(self, message: String) -> None:
        if self.dead_man.hear(message.data, time.monotonic()):
            self.drive()

    def hear_scan(self, message: Any) -> None:
        """Say "too near" as 0: in rosbridge's JSON minus infinity would look like no return."""
        message.ranges = [0.0 if far == -inf else far for far in message.ranges]
        self.scans.publish(message)

    def turn(self) -> None:
        now_s = time.monotonic()
        if now_s >= self.look_s:
            self.look_s = now_s + 0.5
            self.look()
        if self.dead_man.twist(now_s)[2]:
            self.drive()  # zeros, again and again: a base that missed one must not go on
        ros_s = self.get_clock().now().nanoseconds * 1e-9
        state = self.dead_man.state(now_s, ros_s, self.heard, self.others)
        self.says.publish(String(data=state))

    def look(self) -> None:
        """Ask the graph who listens on cmd_vel and with which type; guess nothing."""
        kinds = {one.topic_type for one in self.get_subscriptions_info_by_topic(self.topic)}
        only = next(iter(kinds)) if len(kinds) == 1 and kinds <= {TWIST, STAMPED} else ""
        if only not in ("", self.kind):
            self.get_logger().info(f"{self.topic}: publishes {only}")
            if self.drives is not None:
                self.stop()  # whoever still hears the other type must not go on by it
                self.destroy_publisher(self.drives)
            made = TwistStamped if only == STAMPED else Twist
            self.drives, self.kind = self.create_publisher(made, self.topic, 1), only
        self.heard = self.kind if self.kind in kinds else ""
        ours = 0 if self.drives is None else 1
        self.others = max(0, len(self.get_publishers_info_by_topic(self.topic)) - ours)

    def stop(self) -> None:
        """Send zeros, whatever was asked for."""
        self.dead_man.until_s = 0.0
        self.drive()

    def drive(self) -> None:
        if self.drives is None:
            return
        twist = Twist()
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
    if MISSING:
        print(MISSING, file=sys.stderr)
        return 2
    rclpy.init(args=sys.argv, signal_handler_options=SignalHandlerOptions.NO)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))  # ROS would end before the last zeros
    relay = Relay()
    try:
        rclpy.spin(relay)
    except (KeyboardInterrupt, SystemExit):
        relay.stop()
        time.sleep(LAST_S)
    return 0


if __name__ == "__main__":
    sys.exit(main())
