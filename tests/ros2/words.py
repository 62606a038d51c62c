"""Make what the node on a robot says, and a base that listens to it."""

from __future__ import annotations

import json

from ros2.ros_base import RosBase
from wire import DriveCommand, Nav2State, RobotDescription

ROS_S = 1_800_000_000.0
"""What the robot's ROS clock shows at our second 0."""
STAMPED = "geometry_msgs/msg/TwistStamped"


def robot(*, scan: bool = True, imu: bool = True, **ros2: object) -> RobotDescription:
    return RobotDescription.model_validate(
        {
            "drive": {"kind": "ros2"},
            "lidar": {"kind": "ros2"} if scan else {},
            "inputs": {"imu": imu},
            "ros2": {"node": "tcp/127.0.0.1:7448"} | ros2,
        }
    )


def state(at_s: float, seq: int, **more: object) -> bytes:
    words = {
        "relay": "relay-1", "seq": seq, "t": at_s + 7.0, "ros": at_s + ROS_S,
        "echo_boot": "boot1", "echo_seq": seq, "timed_out": False, "on": True,
        "cmd_vel": STAMPED, "others": 0, "code": None, "found": "", "wrong": "", "keyed": False,
    } | more  # fmt: skip
    return json.dumps(words).encode()


def odometry(at_s: float, **more: object) -> bytes:
    words = {
        "stamp_s": at_s + ROS_S, "x_m": 0.0, "y_m": 0.0, "yaw_rad": 0.0, "v_mps": 0.0,
        "w_radps": 0.0, "battery": None, "estop": False, "bumper_front": False,
        "bumper_rear": False, "cliff": False,
    } | more  # fmt: skip
    return json.dumps(words).encode()


def scan(at_s: float, **more: object) -> bytes:
    words = {
        "stamp_s": at_s + ROS_S, "frame": "laser", "angle_min_rad": -3.0,
        "angle_increment_rad": 0.1, "time_increment_s": 0.001, "range_min_m": 0.1,
        "range_max_m": 8.0, "ranges_m": [1.0, 2.0, None, 0.05], "clockwise": False,
    } | more  # fmt: skip
    return json.dumps(words).encode()


def imu(at_s: float, yaw_rate_radps: float = 0.5) -> bytes:
    words = {
        "stamp_s": at_s + ROS_S, "yaw_rate_radps": yaw_rate_radps, "accel_x_mps2": 0.1,
        "accel_y_mps2": 0.2,
    }  # fmt: skip
    return json.dumps(words).encode()


def command(seq: int = 1, left: float = 1.0, right: float = 1.0) -> DriveCommand:
    return DriveCommand(boot="boot1", seq=seq, left_radps=left, right_radps=right, enable=True)


def driven(now_s: float = 10.0, relay_key: bytes = b"") -> RosBase:
    """Return a base that was reached and whose node has spoken."""
    base = RosBase(robot(), "ros2-test", relay_key)
    base.open(now_s)
    base.hear("state", state(now_s, 1), now_s)
    return base


def nav2_state(twist: int, v_mps: float, w_radps: float = 0.0, **more: object) -> Nav2State:
    words = {
        "boot_id": "relay-1", "seq": twist, "mission": None, "leg": 0, "phase": "idle",
        "phase_s": 0.0, "twist": twist, "twist_age_s": 0.0, "v_mps": v_mps, "w_radps": w_radps,
        "code": None, "detail": "",
    } | more  # fmt: skip
    return Nav2State.model_validate(words)
