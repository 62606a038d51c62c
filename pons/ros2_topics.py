"""Bring what a ROS 2 robot says into Pons: its map as a site's, its lidar's place as robot.toml's.

``pons site import ros2:/map NAME`` and ``pons robot mount``. Hears, and publishes nothing.
"""

from __future__ import annotations

import asyncio
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from maps import load_map
from pons.ros2_robot import fetch_map, fetch_mounting
from ros2.graph import LASER_SCAN
from ros2.mounting import NoMounting, find_mounting
from ros2.occupancy import map_files
from ros2.robot_words import Unreadable
from ros2.topic_request import WantedTopic, collect
from ros2.trouble import CODES, Ros2Trouble, TopicFailure
from wire import ConfigError

if TYPE_CHECKING:
    from maps import LoadedMap
    from ros2.mounting import SensorMounting
    from ros2.operations import Message
    from wire import RobotDescription
    from wire.ros2_config import Ros2Config

OCCUPANCY_GRID = "nav_msgs/msg/OccupancyGrid"
TF_STATIC, TF_MESSAGE = "/tf_static", "tf2_msgs/msg/TFMessage"
MAP_S = 20.0
FRAMES_S = 8.0
EXIT_FOUND, EXIT_REFUSED = 0, 3


class TopicRefusal(ConfigError):
    """Refuse what a ROS 2 graph gave, or did not give; says the cure in both languages."""

    def __init__(self, trouble: Ros2Trouble) -> None:
        super().__init__(trouble.code, trouble.detail)
        self.cure_zh = CODES[trouble.code][1]


def load_topic_map(robot: RobotDescription, topic: str) -> LoadedMap:
    """Return the map that a topic says, read as every map is.

    Raises:
        TopicRefusal: no such map came; with a code of ``ros2.trouble``.
        SiteError: the map is none that Pons drives on.
    """
    locator = _ros2_of(robot).node
    if locator is not None:
        try:
            return fetch_map(locator, topic)
        except TopicFailure as why:
            raise TopicRefusal(why.trouble) from None
    wanted = WantedTopic(topic, OCCUPANCY_GRID, keeps=True)
    (message,) = _collect(_ros2_of(robot), [wanted], MAP_S)[topic][-1:]
    try:
        files = map_files(message)
    except Unreadable as why:
        raise TopicRefusal(Ros2Trouble("ros2_unreadable", f"{topic}: {why}")) from None
    with tempfile.TemporaryDirectory(prefix="pons-map-") as folder:
        path = Path(folder) / "map.yaml"
        path.write_text(files.yaml, "utf-8")
        (path.parent / "map.pgm").write_bytes(files.pgm)
        return load_map(path)


def print_mounting(robot: RobotDescription) -> int:
    """Print where the lidar sits, as a part of robot.toml; 0 found, 3 refused."""
    try:
        found, frame = _find_lidar(robot)
    except TopicRefusal as refused:
        print(f"refused: {refused}\n{refused.cure_zh}", file=sys.stderr)
        return EXIT_REFUSED
    print(f"# {frame} in {found.base}, {found.z_m:.2f} m above it")
    print('[lidar]\nkind = "ros2"')
    print(f"x_m = {found.x_m:.3f}\ny_m = {found.y_m:.3f}\nyaw_rad = {found.yaw_rad:.4f}")
    given = robot.lidar
    off_m = max(abs(given.x_m - found.x_m), abs(given.y_m - found.y_m))
    print(f"# robot.toml has ({given.x_m:g}, {given.y_m:g}, {given.yaw_rad:g}): {off_m:.3f} m off")
    return EXIT_FOUND


def _find_lidar(robot: RobotDescription) -> tuple[SensorMounting, str]:
    ros2 = _ros2_of(robot)
    if ros2.node is not None:
        try:
            return fetch_mounting(ros2.node)
        except TopicFailure as why:
            raise TopicRefusal(why.trouble) from None
    if ros2.scan is None:
        found = "robot.toml names no ros2.scan, whose frame is asked for"
        raise TopicRefusal(Ros2Trouble("ros2_topic_missing", found))
    (scan,) = _collect(ros2, [WantedTopic(ros2.scan, LASER_SCAN)], FRAMES_S)[ros2.scan][-1:]
    header = scan.get("header")
    frame = str(header.get("frame_id", "")) if isinstance(header, dict) else ""
    heard: list[Message] = []

    def leads_home(messages: dict[str, list[Message]]) -> bool:
        heard[:] = messages[TF_STATIC]
        try:
            find_mounting(heard, frame)
        except (NoMounting, Unreadable):
            return False
        return True

    wanted = WantedTopic(TF_STATIC, TF_MESSAGE, keeps=True)
    try:
        asyncio.run(collect(ros2, [wanted], leads_home, FRAMES_S))
        return find_mounting(heard, frame), frame
    except TopicFailure as why:
        if heard:
            return _explain(heard, frame)
        raise TopicRefusal(why.trouble) from None


def _explain(heard: list[Message], frame: str) -> tuple[SensorMounting, str]:
    """Find it once more, for the words that say why it can't be."""
    try:
        return find_mounting(heard, frame), frame
    except (NoMounting, Unreadable) as why:
        code = "ros2_unreadable" if isinstance(why, Unreadable) else "ros2_no_mounting"
        raise TopicRefusal(Ros2Trouble(code, f"{TF_STATIC}, {frame!r}: {why}")) from None


def _ros2_of(robot: RobotDescription) -> Ros2Config:
    if robot.ros2 is None:
        found = "robot.toml has no part ros2, which says how the robot is reached"
        raise TopicRefusal(Ros2Trouble("ros2_not_configured", found))
    return robot.ros2


def _collect(
    ros2: Ros2Config, wanted: list[WantedTopic], limit_s: float
) -> dict[str, list[Message]]:
    """Return at least one message of each topic."""
    try:
        return asyncio.run(collect(ros2, wanted, lambda heard: all(heard.values()), limit_s))
    except TopicFailure as why:
        raise TopicRefusal(why.trouble) from None
