"""Bring what a ROS 2 robot says into Pons: its map as a site's, its lidar's place as robot.toml's.

``pons site import ros2:/map NAME`` and ``pons robot mount``, by the node on the robot.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from maps import load_map
from pons.terminal import refusal
from ros2.mounting import NoMounting, find_mounting
from ros2.occupancy import map_files
from ros2.robot_link import fetch
from ros2.robot_words import MapHead, ScanWords, Unreadable, read_frames, read_words
from ros2.trouble import CODES, Ros2Trouble, TopicFailure
from wire import ConfigError

if TYPE_CHECKING:
    from maps import LoadedMap
    from ros2.mounting import SensorMounting
    from ros2.robot_words import FrameWords
    from wire import RobotDescription

MAP_S, FRAMES_S = 20.0, 8.0
EXIT_FOUND, EXIT_REFUSED = 0, 3


class TopicRefusal(ConfigError):
    """Refuse what a ROS 2 robot gave, or did not give; says the cure in both languages."""

    def __init__(self, trouble: Ros2Trouble) -> None:
        super().__init__(trouble.code, trouble.detail)
        self.cure_zh = CODES[trouble.code][1]


def load_topic_map(robot: RobotDescription, topic: str) -> LoadedMap:
    """Return the map that a topic says, read as every map is.

    Raises:
        TopicRefusal: no such map came; with a code of ``ros2.trouble``.
        SiteError: the map is none that Pons drives on.
    """
    try:
        return fetch_map(_locator(robot), topic)
    except TopicFailure as why:
        raise TopicRefusal(why.trouble) from None


def print_mounting(robot: RobotDescription) -> int:
    """Print where the lidar sits, as a part of robot.toml; 0 found, 3 refused."""
    try:
        found, frame = fetch_mounting(_locator(robot))
    except TopicFailure as why:
        refused = TopicRefusal(why.trouble)
        told = {"en": CODES[refused.code][0], "zh": refused.cure_zh}
        print(f"refused: {refusal(refused, told)}", file=sys.stderr)
        return EXIT_REFUSED
    print(f"# {frame} in {found.base}, {found.z_m:.2f} m above it")
    print('[lidar]\nkind = "ros2"')
    print(f"x_m = {found.x_m:.3f}\ny_m = {found.y_m:.3f}\nyaw_rad = {found.yaw_rad:.4f}")
    given = robot.lidar
    off_m = max(abs(given.x_m - found.x_m), abs(given.y_m - found.y_m))
    print(f"# robot.toml has ({given.x_m:g}, {given.y_m:g}, {given.yaw_rad:g}): {off_m:.3f} m off")
    return EXIT_FOUND


def _locator(robot: RobotDescription) -> str:
    if robot.ros2 is None:
        raise TopicFailure(Ros2Trouble("ros2_not_configured", "robot.toml has no part ros2"))
    return robot.ros2.node


def fetch_map(locator: str, topic: str) -> LoadedMap:
    """Return the map that the robot says on a topic.

    Raises:
        TopicFailure: no such map came.
        SiteError: the map is none that Pons drives on.
    """
    told, cells = fetch(locator, "map", MAP_S, lambda head, _: bool(head))
    try:
        head = read_words(MapHead, told)
        if head.topic != topic:
            found = f"the node's parameter map names {head.topic}, not {topic}"
            raise TopicFailure(Ros2Trouble("ros2_topic_missing", found))
        if head.code is not None:
            raise Unreadable(head.found)
        text, picture = map_files(head, cells)
    except Unreadable as why:
        raise TopicFailure(Ros2Trouble("ros2_unreadable", f"{topic}: {why}")) from None
    with tempfile.TemporaryDirectory(prefix="pons-map-") as folder:
        path = Path(folder) / "map.yaml"
        path.write_text(text, "utf-8")
        (path.parent / "map.pgm").write_bytes(picture)
        return load_map(path)


def fetch_mounting(locator: str) -> tuple[SensorMounting, str]:
    """Return where the lidar sits on the robot, and the name of its frame.

    Raises:
        TopicFailure: nothing says so.
    """
    _, payload = fetch(locator, "scan", FRAMES_S, lambda _, payload: bool(payload))
    try:
        frame = read_words(ScanWords, payload).frame
    except Unreadable as why:
        raise TopicFailure(Ros2Trouble("ros2_unreadable", f"scan: {why}")) from None
    heard: list[tuple[FrameWords, ...]] = []

    def leads_home(_head: bytes, payload: bytes) -> bool:
        try:
            heard[:] = [read_frames(payload)]
            find_mounting(heard[0], frame)
        except (NoMounting, Unreadable):
            return False
        return True

    try:
        fetch(locator, "frames", FRAMES_S, leads_home)
    except TopicFailure:
        if not heard:
            raise
    try:
        return find_mounting(heard[0], frame), frame
    except NoMounting as why:
        found = f"/tf_static, {frame!r}: {why}"
        raise TopicFailure(Ros2Trouble("ros2_no_mounting", found)) from None
