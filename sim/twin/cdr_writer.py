"""Write the messages that a ROS 2 twin says as plain CDR, and read its one command. Pure.

A second implementation beside ``ros2.cdr``, field by field from the .msg files.
"""

from __future__ import annotations

import struct
from math import nan
from typing import Any

HEAD = b"\x00\x01\x00\x00"


class CdrWriter:
    """Append values, each at a multiple of its size behind the head."""

    def __init__(self) -> None:
        self._body = b""

    def put(self, code: str, *values: Any) -> CdrWriter:
        """Append numbers of one struct code."""
        size = struct.calcsize(code)
        self._body += bytes(-len(self._body) % size) + struct.pack(f"<{len(values)}{code}", *values)
        return self

    def text(self, text: str) -> CdrWriter:
        """Append a string."""
        raw = text.encode() + b"\x00"
        self.put("I", len(raw))
        self._body += raw
        return self

    def header(self, message: dict[str, Any]) -> CdrWriter:
        """Append a message's header."""
        stamp = message["header"]["stamp"]
        self.put("i", stamp["sec"]).put("I", stamp["nanosec"])
        return self.text(message["header"]["frame_id"])

    def xyz(self, vector: dict[str, float], axes: str = "xyz") -> CdrWriter:
        """Append the axes of a vector or quaternion."""
        return self.put("d", *(vector[axis] for axis in axes))

    def floats(self, values: list[float | None]) -> CdrWriter:
        """Append a list of float32, not-a-number for what is None."""
        self.put("I", len(values))
        return self.put("f", *(nan if one is None else one for one in values)) if values else self

    def bytes(self) -> bytes:
        """Return the message."""
        return HEAD + self._body


def string(message: dict[str, Any]) -> bytes:
    """Return std_msgs/String."""
    return CdrWriter().text(message["data"]).bytes()


def odometry(message: dict[str, Any]) -> bytes:
    """Return nav_msgs/Odometry."""
    pose, twist = message["pose"], message["twist"]
    writer = CdrWriter().header(message).text(message["child_frame_id"])
    writer.xyz(pose["pose"]["position"]).xyz(pose["pose"]["orientation"], "xyzw")
    writer.put("d", *pose["covariance"])
    writer.xyz(twist["twist"]["linear"]).xyz(twist["twist"]["angular"])
    return writer.put("d", *twist["covariance"]).bytes()


def imu(message: dict[str, Any]) -> bytes:
    """Return sensor_msgs/Imu, its orientation unknown."""
    unknown = (-1.0, *(0.0,) * 8)
    writer = CdrWriter().header(message).put("d", 0.0, 0.0, 0.0, 1.0, *unknown)
    writer.xyz(message["angular_velocity"]).put("d", *(0.0,) * 9)
    return writer.xyz(message["linear_acceleration"]).put("d", *(0.0,) * 9).bytes()


def laser_scan(message: dict[str, Any]) -> bytes:
    """Return sensor_msgs/LaserScan."""
    numbers = (
        "angle_min", "angle_max", "angle_increment", "time_increment", "scan_time", "range_min",
        "range_max",
    )  # fmt: skip
    writer = CdrWriter().header(message).put("f", *(message[one] for one in numbers))
    return writer.floats(message["ranges"]).floats(message["intensities"]).bytes()


def compressed_image(message: dict[str, Any]) -> bytes:
    """Return sensor_msgs/CompressedImage."""
    writer = CdrWriter().header(message).text(message["format"])
    data: bytes = message["data"]
    return writer.put("I", len(data)).bytes() + data


WRITERS = {
    "sensor_msgs/msg/CompressedImage": compressed_image,
    "std_msgs/msg/String": string,
    "nav_msgs/msg/Odometry": odometry,
    "sensor_msgs/msg/Imu": imu,
    "sensor_msgs/msg/LaserScan": laser_scan,
}


def read_string(payload: bytes) -> str:
    """Return what a std_msgs/String holds; empty where it is none."""
    if payload[:2] != HEAD[:2] or len(payload) < 8:
        return ""
    (length,) = struct.unpack_from("<I", payload, 4)
    return payload[8 : 8 + length].rstrip(b"\x00").decode("utf-8", "replace")
