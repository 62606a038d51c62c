"""Make what a graph says, and a robot that listens to it."""

from __future__ import annotations

import json
from math import cos, sin
from typing import Any

from ros2 import BaseLink, rosbridge
from ros2.operations import Request, TopicMessage, TopicType
from wire import DriveCommand, RobotDescription

ROS_S = 1_800_000_000.0
"""What the robot's ROS clock shows at our second 0."""
TYPES = {
    "/cmd_vel": "geometry_msgs/msg/TwistStamped",
    "/pons/state": "std_msgs/msg/String",
    "/odom": "nav_msgs/msg/Odometry",
    "/scan": "sensor_msgs/msg/LaserScan",
    "/imu": "sensor_msgs/msg/Imu",
}


def robot(**ros2: object) -> RobotDescription:
    part = {"url": "ws://127.0.0.1:9090", "scan": "/scan", "imu": "/imu"} | ros2
    part = {key: value for key, value in part.items() if value is not None}
    lidar = {"kind": "ros2"} if "scan" in part else {}
    return RobotDescription.model_validate(
        {
            "drive": {"kind": "ros2"},
            "lidar": lidar,
            "inputs": {"imu": "imu" in part},
            "ros2": part,
        }
    )


def on_topic(topic: str, message: dict[str, Any]) -> TopicMessage:
    return TopicMessage(topic, message)


def graph_answer(topic: str, kind: str) -> TopicType:
    return TopicType(topic, kind)


def as_operations(requests: list[Request]) -> list[dict[str, Any]]:
    """Return requests as rosbridge writes them."""
    return [json.loads(rosbridge.write(one)) for one in requests]


def header(at_s: float) -> dict[str, Any]:
    whole = int(at_s + ROS_S)
    return {"stamp": {"sec": whole, "nanosec": round((at_s + ROS_S - whole) * 1e9)}}


def odometry(
    at_s: float, x_m: float = 0.0, y_m: float = 0.0, yaw_rad: float = 0.0, v: float = 0.0
) -> dict[str, Any]:
    turned = {"x": 0.0, "y": 0.0, "z": sin(yaw_rad / 2), "w": cos(yaw_rad / 2)}
    pose = {"position": {"x": x_m, "y": y_m, "z": 0.0}, "orientation": turned}
    twist = {"linear": {"x": v, "y": 0.0}, "angular": {"z": 0.0}}
    return {"header": header(at_s), "pose": {"pose": pose}, "twist": {"twist": twist}}


def scan(at_s: float, **more: object) -> dict[str, Any]:
    return {
        "header": header(at_s),
        "angle_min": -3.0,
        "angle_increment": 0.1,
        "time_increment": 0.001,
        "range_min": 0.1,
        "range_max": 8.0,
        "ranges": [1.0, 2.0, None, 0.05],
    } | more


def imu(at_s: float, yaw_rate: float = 0.5) -> dict[str, Any]:
    return {
        "header": header(at_s),
        "angular_velocity": {"x": 0.0, "y": 0.0, "z": yaw_rate},
        "linear_acceleration": {"x": 0.1, "y": 0.2, "z": 9.81},
    }


def relay_state(at_s: float, seq: int, **more: object) -> dict[str, Any]:
    state = {
        "relay": "relay-1", "seq": seq, "t": at_s + 7.0, "ros": at_s + ROS_S,
        "echo_boot": "boot1", "echo_seq": seq, "timed_out": False, "on": True,
        "cmd_vel": TYPES["/cmd_vel"], "others": 0,
    } | more  # fmt: skip
    return {"data": json.dumps(state)}


def command(seq: int = 1, left: float = 1.0, right: float = 1.0) -> DriveCommand:
    return DriveCommand(boot="boot1", seq=seq, left_radps=left, right_radps=right, enable=True)


def opened(now_s: float = 10.0, relay_key: bytes = b"", **ros2: object) -> BaseLink:
    """Return a link whose graph has answered."""
    link = BaseLink(robot(**ros2), "ros2-test", relay_key)
    link.open(now_s)
    link.due(now_s)
    for topic, kind in TYPES.items():
        link.hear(graph_answer(topic, kind), now_s)
    return link


def driven(now_s: float = 10.0, relay_key: bytes = b"", **ros2: object) -> BaseLink:
    """Return a link that has subscribed and heard the relay."""
    link = opened(now_s, relay_key, **ros2)
    link.due(now_s)
    link.hear(on_topic("/pons/state", relay_state(now_s, 1)), now_s)
    return link
