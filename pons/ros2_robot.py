"""Bring what a ROS 2 robot says into Pons: its map as a site's, its lidar's place as robot.toml's.

``pons site import ros2:/map NAME`` and ``pons robot mount``, by the node on the robot.
"""

from __future__ import annotations

import tempfile
from array import array
from pathlib import Path
from typing import TYPE_CHECKING, Any

from maps import load_map
from ros2.mounting import NoMounting, find_mounting
from ros2.occupancy import map_files
from ros2.robot_request import fetch, read_json
from ros2.robot_words import ScanWords, Unreadable, read_words
from ros2.trouble import Ros2Trouble, TopicFailure

if TYPE_CHECKING:
    from maps import LoadedMap
    from ros2.mounting import SensorMounting

MAP_S, FRAMES_S = 20.0, 8.0


def fetch_map(locator: str, topic: str) -> LoadedMap:
    """Return the map that the robot says on a topic, read as every map is.

    Raises:
        TopicFailure: no such map came.
        SiteError: the map is none that Pons drives on.
    """
    head, cells = fetch(locator, "map", MAP_S, lambda _, payload: bool(payload))
    message = read_json(head)
    if not isinstance(message, dict):
        raise TopicFailure(Ros2Trouble("ros2_unreadable", f"{topic}: its head is none"))
    if message.get("topic") != topic:
        found = f"the node's parameter map names {message.get('topic')}, not {topic}"
        raise TopicFailure(Ros2Trouble("ros2_topic_missing", found))
    try:
        files = map_files(message | {"data": array("b", cells)})
    except Unreadable as why:
        raise TopicFailure(Ros2Trouble("ros2_unreadable", f"{topic}: {why}")) from None
    with tempfile.TemporaryDirectory(prefix="pons-map-") as folder:
        path = Path(folder) / "map.yaml"
        path.write_text(files.yaml, "utf-8")
        (path.parent / "map.pgm").write_bytes(files.pgm)
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
    heard: list[dict[str, Any]] = []

    def leads_home(_head: bytes, frames: bytes) -> bool:
        heard[:] = [{"transforms": read_json(frames)}]
        try:
            find_mounting(heard, frame)
        except (NoMounting, Unreadable):
            return False
        return True

    try:
        fetch(locator, "frames", FRAMES_S, leads_home)
        return find_mounting(heard, frame), frame
    except (TopicFailure, NoMounting, Unreadable):
        return _explain(heard, frame)


def _explain(heard: list[dict[str, Any]], frame: str) -> tuple[SensorMounting, str]:
    """Find it once more, for the words that say why it can't be."""
    try:
        return find_mounting(heard, frame), frame
    except (NoMounting, Unreadable) as why:
        code = "ros2_unreadable" if isinstance(why, Unreadable) else "ros2_no_mounting"
        raise TopicFailure(Ros2Trouble(code, f"/tf_static, {frame!r}: {why}")) from None
