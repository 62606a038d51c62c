"""Read ROS messages as rosbridge writes them: odometry, scans, gyro. Pure; REP-103 on both sides.

Each reader takes what it needs and refuses the message where that is missing, null or not finite:
a pose with a hole in it is no pose. Only a beam may be null, which is how JSON says infinity.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, hypot, pi, remainder
from typing import Literal

from ros2.operations import Message
from ros2.robot_words import Unreadable
from wire.bounded_types import MAX_BEAMS

SLOWEST_BEAM_S = 0.01
MOST = 1e12
"""No stamp, length or speed of a robot is more; integers of JSON know no bound."""
_UNIT = 0.1
"""How far a quaternion's length may be off: some bases send all zeros, which turns by nothing."""


@dataclass(frozen=True, slots=True)
class OdometryReading:
    """Hold one pose of the base in its odometry frame, and its twist."""

    stamp_s: float
    """On the robot's ROS clock, as all stamps here."""
    x_m: float
    y_m: float
    yaw_rad: float
    v_mps: float
    w_radps: float


@dataclass(frozen=True, slots=True)
class ScanReading:
    """Hold one planar scan, counter-clockwise; a beam is None where nothing came back."""

    stamp_s: float
    angle_min_rad: float
    angle_increment_rad: float
    time_increment_s: float
    range_min_m: float
    range_max_m: float
    ranges_m: tuple[float | None, ...]
    clockwise: bool


@dataclass(frozen=True, slots=True)
class ImuReading:
    """Hold the rate of turn and the acceleration."""

    stamp_s: float
    yaw_rate_radps: float
    accel_x_mps2: float
    accel_y_mps2: float


def read_odometry(message: Message) -> OdometryReading:
    """Read nav_msgs/Odometry.

    Raises:
        Unreadable: a field is missing or not finite, or the orientation is none.
    """
    x, y, z, w = (_number(message, "pose", "pose", "orientation", axis) for axis in "xyzw")
    length = hypot(x, y, z, w)
    if not abs(length - 1.0) <= _UNIT:
        raise Unreadable(f"pose.pose.orientation has length {length:.3g}, expected 1")
    return OdometryReading(
        stamp_s=stamp_of(message),
        x_m=_number(message, "pose", "pose", "position", "x"),
        y_m=_number(message, "pose", "pose", "position", "y"),
        yaw_rad=atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
        v_mps=_number(message, "twist", "twist", "linear", "x"),
        w_radps=_number(message, "twist", "twist", "angular", "z"),
    )


def read_imu(message: Message) -> ImuReading:
    """Read sensor_msgs/Imu.

    Raises:
        Unreadable: a field is missing or not finite.
    """
    return ImuReading(
        stamp_s=stamp_of(message),
        yaw_rate_radps=_number(message, "angular_velocity", "z"),
        accel_x_mps2=_number(message, "linear_acceleration", "x"),
        accel_y_mps2=_number(message, "linear_acceleration", "y"),
    )


def read_scan(message: Message, zero: Literal["near", "nothing"] = "near") -> ScanReading:
    """Read sensor_msgs/LaserScan; of more beams than the wire carries, the nearest of each few.

    Raises:
        Unreadable: a field is missing or not finite, or a range is no number.
    """
    step_rad = _number(message, "angle_increment")
    least_m, most_m = _number(message, "range_min"), _number(message, "range_max")
    raw = message.get("ranges")
    if not isinstance(raw, list) or not raw:
        raise Unreadable(f"ranges holds {_show(raw)}, expected a list of numbers")
    if not 0.0 < abs(step_rad) * len(raw) <= 2.0 * pi + 0.2:
        raise Unreadable(
            f"angle_increment {step_rad:.4g} times {len(raw)} beams is no turn or part of one"
        )
    if not 0.0 <= least_m < most_m <= 1000.0:
        raise Unreadable(f"range_min {least_m:g} and range_max {most_m:g} are no lidar's")
    ranges = [_range(one, most_m, zero) for one in raw]
    first_rad = _number(message, "angle_min")
    if step_rad < 0.0:
        first_rad += step_rad * (len(raw) - 1)
        ranges.reverse()
    each = -(-len(ranges) // MAX_BEAMS)
    return ScanReading(
        stamp_s=stamp_of(message),
        angle_min_rad=remainder(first_rad + abs(step_rad) * (each - 1) / 2.0, 2.0 * pi),
        angle_increment_rad=abs(step_rad) * each,
        time_increment_s=min(max(_number(message, "time_increment") * each, 0.0), SLOWEST_BEAM_S),
        range_min_m=least_m,
        range_max_m=most_m,
        ranges_m=tuple(ranges) if each == 1 else _nearest_of_each(ranges, each),
        clockwise=step_rad < 0.0,
    )


def _nearest_of_each(ranges: list[float | None], each: int) -> tuple[float | None, ...]:
    return tuple(
        min((one for one in ranges[at : at + each] if one is not None), default=None)
        for at in range(0, len(ranges), each)
    )


def _range(value: object, most_m: float, zero: str) -> float | None:
    """Return a range [m]. Minus infinity is too near to measure (REP-117)."""
    if value is None:
        return None
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise Unreadable(f"ranges holds {_show(value)}, expected numbers")
    if value == 0.0 and zero == "nothing":
        return None
    if value <= 0.0:
        return 0.0
    return round(value, 4) if value <= most_m else None  # and not-a-number is no return


def stamp_of(message: Message) -> float:
    """Return a message's stamp [s] on the robot's ROS clock.

    Raises:
        Unreadable: it has none.
    """
    header = message.get("header")
    stamp = header.get("stamp") if isinstance(header, dict) else None
    if not isinstance(stamp, dict):
        raise Unreadable("header.stamp is missing")
    return _number(stamp, "sec") + _number(stamp, "nanosec") * 1e-9


def _number(message: Message, *path: str) -> float:
    value: object = message
    for part in path:
        value = value.get(part) if isinstance(value, dict) else None
    number = isinstance(value, int | float) and not isinstance(value, bool)
    if not number or not -MOST <= value <= MOST:  # type: ignore[operator]  # a number it is
        raise Unreadable(f"{'.'.join(path)} holds {_show(value)}, expected a finite number")
    return float(value)  # type: ignore[arg-type]  # a number it is


def _show(value: object) -> str:
    return repr(value)[:40]
