"""Describe how a ROS 2 base is reached: where its node listens (docs/ros2.md)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Final

from pydantic import Field

from wire.base import Record

if TYPE_CHECKING:
    from collections.abc import Iterator

ROS2 = "ros2"
FORMER_CODE: Final = "ros2_former_keys"
_FORMER_WAYS: Final = ("transport", "url", "router", "domain", "interface", "relay")
"""Keys of [ros2] that said how rosbridge, DDS or zenoh's keys were reached, and the relay."""
_FORMER_TOPICS: Final = {
    ("ros2", "cmd_vel"): "cmd_vel", ("ros2", "odom"): "odom", ("ros2", "scan"): "scan",
    ("ros2", "scan_zero"): "scan_zero", ("ros2", "imu"): "imu",
    ("ros2", "nav2", "goal_pose"): "goal_pose", ("ros2", "nav2", "status"): "nav2_status",
    ("ros2", "nav2", "cmd_vel"): "nav2_cmd_vel", ("ros2", "nav2", "frame"): "map_frame",
    ("camera", "topic"): "picture",
}  # fmt: skip
"""Keys that named a topic here, and the node's parameter that names it on the robot."""
_INSTALL: Final = (
    "Pons speaks to a robot of ROS 2 by the package pons_ros2 alone, which stands in for the relay "
    "and rosbridge. On the robot: `pons robot node ~/ros2_ws/src/pons_ros2` writes it, `colcon "
    "build`, `pip install 'eclipse-zenoh>=1.10,<1.11'`, `ros2 launch pons_ros2 pons.launch.py` "
    "(docs/ros2.md)"
)


class Nav2Config(Record):
    """Have Nav2 drive to the planner's goals; the part is there or it is not."""

    within_m: Annotated[float, Field(ge=0.05, le=1.0)] = 0.35
    """So near the goal "arrived" is said, and nowhere else; Nav2's own tolerance is 0.25 m."""
    within_rad: Annotated[float, Field(ge=0.05, le=3.15)] = 0.35
    """Of its heading, where that matters."""


class Ros2Config(Record):
    """Name the way to a base that ROS 2 drives."""

    node: Annotated[str, Field(pattern=r"^(tcp|tls)/[A-Za-z0-9_.:\[\]-]+$", max_length=204)]
    """Where the package pons_ros2 listens on the robot; it names the topics."""
    nav2: Nav2Config | None = None
    """Where it is there, Nav2 drives to goals, and Pons' own route is left out."""


def wrong_ros2(ros2: Ros2Config | None, drive: str, lidar: str, camera: str) -> Iterator[str]:
    """Yield what a base of ROS 2 lacks, and what names ROS 2 though the base is another's.

    Args:
        ros2: the part of robot.toml, if there is one.
        drive: ``drive.kind``.
        lidar: ``lidar.kind``.
        camera: ``camera.kind``.
    """
    if ros2 is not None:
        if drive != ROS2:
            yield f"the part ros2 is for drive.kind 'ros2', not for kind {drive!r}"
        return
    for part, kind in (("drive", drive), ("lidar", lidar), ("camera", camera)):
        if kind == ROS2:
            yield f"ros2.node is missing: {part}.kind 'ros2' is a robot's of ROS 2 (docs/ros2.md)"


def explain_former_keys(raw: dict[str, Any]) -> str | None:
    """Return what replaces the keys of the former transports; None where a robot.toml has none."""
    ways = [f"ros2.{key}" for key in _FORMER_WAYS if _find(raw, ("ros2", key)) is not None]
    topics = {path: one for path in _FORMER_TOPICS if (one := _find(raw, path)) is not None}
    if not ways and not topics:
        return None
    named = ", ".join([*ways, *(".".join(path) for path in topics)])
    lines = [f'{_FORMER_TOPICS[path]}: "{str(one)[:128]}"' for path, one in topics.items()]
    if _find(raw, ("ros2", "nav2")) is not None:
        lines.append("nav2: true")
    there = f"; in pons.yaml on the robot: {', '.join(lines)}" if lines else ""
    return f'{_INSTALL}. In place of {named} here: node = "tcp/127.0.0.1:7448"{there}'


def _find(raw: Any, path: tuple[str, ...]) -> Any:
    for name in path:
        raw = raw.get(name) if isinstance(raw, dict) else None
    return raw
