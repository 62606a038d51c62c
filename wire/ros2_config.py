"""Describe how a ROS 2 base is reached: the rosbridge server, and its topics (docs/ros2.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from wire.base import Record

if TYPE_CHECKING:
    from collections.abc import Iterator

ROS2 = "ros2"
Topic = Annotated[str, Field(pattern=r"^/[A-Za-z][A-Za-z0-9_/]{0,126}$")]


class Ros2Config(Record):
    """Name the server and the topics of a base that ROS 2 drives."""

    url: Annotated[str, Field(pattern=r"^wss?://[A-Za-z0-9_.:\[\]/-]{1,200}$")]
    """Of rosbridge_websocket, port 9090 as it comes."""
    relay: Topic = "/pons"
    """Below which our relay node hears ``command`` and says ``state`` (examples/ros2_relay)."""
    cmd_vel: Topic = "/cmd_vel"
    """What the base obeys: Twist or TwistStamped, as the graph says. Only the relay says it."""
    odom: Topic = "/odom"
    """nav_msgs/Odometry, at 25 Hz or more."""
    scan: Topic | None = None
    """sensor_msgs/LaserScan, for ``lidar.kind`` "ros2"."""
    scan_zero: Literal["near", "nothing"] = "near"
    """What a range of 0 means: too near to measure, or, as some drivers have it, no return."""
    imu: Topic | None = None
    """sensor_msgs/Imu, its z axis up."""

    @property
    def command(self) -> str:
        """Return the topic on which the relay hears commands."""
        return f"{self.relay}/command"

    @property
    def state(self) -> str:
        """Return the topic on which the relay says what it does."""
        return f"{self.relay}/state"


def wrong_ros2(ros2: Ros2Config | None, drive: str, lidar: str, *, has_imu: bool) -> Iterator[str]:
    """Yield what a base of ROS 2 lacks, and what names ROS 2 though the base is another's.

    Args:
        ros2: the part of robot.toml, if there is one.
        drive: ``drive.kind``.
        lidar: ``lidar.kind``.
        has_imu: ``inputs.imu``.
    """
    if ros2 is None:
        if drive == ROS2:
            yield "ros2.url is missing: drive.kind 'ros2' is reached through a rosbridge server"
        if lidar == ROS2:
            yield "ros2.scan is missing: lidar.kind 'ros2' is read from that topic"
        return
    if drive != ROS2:
        yield f"the part ros2 is for drive.kind 'ros2', not for kind {drive!r}"
    if (lidar == ROS2) != (ros2.scan is not None):
        yield f"ros2.scan {ros2.scan!r} and lidar.kind {lidar!r} do not fit: it is for kind 'ros2'"
    if has_imu != (ros2.imu is not None):
        yield (
            f"ros2.imu {ros2.imu!r} and inputs.imu {str(has_imu).lower()} do not fit: name the "
            "topic, or say inputs.imu = false (at most 0.3 m/s then)"
        )
