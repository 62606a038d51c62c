"""Hear what the robot's topics say, and say it on Pons' wire."""

from __future__ import annotations

import time
from functools import partial
from typing import Any

from nav_msgs.msg import OccupancyGrid, Odometry
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import BatteryState, CompressedImage, Image, Imu, LaserScan
from std_msgs.msg import Bool

from . import readings
from .graph_check import Need
from .link import PlannerLink
from .pictures import COMPRESSED, RAW, read_picture
from .readings import UnusableMessage

try:
    from tf2_msgs.msg import TFMessage
except ImportError:  # where a test's ROS lacks it nobody asks where the lidar sits
    TFMessage = None

KEPT = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
FRAMES = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
INPUTS = ("estop", "bumper_front", "bumper_rear", "cliff")
OLD_S = 1.0
"""An input that was not told for so long is not known, and counts as pressed."""
WRONG_S = 2.0
"""So long a message that could not be read is told of."""
AGAIN_S = 2.0
"""What publishers say once is said again so often, for those who come late."""
KINDS: dict[str, tuple[str, Any, Any]] = {
    "odom": ("nav_msgs/msg/Odometry", Odometry, readings.read_odometry),
    "scan": ("sensor_msgs/msg/LaserScan", LaserScan, readings.read_scan),
    "imu": ("sensor_msgs/msg/Imu", Imu, readings.read_imu),
}
PICTURES = {COMPRESSED: CompressedImage, RAW: Image}


class Senses:
    """Subscribe for one node, and keep what is told with the next odometry."""

    def __init__(
        self, node: Any, link: PlannerLink, names: dict[str, str], scan_zero: str, picture_hz: float
    ) -> None:
        """Subscribe to all topics that are named; pictures only while somebody looks."""
        self._node, self._link, self._names = node, link, names
        self._wrong: tuple[str, float] = ("", 0.0)
        self._battery: float | None = None
        self._inputs: dict[str, tuple[bool, float]] = {}
        self._frames: dict[str, readings.Words] = {}
        self._map: Any = None
        self._map_s = self._frames_s = 0.0
        self._looking: dict[str, Any] = {}
        self._picture_hz, self._pictured_s = picture_hz, dict[str, float]()
        for name, (_, kind, read) in KINDS.items():
            reader: Any = partial(read, zero=scan_zero) if name == "scan" else read
            self._subscribe(name, kind, partial(self._say, name, reader))
        self._subscribe("battery", BatteryState, self._hear_battery)
        for name in INPUTS:
            self._subscribe(name, Bool, partial(self._hear_input, name))
        self._subscribe("map", OccupancyGrid, self._hear_map, KEPT)
        if TFMessage is not None:
            node.create_subscription(TFMessage, "/tf_static", self._hear_frames, FRAMES)

    def needs(self) -> list[Need]:
        """Return the topics that a base must have."""
        return [
            Need(name, self._names[name], kind)
            for name, (kind, _, _) in KINDS.items()
            if self._names[name]
        ]

    def wrong(self, now_s: float) -> str:
        """Return which message could not be read lately, and why; empty: none."""
        why, at_s = self._wrong
        return why if now_s - at_s <= WRONG_S else ""

    def look(self, now_s: float) -> None:
        """Say again what is said once, and hear pictures while somebody looks."""
        if self._frames and now_s - self._frames_s >= AGAIN_S:
            self._frames_s = now_s
            self._link.say("frames", list(self._frames.values()))
        if self._map is not None and now_s - self._map_s >= AGAIN_S:
            self._say_map(now_s)
        for name in ("picture", "depth"):
            if self._names[name]:
                self._look_for(name)

    def _look_for(self, name: str) -> None:
        topic, wanted = self._names[name], self._link.has_listener(name)
        if not wanted and name in self._looking:
            self._node.destroy_subscription(self._looking.pop(name))
        elif wanted and name not in self._looking:
            kinds = {one.topic_type for one in self._node.get_publishers_info_by_topic(topic)}
            known = kinds & set(PICTURES)
            if len(kinds) == 1 and known:
                self._looking[name] = self._node.create_subscription(
                    PICTURES[known.pop()], topic, partial(self._hear_picture, name),
                    qos_profile_sensor_data,
                )  # fmt: skip
            else:
                code = "ros2_topic_type" if kinds else "ros2_topic_missing"
                found = " and ".join(sorted(kinds)) or "not there"
                head = {"code": code, "found": f"{name} {topic} is {found}, expected a picture"}
                self._link.say_bytes(name, head, b"")

    def _subscribe(
        self, name: str, kind: Any, take: Any, qos: Any = qos_profile_sensor_data
    ) -> None:
        if self._names[name]:
            self._node.create_subscription(kind, self._names[name], take, qos)

    def _say(self, name: str, read: Any, message: Any) -> None:
        try:
            words = read(message)
        except UnusableMessage as why:
            self._wrong = f"{self._names[name]}: {why}"[:200], time.monotonic()
            return
        if name == "odom":
            words |= {"battery": self._battery, **self._read_inputs(time.monotonic())}
        self._link.say(name, words)

    def _read_inputs(self, now_s: float) -> dict[str, bool | None]:
        """Return the inputs; what is not wired is false, what fell silent is not known."""
        told: dict[str, bool | None] = {}
        for name in INPUTS:
            pressed, at_s = self._inputs.get(name, (None, now_s))
            told[name] = pressed if now_s - at_s <= OLD_S else None
            if not self._names[name]:
                told[name] = False
        return told

    def _hear_input(self, name: str, message: Any) -> None:
        self._inputs[name] = bool(message.data), time.monotonic()

    def _hear_battery(self, message: Any) -> None:
        self._battery = readings.read_battery(message)

    def _hear_frames(self, message: Any) -> None:
        for one in readings.read_frames(message):
            self._frames[one["child"]] = one
        self._frames_s = 0.0

    def _hear_map(self, message: Any) -> None:
        self._map, self._map_s = message, 0.0

    def _say_map(self, now_s: float) -> None:
        if not self._link.has_listener("map"):
            return
        self._map_s = now_s
        topic, data = self._names["map"], self._map.data
        cells = data.tobytes() if hasattr(data, "tobytes") else bytes(x & 255 for x in data)
        try:
            head = readings.read_map(self._map)
        except UnusableMessage as why:
            head, cells = {"code": "ros2_unreadable", "found": f"{topic}: {why}"}, b""
        self._link.say_bytes("map", head | {"topic": topic}, cells)

    def _hear_picture(self, name: str, message: Any) -> None:
        now_s = time.monotonic()
        if now_s - self._pictured_s.get(name, 0.0) < 0.5 / self._picture_hz:
            return
        self._pictured_s[name] = now_s
        try:
            head, data = read_picture(message, depth=name == "depth")
        except UnusableMessage as why:
            head, data = {"code": "ros2_unreadable", "found": f"{self._names[name]}: {why}"}, b""
        self._link.say_bytes(name, head, data)
