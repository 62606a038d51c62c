"""Be a part of a true ROS 2 graph, run by a Python that has rclpy: base, lidar, rosbridge server.

``base`` drives for ever by the last twist that it got, as a base without a dead-man does, and says
odometry at 50 Hz, and each twist as a line of JSON on stdout. ``lidar`` says three beams: too near
to measure (minus infinity), no return, 1.5 m. ``map`` says a map once and keeps it. ``body``
drives a simulated body behind the twin's server, and says what it senses. ``nav2`` is a small
stand-in for Nav2 (small_nav2), which begins at a pose and knows points to pass. ``bridge``
speaks rosbridge's protocol for the topics that Pons uses, on true publishers and subscriptions.
Knows nothing of Pons.
"""

from __future__ import annotations

import asyncio
import base64
import json
import math
import sys
import threading
import time
from typing import Any, ClassVar

import rclpy
import small_nav2  # type: ignore[import-not-found]  # beside this file, where its Python looks
from action_msgs.msg import GoalStatus, GoalStatusArray
from geometry_msgs.msg import PoseStamped, Twist, TwistStamped
from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import CompressedImage, Image, Imu, LaserScan
from std_msgs.msg import String

KINDS = {
    "action_msgs/msg/GoalStatusArray": GoalStatusArray,
    "geometry_msgs/msg/PoseStamped": PoseStamped,
    "geometry_msgs/msg/Twist": Twist,
    "geometry_msgs/msg/TwistStamped": TwistStamped,
    "nav_msgs/msg/Odometry": Odometry,
    "nav_msgs/msg/OccupancyGrid": OccupancyGrid,
    "sensor_msgs/msg/CompressedImage": CompressedImage,
    "sensor_msgs/msg/Image": Image,
    "sensor_msgs/msg/Imu": Imu,
    "sensor_msgs/msg/LaserScan": LaserScan,
    "std_msgs/msg/String": String,
}
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
    """Be the driver of a base whose wheels, lidar and gyro a simulator plays (sim.twin).

    What moves it is cmd_vel alone, by the last twist; the simulator's own relay is its firmware.
    """

    SENSED: ClassVar = {"/odom": Odometry, "/scan": LaserScan, "/imu": Imu}

    def __init__(self, port: int) -> None:
        super().__init__("body")
        self.v = self.w = 0.0
        self.seq, self.ahead_s = 0, math.inf
        self.port = port
        self.says = {
            topic: self.create_publisher(
                kind, topic, qos_profile_sensor_data if topic == "/scan" else 10
            )
            for topic, kind in self.SENSED.items()
        }
        self.create_subscription(TwistStamped, "/cmd_vel", self.hear, 10)
        threading.Thread(target=self.serve, daemon=True).start()

    def hear(self, message: Any) -> None:
        self.v, self.w = message.twist.linear.x, message.twist.angular.z

    def serve(self) -> None:
        from websockets.sync.client import connect

        with connect(f"ws://127.0.0.1:{self.port}", compression=None, max_size=None) as socket:
            for topic in ("/pons/state", *self.SENSED):
                socket.send(json.dumps({"op": "subscribe", "topic": topic}))
            for frame in socket:
                said = json.loads(frame)
                if said.get("topic") == "/pons/state":
                    socket.send(self.command(json.loads(said["msg"]["data"])))
                elif said.get("topic") in self.says:
                    self.say(said["topic"], said["msg"])

    def command(self, state: dict[str, Any]) -> str:
        """Return what the simulator's firmware is to do; note how far our clock is ahead of it."""
        self.ahead_s = min(self.ahead_s, self.get_clock().now().nanoseconds * 1e-9 - state["ros"])
        self.seq += 1
        words = {
            "boot": "body", "seq": self.seq, "relay": state["relay"], "seen": state["t"],
            "ttl": 0.5, "on": True, "v": self.v, "w": self.w,
        }  # fmt: skip
        message = {"data": json.dumps(words)}
        return json.dumps({"op": "publish", "topic": "/pons/command", "msg": message})

    def say(self, topic: str, raw: dict[str, Any]) -> None:
        if math.isfinite(self.ahead_s):
            message = self.SENSED[topic]()
            fill(message, raw)
            stamp = raw["header"]["stamp"]
            stamp_s = stamp["sec"] + stamp["nanosec"] * 1e-9 + self.ahead_s
            message.header.stamp.sec = int(stamp_s)
            message.header.stamp.nanosec = int((stamp_s % 1.0) * 1e9)
            self.says[topic].publish(message)


def fill(message: Any, raw: dict[str, Any]) -> None:
    """Put JSON into a message; null is no return."""
    for name, value in raw.items():
        if isinstance(value, dict):
            fill(getattr(message, name), value)
        elif isinstance(value, list):
            setattr(message, name, [math.inf if one is None else float(one) for one in value])
        elif name not in ("sec", "nanosec"):
            setattr(message, name, value)


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
        raw = {
            "header": {"frame_id": message.header.frame_id},
            "pose": {
                "position": {"x": at.x, "y": at.y},
                "orientation": {"z": turn.z, "w": turn.w},
            },
        }
        self.nav2.hear(raw, time.monotonic(), (self.pose[0], self.pose[1]))
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


class Bridge(Node):
    """Speak rosbridge to one client at a time."""

    def __init__(self) -> None:
        super().__init__("rosbridge")
        self.said: dict[str, Any] = {}
        self.loop: asyncio.AbstractEventLoop | None = None
        self.socket: Any = None
        self.heard: dict[str, Any] = {}

    def obey(self, raw: dict[str, Any]) -> dict[str, Any] | None:
        operation, topic = raw["op"], str(raw.get("topic"))
        if operation == "advertise" and topic not in self.said:
            self.said[topic] = self.create_publisher(KINDS[raw["type"]], topic, 10)
        elif operation == "publish":
            self.said[topic].publish(made_of(raw["msg"], self.said[topic].msg_type))
        elif operation == "unadvertise":
            self.destroy_publisher(self.said.pop(topic))
        elif operation == "subscribe" and topic not in self.heard:
            kind = KINDS[raw["type"]]
            infos = self.get_publishers_info_by_topic(topic)
            kept = any(one.qos_profile.durability == KEPT.durability for one in infos)
            self.heard[topic] = self.create_subscription(
                kind, topic, lambda message: self.tell(topic, message),
                KEPT if kept else qos_profile_sensor_data,  # as rosbridge_suite does
            )  # fmt: skip
        elif operation == "call_service":
            asked = raw["args"]["topic"]
            known = dict(self.get_topic_names_and_types())
            values = {"type": (known.get(asked) or [""])[0]}
            return {"op": "service_response", "id": raw["id"], "service": raw["service"],
                    "values": values, "result": True}  # fmt: skip
        return None

    def tell(self, topic: str, message: Any) -> None:
        socket, loop = self.socket, self.loop
        if socket is not None and loop is not None:
            frame = json.dumps({"op": "publish", "topic": topic, "msg": as_json(message)})
            asyncio.run_coroutine_threadsafe(socket.send(frame), loop)

    async def serve(self, port: int) -> None:
        from websockets.asyncio.server import serve

        async def attend(socket: Any) -> None:
            self.socket = socket
            async for frame in socket:
                answer = self.obey(json.loads(frame))
                if answer is not None:
                    await socket.send(json.dumps(answer))

        self.loop = asyncio.get_running_loop()
        async with serve(attend, "127.0.0.1", port, compression=None):
            print("ready", flush=True)
            await asyncio.Event().wait()


def made_of(raw: dict[str, Any], kind: Any) -> Any:
    """Return a string, a pose or a twist."""
    if kind is String:
        return String(data=raw["data"])
    if kind is PoseStamped:
        pose = PoseStamped()
        fill(pose.pose, raw["pose"])
        pose.header.frame_id = raw["header"]["frame_id"]
        return pose
    message, twist = kind(), raw.get("twist", raw)
    inner = getattr(message, "twist", message)
    inner.linear.x, inner.angular.z = twist["linear"]["x"], twist["angular"]["z"]
    return message


def as_json(value: Any) -> Any:
    """Return a message as rosbridge writes it: what is not finite is null."""
    if hasattr(value, "get_fields_and_field_types"):
        return {name: as_json(getattr(value, name)) for name in value.get_fields_and_field_types()}
    if "B" in (getattr(value, "typecode", None), getattr(getattr(value, "dtype", None), "char", 0)):
        return base64.b64encode(value.tobytes()).decode()  # as rosbridge_suite does
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, str | int | bool):
        return value
    return [as_json(one) for one in value]


def main(arguments: list[str]) -> None:
    rclpy.init()
    if arguments[0] == "base":
        rclpy.spin(Base(arguments[1]))
        return
    if arguments[0] == "lidar":
        rclpy.spin(Lidar())
        return
    if arguments[0] == "body":
        rclpy.spin(Body(int(arguments[1])))
        return
    if arguments[0] == "map":
        rclpy.spin(Map())
        return
    if arguments[0] == "nav2":
        numbers = [float(word) for word in arguments[1:]]
        rclpy.spin(Nav2(numbers[:3], numbers[3:]))
        return
    bridge = Bridge()
    threading.Thread(target=rclpy.spin, args=(bridge,), daemon=True).start()
    asyncio.run(bridge.serve(int(arguments[1])))


if __name__ == "__main__":
    main(sys.argv[1:])
