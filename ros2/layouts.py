"""Lay out the few ROS 2 messages that Pons speaks, as their .msg files do. Data, and its reading.

common_interfaces as of Humble to Kilted, which agree on all of these.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

_FIELD = re.compile(r"^([A-Za-z0-9_/]+)(\[(\d*)\])? ([a-z_]+)$")
_HEADER = "std_msgs/msg/Header header"
_VECTOR = "float64 x; float64 y; float64 z"
_GEOMETRY = "geometry_msgs/msg"

_TEXTS = {
    "builtin_interfaces/msg/Time": "int32 sec; uint32 nanosec",
    "std_msgs/msg/Header": "builtin_interfaces/msg/Time stamp; string frame_id",
    "std_msgs/msg/String": "string data",
    f"{_GEOMETRY}/Vector3": _VECTOR,
    f"{_GEOMETRY}/Point": _VECTOR,
    f"{_GEOMETRY}/Quaternion": f"{_VECTOR}; float64 w",
    f"{_GEOMETRY}/Pose": f"{_GEOMETRY}/Point position; {_GEOMETRY}/Quaternion orientation",
    f"{_GEOMETRY}/PoseStamped": f"{_HEADER}; {_GEOMETRY}/Pose pose",
    f"{_GEOMETRY}/PoseWithCovariance": f"{_GEOMETRY}/Pose pose; float64[36] covariance",
    f"{_GEOMETRY}/Twist": f"{_GEOMETRY}/Vector3 linear; {_GEOMETRY}/Vector3 angular",
    f"{_GEOMETRY}/TwistStamped": f"{_HEADER}; {_GEOMETRY}/Twist twist",
    f"{_GEOMETRY}/TwistWithCovariance": f"{_GEOMETRY}/Twist twist; float64[36] covariance",
    f"{_GEOMETRY}/Transform": f"{_GEOMETRY}/Vector3 translation; {_GEOMETRY}/Quaternion rotation",
    f"{_GEOMETRY}/TransformStamped": (
        f"{_HEADER}; string child_frame_id; {_GEOMETRY}/Transform transform"
    ),
    "unique_identifier_msgs/msg/UUID": "uint8[16] uuid",
    "action_msgs/msg/GoalInfo": (
        "unique_identifier_msgs/msg/UUID goal_id; builtin_interfaces/msg/Time stamp"
    ),
    "action_msgs/msg/GoalStatus": "action_msgs/msg/GoalInfo goal_info; int8 status",
    "action_msgs/msg/GoalStatusArray": "action_msgs/msg/GoalStatus[] status_list",
    "tf2_msgs/msg/TFMessage": f"{_GEOMETRY}/TransformStamped[] transforms",
    "nav_msgs/msg/Odometry": (
        f"{_HEADER}; string child_frame_id; {_GEOMETRY}/PoseWithCovariance pose; "
        f"{_GEOMETRY}/TwistWithCovariance twist"
    ),
    "nav_msgs/msg/MapMetaData": (
        "builtin_interfaces/msg/Time map_load_time; float32 resolution; uint32 width; "
        f"uint32 height; {_GEOMETRY}/Pose origin"
    ),
    "nav_msgs/msg/OccupancyGrid": f"{_HEADER}; nav_msgs/msg/MapMetaData info; int8[] data",
    "sensor_msgs/msg/LaserScan": (
        f"{_HEADER}; float32 angle_min; float32 angle_max; float32 angle_increment; "
        "float32 time_increment; float32 scan_time; float32 range_min; float32 range_max; "
        "float32[] ranges; float32[] intensities"
    ),
    "sensor_msgs/msg/CompressedImage": f"{_HEADER}; string format; uint8[] data",
    "sensor_msgs/msg/Imu": (
        f"{_HEADER}; {_GEOMETRY}/Quaternion orientation; float64[9] orientation_covariance; "
        f"{_GEOMETRY}/Vector3 angular_velocity; float64[9] angular_velocity_covariance; "
        f"{_GEOMETRY}/Vector3 linear_acceleration; float64[9] linear_acceleration_covariance"
    ),
}


@dataclass(frozen=True, slots=True)
class MessageField:
    """Hold one field of a message: its name, the type of one of it, and how many there are."""

    name: str
    kind: str
    is_list: bool = False
    """As many as the message says."""
    count: int = 0
    """So many, always; 0: one, or a list."""


def _field(text: str) -> MessageField:
    match = _FIELD.match(text)
    if match is None:
        raise ValueError(f"{text!r} is no field of a message")
    kind, array, count, name = match.groups()
    return MessageField(name, kind, is_list=bool(array) and not count, count=int(count or 0))


LAYOUTS = {
    kind: tuple(_field(one.strip()) for one in text.split(";")) for kind, text in _TEXTS.items()
}
"""The fields of each message, in order."""


def dds_name(kind: str) -> str:
    """Return how DDS and rmw_zenoh name a type: ``std_msgs::msg::dds_::String_``."""
    package, middle, name = kind.split("/")
    return f"{package}::{middle}::dds_::{name}_"


def ros_name(dds: str) -> str:
    """Return a type as ROS names it; one that is no message of ROS as it is."""
    parts = dds.split("::")
    if len(parts) == 4 and parts[2] == "dds_" and parts[3].endswith("_"):
        return f"{parts[0]}/{parts[1]}/{parts[3][:-1]}"
    return dds
