"""Be a part of a true ROS 2 graph, run by a Python that has rclpy: base, lidar, map, Nav2.

``base`` drives for ever by the last twist that it got, as a base without a dead-man does, and says
odometry at 50 Hz, and each twist as a line of JSON on stdout. ``lidar`` says three beams: too near
to measure (minus infinity), no return, 1.5 m. ``map`` says a map once and keeps it. ``body PORT``
drives the body of a simulator's twin, which listens there, and says what it senses. ``nav2`` is a
small stand-in for Nav2 (small_nav2), which begins at a pose and knows points to pass. ``viewer``
says what RViz would show, and the diagnostics, as lines of JSON.
Knows nothing of Pons but the twin's words.
"""

from __future__ import annotations

import json
import math
import sys
import time
from typing import Any

import rclpy
import small_nav2  # type: ignore[import-not-found]  # beside this file, where its Python looks
from action_msgs.msg import GoalStatus, GoalStatusArray
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped, Twist, TwistStamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

KINDS = {"geometry_msgs/msg/Twist": Twist, "geometry_msgs/msg/TwistStamped": TwistStamped}
PERIOD_S = 0.02
KEPT = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Base(Node):
    """Obey the last twist, for ever."""

    def __init__(self, kind: str) -> None:
        super().__init__("base")
        self.x = self.y = self.yaw = self.v = self.w = 0.0
        self.odom = self.create_publisher(Odometry, "/odom", 10)
        self.create_subscription(KINDS[kind], "/cmd_vel", self.hear, 10)
        self.create_timer(PERIOD_S, self.turn)

    def hear(self, message: Any) -> None:
        twist = getattr(message, "twist", message)
        self.v, self.w = twist.linear.x, twist.angular.z
        print(json.dumps({"at_s": time.monotonic(), "v": self.v, "w": self.w}), flush=True)

    def turn(self) -> None:
        self.x += self.v * math.cos(self.yaw) * PERIOD_S
        self.y += self.v * math.sin(self.yaw) * PERIOD_S
        self.yaw += self.w * PERIOD_S
        message = Odometry()
        message.header.stamp = self.get_clock().now().to_msg()
        pose, twist = message.pose.pose, message.twist.twist
        pose.position.x, pose.position.y = self.x, self.y
        pose.orientation.z, pose.orientation.w = math.sin(self.yaw / 2), math.cos(self.yaw / 2)
        twist.linear.x, twist.angular.z = self.v, self.w
        self.odom.publish(message)


class Lidar(Node):
    """Say scans of three beams."""

    def __init__(self) -> None:
        super().__init__("lidar")
        self.scans = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.create_timer(0.1, self.turn)

    def turn(self) -> None:
        scan = LaserScan(angle_increment=0.5, range_min=0.1, range_max=8.0, scan_time=0.1)
        scan.header.stamp = self.get_clock().now().to_msg()
        scan.ranges = [-math.inf, math.inf, 1.5]
        self.scans.publish(scan)
        print("scan", flush=True)


class Body(Node):
    """Be the driver of a base whose wheels, lidar and gyro a simulator plays (sim.twin.ros2).

    What moves it is cmd_vel alone, by the last twist; the simulator's own dead-man is its firmware.
    """

    def __init__(self, port: str) -> None:
        import zenoh

        super().__init__("body")
        self.v = self.w = 0.0
        self.seq, self.ahead_s = 0, math.inf
        self.odom = self.create_publisher(Odometry, "/odom", 10)
        self.scans = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.imus = self.create_publisher(Imu, "/imu", 10)
        self.create_subscription(TwistStamped, "/cmd_vel", self.hear, 10)
        config = zenoh.Config()
        config.insert_json5("connect/endpoints", json.dumps([f"tcp/127.0.0.1:{port}"]))
        config.insert_json5("connect/timeout_ms", "-1")
        config.insert_json5("scouting/multicast/enabled", "false")
        self.session = zenoh.open(config)
        self.commands = self.session.declare_publisher("pons/ros2/command", express=True)
        tells = {"state": self.obey, "odom": self.tell_pose, "scan": self.tell_scan,
                 "imu": self.tell_turn}  # fmt: skip
        self.heard = [self.listen(name, tell) for name, tell in tells.items()]

    def listen(self, name: str, tell: Any) -> Any:
        return self.session.declare_subscriber(
            f"pons/ros2/{name}", lambda sample: tell(json.loads(sample.payload.to_bytes()))
        )

    def hear(self, message: Any) -> None:
        self.v, self.w = message.twist.linear.x, message.twist.angular.z

    def obey(self, state: dict[str, Any]) -> None:
        """Say what the simulator's firmware is to do; note how far our clock is ahead of it."""
        self.ahead_s = min(self.ahead_s, self.get_clock().now().nanoseconds * 1e-9 - state["ros"])
        self.seq += 1
        words = {
            "boot": "body", "seq": self.seq, "relay": state["relay"], "seen": state["t"],
            "ttl": 0.5, "on": True, "v": self.v, "w": self.w,
        }  # fmt: skip
        self.commands.put(json.dumps(words).encode())

    def stamp(self, message: Any, raw: dict[str, Any], frame: str) -> Any:
        stamp_s = raw["stamp_s"] + (self.ahead_s if math.isfinite(self.ahead_s) else 0.0)
        message.header.frame_id = frame
        message.header.stamp.sec = int(stamp_s)
        message.header.stamp.nanosec = int((stamp_s % 1.0) * 1e9)
        return message

    def tell_pose(self, raw: dict[str, Any]) -> None:
        message = self.stamp(Odometry(), raw, "odom")
        pose, twist, half = message.pose.pose, message.twist.twist, raw["yaw_rad"] / 2
        pose.position.x, pose.position.y = raw["x_m"], raw["y_m"]
        pose.orientation.z, pose.orientation.w = math.sin(half), math.cos(half)
        twist.linear.x, twist.angular.z = raw["v_mps"], raw["w_radps"]
        self.odom.publish(message)

    def tell_scan(self, raw: dict[str, Any]) -> None:
        message = self.stamp(LaserScan(), raw, "laser")
        message.angle_min, message.angle_increment = (
            raw["angle_min_rad"], raw["angle_increment_rad"],
        )  # fmt: skip
        message.time_increment = raw["time_increment_s"]
        message.range_min, message.range_max = raw["range_min_m"], raw["range_max_m"]
        message.ranges = [math.inf if one is None else one for one in raw["ranges_m"]]
        self.scans.publish(message)

    def tell_turn(self, raw: dict[str, Any]) -> None:
        message = self.stamp(Imu(), raw, "imu_link")
        message.angular_velocity.z = raw["yaw_rate_radps"]
        accel = message.linear_acceleration
        accel.x, accel.y, accel.z = raw["accel_x_mps2"], raw["accel_y_mps2"], 9.81
        self.imus.publish(message)


class Nav2(Node):
    """Drive to /goal_pose by /cmd_vel_nav, and say the action's status, as much as Pons hears."""

    def __init__(self, start: list[float], via: list[float]) -> None:
        super().__init__("nav2_stand_in")
        points = list(zip(via[::2], via[1::2], strict=True))
        self.nav2 = small_nav2.SmallNav2(via=points)
        self.start, self.pose = start, start
        self.told: list[Any] = []
        self.twists = self.create_publisher(TwistStamped, "/cmd_vel_nav", 10)
        topic = "/navigate_to_pose/_action/status"
        self.statuses = self.create_publisher(GoalStatusArray, topic, KEPT)
        self.create_subscription(Odometry, "/odom", self.hear_odometry, 10)
        self.create_subscription(PoseStamped, "/goal_pose", self.hear_goal, 10)
        self.create_timer(0.05, self.turn)

    def hear_odometry(self, message: Any) -> None:
        at, turn = message.pose.pose.position, message.pose.pose.orientation
        x, y, yaw = self.start
        c, s = math.cos(yaw), math.sin(yaw)
        odom_yaw = 2.0 * math.atan2(turn.z, turn.w)
        self.pose = [x + c * at.x - s * at.y, y + s * at.x + c * at.y, yaw + odom_yaw]

    def hear_goal(self, message: Any) -> None:
        at, turn = message.pose.position, message.pose.orientation
        assert message.header.frame_id == "map"
        goal = at.x, at.y, 2.0 * math.atan2(turn.z, turn.w)
        self.nav2.hear(goal, time.monotonic(), (self.pose[0], self.pose[1]))
        print(json.dumps({"goal": self.nav2.goals[-1], "pose": self.pose}), flush=True)

    def turn(self) -> None:
        twist = self.nav2.turn(time.monotonic(), *self.pose)
        if self.nav2.statuses != self.told:
            self.told = list(self.nav2.statuses)
            self.statuses.publish(self.array())
        if twist is not None:
            message = TwistStamped()
            message.header.stamp = self.get_clock().now().to_msg()
            message.twist.linear.x, message.twist.angular.z = map(float, twist)
            self.twists.publish(message)

    def array(self) -> Any:
        array = GoalStatusArray()
        for number, status, second in self.nav2.statuses:
            one = GoalStatus()
            one.goal_info.goal_id.uuid = [number] * 16
            one.goal_info.stamp.sec, one.status = second, status
            array.status_list.append(one)
        return array


class Map(Node):
    """Say a map once, and keep it for those who come late: 60 by 40 cells with walls around."""

    def __init__(self) -> None:
        super().__init__("map_server")
        grid = OccupancyGrid()
        grid.header.frame_id = "map"
        grid.info.resolution, grid.info.width, grid.info.height = 0.1, 60, 40
        grid.info.origin.position.x, grid.info.origin.orientation.w = -3.0, 1.0
        walls = [100 if x in (0, 59) or y in (0, 39) else 0 for y in range(40) for x in range(60)]
        walls[20 * 60 + 55] = -1
        grid.data = walls
        self.maps = self.create_publisher(OccupancyGrid, "/map", KEPT)
        self.maps.publish(grid)


class Viewer(Node):
    """Say what is to be seen; it may come late."""

    def __init__(self) -> None:
        super().__init__("viewer")
        self.create_subscription(Path, "/pons/path", self.hear_path, KEPT)
        self.create_subscription(MarkerArray, "/pons/markers", self.hear_markers, KEPT)
        self.create_subscription(
            String, "/pons/status", lambda message: self.say(status=message.data), KEPT
        )
        self.create_subscription(DiagnosticArray, "/diagnostics", self.hear_diagnostics, 10)

    def say(self, **what: Any) -> None:
        print(json.dumps(what), flush=True)

    def hear_path(self, message: Any) -> None:
        at = [[one.pose.position.x, one.pose.position.y] for one in message.poses]
        self.say(path=at, frame=message.header.frame_id)

    def hear_markers(self, message: Any) -> None:
        self.say(markers=[one.text for one in message.markers[1:]])

    def hear_diagnostics(self, message: Any) -> None:
        self.say(diagnostics={one.name: one.message for one in message.status})


def main(arguments: list[str]) -> None:
    rclpy.init()
    kind, numbers = arguments[0], arguments[1:]
    if kind == "nav2":
        start, via = numbers[:3], numbers[3:]
        rclpy.spin(Nav2(list(map(float, start)), list(map(float, via))))
    else:
        made: dict[str, Any] = {"base": Base, "lidar": Lidar, "map": Map, "body": Body,
                                "viewer": Viewer}  # fmt: skip
        node = made[kind](*numbers)
        try:
            rclpy.spin(node)
        finally:
            if kind == "body":
                node.session.close()  # its threads would keep this process


if __name__ == "__main__":
    main(sys.argv[1:])
