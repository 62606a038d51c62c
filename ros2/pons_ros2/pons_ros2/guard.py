"""Send zeros to cmd_vel while the base node is silent: ``ros2 run pons_ros2 guard``.

A base node that was killed leaves its last twist with the base, and a base without a dead-man of
its own goes on by it. Nothing but zeros ever goes this way, and nothing while the base node speaks:
beside another publisher it would refuse to be driven by.
"""

from __future__ import annotations

import json
import sys
import time
from math import inf
from typing import Any

import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_msgs.msg import String

from .graph_check import STAMPED

SILENT_S = 0.5
PERIOD_S = 0.1


class CmdVelGuard(Node):
    """Remember whether the base node was heard, and zero the base once it no longer is."""

    def __init__(self) -> None:
        super().__init__("pons_guard")
        self.topic = self.declare_parameter("cmd_vel", "/cmd_vel").value
        self.kind, self.heard_s = "", inf
        self.zeros: Any = None
        self.create_subscription(String, "pons/state", self.hear, 10)
        self.create_timer(PERIOD_S, self.turn, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def hear(self, message: Any) -> None:
        """Note that the base node lives, and as which type it publishes."""
        state = json.loads(message.data)
        self.heard_s = inf if state.get("ended") else time.monotonic()
        self.kind = state["cmd_vel"] or self.kind
        if self.zeros is not None:
            self.destroy_publisher(self.zeros)
            self.zeros = None

    def turn(self) -> None:
        """Send a zero if it is time."""
        if not self.kind or time.monotonic() - self.heard_s <= SILENT_S:
            return
        made = TwistStamped if self.kind == STAMPED else Twist
        if self.zeros is None:
            self.get_logger().warning("the base node is silent: zeros")
            self.zeros = self.create_publisher(made, self.topic, 1)
        self.zeros.publish(made())


def main() -> int:
    """Be the node."""
    rclpy.init(args=sys.argv)
    rclpy.spin(CmdVelGuard())
    return 0


if __name__ == "__main__":
    sys.exit(main())
