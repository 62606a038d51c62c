"""Write ROS 2 messages: their definitions as text, and their fields as CDR.

Knows a few message types of ROS 2 Humble to Jazzy (the same in each), and nothing of a running ROS.
CDR as in DDS-XTypes 1.3, 7.4.3: little endian, each number aligned to its own size.
"""

from __future__ import annotations

import struct
from typing import Any, Final

HEADER_BYTES: Final = b"\x00\x01\x00\x00"
"""Encapsulation: CDR, little endian, version 1."""
_NUMBERS = {
    "bool": "?", "byte": "B", "uint8": "B", "int32": "i", "uint32": "I",
    "float32": "f", "float64": "d",
}  # fmt: skip
_RULE = "=" * 80

DEFINITIONS: dict[str, str] = {
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id",
    "geometry_msgs/Vector3": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Point": "float64 x\nfloat64 y\nfloat64 z",
    "geometry_msgs/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w",
    "geometry_msgs/Pose": "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation",
    "geometry_msgs/PoseStamped": "std_msgs/Header header\ngeometry_msgs/Pose pose",
    "geometry_msgs/PoseWithCovariance": "geometry_msgs/Pose pose\nfloat64[36] covariance",
    "geometry_msgs/Twist": "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular",
    "geometry_msgs/TwistStamped": "std_msgs/Header header\ngeometry_msgs/Twist twist",
    "geometry_msgs/TwistWithCovariance": "geometry_msgs/Twist twist\nfloat64[36] covariance",
    "geometry_msgs/Transform": (
        "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation"
    ),
    "geometry_msgs/TransformStamped": (
        "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform"
    ),
    "tf2_msgs/TFMessage": "geometry_msgs/TransformStamped[] transforms",
    "nav_msgs/Odometry": (
        "std_msgs/Header header\nstring child_frame_id\n"
        "geometry_msgs/PoseWithCovariance pose\ngeometry_msgs/TwistWithCovariance twist"
    ),
    "nav_msgs/Path": "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses",
    "sensor_msgs/LaserScan": (
        "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
        "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
        "float32[] ranges\nfloat32[] intensities"
    ),
    "rcl_interfaces/Log": (
        "uint8 DEBUG=10\nuint8 INFO=20\nuint8 WARN=30\nuint8 ERROR=40\nuint8 FATAL=50\n"
        "builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\n"
        "string function\nuint32 line"
    ),
    "diagnostic_msgs/KeyValue": "string key\nstring value",
    "diagnostic_msgs/DiagnosticStatus": (
        "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\n"
        "string message\nstring hardware_id\ndiagnostic_msgs/KeyValue[] values"
    ),
    "diagnostic_msgs/DiagnosticArray": (
        "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status"
    ),
}  # fmt: skip
"""The fields of each type, from the ROS interface packages (BSD-3-Clause, Apache-2.0)."""


def ros_name(kind: str) -> str:
    """Return a type's name as ROS 2 says it: ``nav_msgs/Path`` becomes ``nav_msgs/msg/Path``."""
    return kind.replace("/", "/msg/")


def definition(kind: str) -> str:
    """Return a type's text with those that it is made of, as a recording holds it."""
    names = [kind]
    for name in names:  # grows while it is walked
        for word, _ in _fields(name):
            part = word.partition("[")[0]
            if part in DEFINITIONS and part not in names:
                names.append(part)
    first, *others = names
    return DEFINITIONS[first] + "".join(
        f"\n{_RULE}\nMSG: {name}\n{DEFINITIONS[name]}" for name in others
    )


def encode(kind: str, message: dict[str, Any]) -> bytes:
    """Return a message in CDR; a field that is not named is zero, empty or all zeros."""
    out = bytearray()
    _write(out, kind, message)
    return HEADER_BYTES + bytes(out)


def _fields(kind: str) -> list[tuple[str, str]]:
    """Return a type's fields as pairs of type and name; its constants are none."""
    lines = (line for line in DEFINITIONS[kind].splitlines() if "=" not in line)
    return [(word, name) for word, name in (line.split() for line in lines)]


def _write(out: bytearray, kind: str, value: Any) -> None:
    base, bracket, count = kind.partition("[")
    if bracket:
        _write_many(out, base, value, count.rstrip("]"))
    elif kind == "string":
        text = str(value if value is not None else "").encode() + b"\0"
        _write(out, "uint32", len(text))
        out += text
    elif (letter := _NUMBERS.get(kind)) is not None:
        _align(out, letter)
        out += struct.pack(f"<{letter}", value or 0)
    else:
        given = value or {}
        for word, name in _fields(kind):
            _write(out, word, given.get(name))


def _write_many(out: bytearray, base: str, value: Any, count: str) -> None:
    items = list(value or ()) or ([0.0] * int(count) if count else [])
    if not count:
        _write(out, "uint32", len(items))
    if (letter := _NUMBERS.get(base)) is not None:
        if items:
            _align(out, letter)
        out += struct.pack(f"<{len(items)}{letter}", *items)
        return
    for item in items:
        _write(out, base, item)


def _align(out: bytearray, letter: str) -> None:
    size = struct.calcsize(f"<{letter}")
    out += b"\0" * (-len(out) % size)
