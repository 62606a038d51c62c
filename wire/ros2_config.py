"""Describe how a ROS 2 base is reached: by which transport, and its topics (docs/ros2.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from wire.base import Record

if TYPE_CHECKING:
    from collections.abc import Iterator

ROS2 = "ros2"
Topic = Annotated[str, Field(pattern=r"^/[A-Za-z][A-Za-z0-9_/]{0,126}$")]


class Nav2Config(Record):
    """Have Nav2 drive to the planner's goals; the part is there or it is not."""

    goal_pose: Topic = "/goal_pose"
    """geometry_msgs/PoseStamped, as Nav2's bt_navigator hears it."""
    status: Topic = "/navigate_to_pose/_action/status"
    """action_msgs/GoalStatusArray of the action that Nav2 makes of it."""
    cmd_vel: Topic = "/cmd_vel_nav"
    """What Nav2's last node says: Twist or TwistStamped. Never what the relay drives by."""
    frame: Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_/]{0,63}$")] = "map"
    """Nav2's name of the frame that the site's map is in."""
    within_m: Annotated[float, Field(ge=0.05, le=1.0)] = 0.35
    """So near the goal "arrived" is said, and nowhere else; Nav2's own tolerance is 0.25 m."""
    within_rad: Annotated[float, Field(ge=0.05, le=3.15)] = 0.35
    """Of its heading, where that matters."""


class Ros2Config(Record):
    """Name the way to a base that ROS 2 drives, and its topics."""

    node: Annotated[str, Field(pattern=r"^(tcp|tls)/[A-Za-z0-9_.:\[\]-]{1,200}$")] | None = None
    """Where the package pons_ros2 listens on the robot; it names the topics (docs/ros2.md)."""
    transport: Literal["rosbridge", "dds", "zenoh"] = "rosbridge"
    """A websocket to rosbridge_server; DDS itself, by Cyclone DDS; or rmw_zenoh's own keys."""
    url: Annotated[str, Field(pattern=r"^wss?://[A-Za-z0-9_.:\[\]/-]{1,200}$")] | None = None
    """Of rosbridge_websocket, port 9090 as it comes; for that transport alone."""
    router: Annotated[str, Field(pattern=r"^(tcp|tls)/[A-Za-z0-9_.:\[\]-]{1,200}$")] = (
        "tcp/127.0.0.1:7447"
    )
    """Of rmw_zenohd, for transport "zenoh"."""
    domain: Annotated[int, Field(ge=0, le=232)] = 0
    """The robot's ROS_DOMAIN_ID, for transports "dds" and "zenoh"."""
    interface: Annotated[str, Field(pattern=r"^[A-Za-z0-9_.:-]{1,15}$")] | None = None
    """The network interface that DDS speaks on; None: whichever Cyclone DDS takes."""
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
    nav2: Nav2Config | None = None
    """Where it is there, Nav2 drives to goals, and Pons' own route is left out (docs/ros2.md)."""

    @property
    def peer(self) -> str:
        """Return how people are told whom this dials."""
        if self.node is not None:
            return self.node
        if self.transport == "rosbridge":
            return self.url or "ros2.url"
        if self.transport == "zenoh":
            return f"{self.router}, domain {self.domain}"
        return f"DDS domain {self.domain}" + (f" on {self.interface}" if self.interface else "")

    @property
    def command(self) -> str:
        """Return the topic on which the relay hears commands."""
        return f"{self.relay}/command"

    @property
    def state(self) -> str:
        """Return the topic on which the relay says what it does."""
        return f"{self.relay}/state"


def wrong_ros2(
    ros2: Ros2Config | None, drive: str, lidar: str, camera: str, *, has_imu: bool
) -> Iterator[str]:
    """Yield what a base of ROS 2 lacks, and what names ROS 2 though the base is another's.

    Args:
        ros2: the part of robot.toml, if there is one.
        drive: ``drive.kind``.
        lidar: ``lidar.kind``.
        camera: ``camera.kind``.
        has_imu: ``inputs.imu``.
    """
    if ros2 is None:
        if drive == ROS2:
            yield "ros2.url is missing: drive.kind 'ros2' needs the part ros2 (docs/ros2.md)"
        if lidar == ROS2:
            yield "ros2.scan is missing: lidar.kind 'ros2' is read from that topic"
        if camera == ROS2:
            yield "ros2.url is missing: camera.kind 'ros2' is read from the graph of a ros2 base"
        return
    if drive != ROS2:
        yield f"the part ros2 is for drive.kind 'ros2', not for kind {drive!r}"
    if ros2.node is not None:
        yield from _wrong_node(ros2)
        return
    yield from _wrong_way(ros2)
    if ros2.nav2 is not None and ros2.nav2.cmd_vel in (ros2.cmd_vel, ros2.command):
        yield (
            f"ros2.nav2.cmd_vel {ros2.nav2.cmd_vel} is what the relay drives by: have Nav2 say "
            "another topic (/cmd_vel_nav), which reaches the wheels through the bridge"
        )
    if (lidar == ROS2) != (ros2.scan is not None):
        yield f"ros2.scan {ros2.scan!r} and lidar.kind {lidar!r} do not fit: it is for kind 'ros2'"
    if has_imu != (ros2.imu is not None):
        yield (
            f"ros2.imu {ros2.imu!r} and inputs.imu {str(has_imu).lower()} do not fit: name the "
            "topic, or say inputs.imu = false (at most 0.3 m/s then)"
        )


def wrong_camera_topic(ros2: Ros2Config | None, kind: str, topic: str | None) -> Iterator[str]:
    """Yield why a camera of kind "ros2" can't be read: its topic is said here or on the robot."""
    by_node = ros2 is not None and ros2.node is not None
    if kind == ROS2 and topic is None and not by_node:
        yield "camera.topic is missing: kind 'ros2' needs it (docs/sensors.md)"
    if kind == ROS2 and topic is not None and by_node:
        yield "camera.topic is the parameter picture of the node on the robot (docs/ros2.md)"


def _wrong_node(ros2: Ros2Config) -> Iterator[str]:
    """Yield what is said on the robot and not here."""
    for key in sorted(ros2.model_fields_set - {"node", "nav2"}):
        yield f"ros2.{key} is for ros2.transport; the node names its topics on the robot"
    given = set() if ros2.nav2 is None else ros2.nav2.model_fields_set
    for key in sorted(given & {"goal_pose", "status", "cmd_vel", "frame"}):
        yield f"ros2.nav2.{key} is a parameter of the node on the robot (docs/ros2.md)"


_KEYS_OF = {"url": ("rosbridge",), "router": ("zenoh",), "domain": ("dds", "zenoh"),
            "interface": ("dds",)}  # fmt: skip


def _wrong_way(ros2: Ros2Config) -> Iterator[str]:
    """Yield what a transport lacks, and keys that only another has."""
    if ros2.transport == "rosbridge" and ros2.url is None:
        yield "ros2.url is missing: ros2.transport 'rosbridge' dials ws://HOST:9090"
    for key, transports in _KEYS_OF.items():
        if key in ros2.model_fields_set and ros2.transport not in transports:
            yield f"ros2.{key} is for transport {' and '.join(transports)}, not {ros2.transport!r}"
