"""Read ROS messages into words of Pons' wire: what is not finite, or no pose, is no reading.

Messages are told apart from nothing of ROS but their field names, so that all of this runs without
it. REP-103 on both sides; stamps stay on the robot's ROS clock.
"""

from __future__ import annotations

import math
from typing import Any

MOST = 1e12
MAX_BEAMS = 2048
SLOWEST_BEAM_S = 0.01
MOST_NAME = 64
TILT = 1e-3
_UNIT = 0.1
"""How far a quaternion's length may be off: some bases send all zeros, which turns by nothing."""
Words = dict[str, Any]


class UnusableMessage(Exception):
    """A message that can't be used; says which field held what."""


def stamp_of(message: Any) -> float:
    """Return a message's stamp [s] on the robot's ROS clock."""
    stamp = message.header.stamp
    return float(stamp.sec + stamp.nanosec * 1e-9)


def yaw_of(turn: Any, name: str) -> float:
    """Return the heading of an orientation.

    Raises:
        UnusableMessage: it is none.
    """
    x, y, z, w = (_number(getattr(turn, axis), f"{name}.{axis}") for axis in "xyzw")
    length = math.hypot(x, y, z, w)
    if not abs(length - 1.0) <= _UNIT:
        raise UnusableMessage(f"{name} has length {length:.3g}, expected 1")
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def read_odometry(message: Any) -> Words:
    """Read nav_msgs/Odometry.

    Raises:
        UnusableMessage: a field is not finite, or the orientation is none.
    """
    pose, twist = message.pose.pose, message.twist.twist
    return {
        "stamp_s": stamp_of(message),
        "x_m": _number(pose.position.x, "pose.pose.position.x"),
        "y_m": _number(pose.position.y, "pose.pose.position.y"),
        "yaw_rad": yaw_of(pose.orientation, "pose.pose.orientation"),
        "v_mps": _number(twist.linear.x, "twist.twist.linear.x"),
        "w_radps": _number(twist.angular.z, "twist.twist.angular.z"),
    }


def read_imu(message: Any) -> Words:
    """Read sensor_msgs/Imu.

    Raises:
        UnusableMessage: a field is not finite.
    """
    accel = message.linear_acceleration
    return {
        "stamp_s": stamp_of(message),
        "yaw_rate_radps": _number(message.angular_velocity.z, "angular_velocity.z"),
        "accel_x_mps2": _number(accel.x, "linear_acceleration.x"),
        "accel_y_mps2": _number(accel.y, "linear_acceleration.y"),
    }


def read_scan(message: Any, zero: str = "near") -> Words:
    """Read sensor_msgs/LaserScan; of more beams than the wire carries, the nearest of each few.

    Raises:
        UnusableMessage: its angles or ranges are no lidar's.
    """
    step_rad = _number(message.angle_increment, "angle_increment")
    least_m, most_m = (
        _number(message.range_min, "range_min"),
        _number(message.range_max, "range_max"),
    )
    ranges = [_range(one, most_m, zero) for one in message.ranges]
    if not 0.0 < abs(step_rad) * len(ranges) <= 2.0 * math.pi + 0.2:
        found = f"angle_increment {step_rad:.4g} times {len(ranges)} beams"
        raise UnusableMessage(f"{found} is no turn or part of one")
    if not 0.0 <= least_m < most_m <= 1000.0:
        raise UnusableMessage(f"range_min {least_m:g} and range_max {most_m:g} are no lidar's")
    first_rad = _number(message.angle_min, "angle_min")
    if step_rad < 0.0:
        first_rad += step_rad * (len(ranges) - 1)
        ranges.reverse()
    each = -(-len(ranges) // MAX_BEAMS)
    if each > 1:
        ranges = [_nearest(ranges[at : at + each]) for at in range(0, len(ranges), each)]
    beam_s = _number(message.time_increment, "time_increment") * each
    first_rad += abs(step_rad) * (each - 1) / 2.0
    return {
        "stamp_s": stamp_of(message),
        "frame": str(message.header.frame_id)[:MOST_NAME],
        "angle_min_rad": math.remainder(first_rad, 2.0 * math.pi),
        "angle_increment_rad": abs(step_rad) * each,
        "time_increment_s": min(max(beam_s, 0.0), SLOWEST_BEAM_S),
        "range_min_m": least_m,
        "range_max_m": most_m,
        "ranges_m": ranges,
        "clockwise": step_rad < 0.0,
    }


def read_twist(message: Any) -> tuple[float, float, float]:
    """Return forward [m/s], sideways [m/s] and turning [rad/s] of a Twist or TwistStamped.

    Raises:
        UnusableMessage: one is not finite.
    """
    twist = getattr(message, "twist", message)
    linear = twist.linear
    v, sideways = _number(linear.x, "linear.x"), _number(linear.y, "linear.y")
    return v, sideways, _number(twist.angular.z, "angular.z")


def read_battery(message: Any) -> float | None:
    """Return how full sensor_msgs/BatteryState says the battery is; None where it can't tell."""
    full = float(message.percentage)
    return full if 0.0 <= full <= 1.0 else None


def read_map(message: Any) -> Words:
    """Return all of a nav_msgs/OccupancyGrid but its cells.

    Raises:
        UnusableMessage: a field is not finite, or the map is tilted.
    """
    info, origin = message.info, message.info.origin
    turn = origin.orientation
    if not (abs(turn.x) <= TILT and abs(turn.y) <= TILT):
        raise UnusableMessage("info.origin.orientation is tilted, expected a turn about z")
    return {
        "resolution_m": round(_number(info.resolution, "info.resolution"), 6),  # a float32
        "width": info.width,
        "height": info.height,
        "x_m": _number(origin.position.x, "info.origin.position.x"),
        "y_m": _number(origin.position.y, "info.origin.position.y"),
        "yaw_rad": yaw_of(turn, "info.origin.orientation") if turn.z or turn.w else 0.0,
    }


def read_frames(message: Any) -> list[Words]:
    """Return the transforms of a tf2_msgs/TFMessage that are finite."""
    read = []
    for one in message.transforms:
        at, turn = one.transform.translation, one.transform.rotation
        numbers = [float(getattr(at, axis)) for axis in "xyz"]
        turned = [float(getattr(turn, axis)) for axis in "xyzw"]
        if all(map(math.isfinite, (*numbers, *turned))):
            parent = str(one.header.frame_id)[:MOST_NAME]
            child = str(one.child_frame_id)[:MOST_NAME]
            read.append({"parent": parent, "child": child, "at_m": numbers, "turned": turned})
    return read


def _nearest(ranges: list[float | None]) -> float | None:
    return min((one for one in ranges if one is not None), default=None)


def _range(value: float, most_m: float, zero: str) -> float | None:
    """Return a range [m]. Minus infinity is too near to measure (REP-117)."""
    if value == 0.0 and zero == "nothing":
        return None
    if value <= 0.0:
        return 0.0
    return round(float(value), 4) if value <= most_m else None  # not-a-number: nothing came back


def _number(value: Any, name: str) -> float:
    if not -MOST <= value <= MOST:
        raise UnusableMessage(f"{name} holds {value!r}, expected a finite number")
    return float(value)
