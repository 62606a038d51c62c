"""Say a recording's messages in ROS 2's words: one function for each topic that both have.

Pure. Frames and topics are those that a robot of ROS 2 has: map, odom, base.
"""

from __future__ import annotations

import json
import struct
from math import cos, sin
from typing import TYPE_CHECKING, Any

from bridge.recording.protobuf import ranges_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from bridge.recording import recording_reader

Json = dict[str, Any]
Said = tuple[str, Json]
"""Topic and fields."""

TYPES = {
    "/scan": "sensor_msgs/LaserScan",
    "/tf_static": "tf2_msgs/TFMessage",
    "/tf": "tf2_msgs/TFMessage",
    "/odom": "nav_msgs/Odometry",
    "/pose": "geometry_msgs/PoseStamped",
    "/plan": "nav_msgs/Path",
    "/cmd_vel": "geometry_msgs/TwistStamped",
    "/rosout": "rcl_interfaces/Log",
    "/diagnostics": "diagnostic_msgs/DiagnosticArray",
}
_NS = 1_000_000_000
_LEVELS = {2: 20, 3: 30, 4: 40, 5: 50}
"""Of foxglove.Log, as rcl_interfaces/Log has them."""
_CAP, _HOLD = 1, 2
"""Of a row in diagnostic_msgs/DiagnosticStatus: WARN for what caps, ERROR for what holds."""
_FLOAT64 = struct.Struct("<d")


class Ros2Words:
    """Turn a recording's messages into ROS 2's; keeps a scan's ranges until its inbox comes."""

    def __init__(self) -> None:
        self._ranges: recording_reader.Raw | None = None

    def of(self, raw: recording_reader.Raw) -> Iterator[Said]:
        """Yield what one message of a recording is worth in ROS 2; most are worth nothing."""
        if raw.topic == "/scan":
            self._ranges = raw
        elif raw.topic == "/pons/inbox":
            kept, self._ranges = self._ranges, None
            if kept is not None and kept.sequence == raw.sequence:
                yield from _scan(json.loads(raw.data)["inbox"].get("scan"), kept)
        elif (make := _MAKERS.get(raw.topic)) is not None:
            yield make(json.loads(raw.data), raw.at_ns)


def _time(at_ns: int) -> Json:
    return {"sec": at_ns // _NS, "nanosec": at_ns % _NS}


def _stamp(told: Json) -> Json:
    return {"sec": told["timestamp"]["sec"], "nanosec": told["timestamp"]["nsec"]}


def _header(stamp: Json, frame: str) -> Json:
    return {"stamp": stamp, "frame_id": frame}


def _scan(told: Json | None, ranges: recording_reader.Raw) -> Iterator[Said]:
    if told is None:
        return
    packed = ranges_of(ranges.data)
    metres = [one for (one,) in _FLOAT64.iter_unpack(packed)]
    step_rad = told["angle_increment_rad"]
    yield (
        "/scan",
        {
            "header": _header(_time(ranges.at_ns), "lidar"),
            "angle_min": told["angle_min_rad"],
            "angle_max": told["angle_min_rad"] + step_rad * max(0, len(metres) - 1),
            "angle_increment": step_rad,
            "time_increment": told.get("time_increment_s", 0.0),
            "range_min": told["range_min_m"],
            "range_max": told["range_max_m"],
            "ranges": metres,
        },
    )


def _transform(told: Json, _at_ns: int) -> Said:
    return "/tf", {
        "transforms": [
            {
                "header": _header(_stamp(told), told["parent_frame_id"]),
                "child_frame_id": told["child_frame_id"],
                "transform": {"translation": told["translation"], "rotation": told["rotation"]},
            }
        ]
    }


def _boot(told: Json, at_ns: int) -> Said:
    """Return where the lidar sits on the robot."""
    lidar = told["config"]["robot"]["lidar"]
    yaw_rad = lidar["yaw_rad"]
    placed = {
        "translation": {"x": lidar["x_m"], "y": lidar["y_m"]},
        "rotation": {"z": sin(yaw_rad / 2), "w": cos(yaw_rad / 2)},
    }
    header = _header(_time(at_ns), "base")
    return "/tf_static", {
        "transforms": [{"header": header, "child_frame_id": "lidar", "transform": placed}]
    }


def _odometry(told: Json, at_ns: int) -> Said:
    base, twist = told["base_in_odom"], told["twist"]
    yaw_rad = base["yaw_rad"]
    pose = {
        "position": {"x": base["x_m"], "y": base["y_m"]},
        "orientation": {"z": sin(yaw_rad / 2), "w": cos(yaw_rad / 2)},
    }
    return "/odom", {
        "header": _header(_time(at_ns), "odom"),
        "child_frame_id": "base",
        "pose": {"pose": pose},
        "twist": {"twist": _twist(twist)},
    }


def _twist(told: Json) -> Json:
    return {"linear": {"x": told["v_mps"]}, "angular": {"z": told["w_radps"]}}


def _pose(told: Json, _at_ns: int) -> Said:
    header = _header(_stamp(told), told["frame_id"])
    return "/pose", {"header": header, "pose": told["pose"]}


def _plan(told: Json, _at_ns: int) -> Said:
    header = _header(_stamp(told), told["frame_id"])
    return "/plan", {
        "header": header,
        "poses": [{"header": header, "pose": pose} for pose in told["poses"]],
    }


def _command(told: Json, at_ns: int) -> Said:
    return "/cmd_vel", {"header": _header(_time(at_ns), "base"), "twist": _twist(told["sent"])}


def _log(told: Json, _at_ns: int) -> Said:
    level = _LEVELS.get(told["level"], 20)
    return "/rosout", {
        "stamp": _stamp(told), "level": level, "name": told["name"], "msg": told["message"],
    }  # fmt: skip


def _status(told: Json, at_ns: int) -> Said:
    """Return the rows in force; without any the bridge alone, and well."""
    rows = [
        {
            "level": _CAP if row["action"] in ("NONE", "CAP") else _HOLD,
            "name": f"bridge: {row['row']}",
            "message": row["evidence"],
            "hardware_id": told["robot"],
            "values": [{"key": "action", "value": row["action"]}],
        }
        for row in told["rows"]
    ]
    mode = {"name": "bridge", "message": told["mode"], "hardware_id": told["robot"]}
    return "/diagnostics", {"header": _header(_time(at_ns), ""), "status": [mode, *rows]}


_MAKERS: dict[str, Callable[[Json, int], Said]] = {
    "/pons/boot": _boot,
    "/tf": _transform,
    "/pons/odometry": _odometry,
    "/pose": _pose,
    "/plan": _plan,
    "/pons/decision": _command,
    "/log": _log,
    "/pons/status": _status,
}
