"""Read states of earlier recordings as today's core would hold them.

Version 1 kept all points of the newest scan and no ranges beside them; they are made anew from the
scan itself, which was always kept, so that such a recording replays to the last bit.
"""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING

from bridge.core.obstaclegate import sight_m
from bridge.core.scanpicture import ScanPicture
from bridge.recorder.format import FRAMES, StateFrame
from wire import Pose2

if TYPE_CHECKING:
    from bridge.recorder.format import Frame
    from wire import RobotDescription

STATE = b'{"kind":"state"'


def state_of_version_1(line: bytes, robot: RobotDescription) -> Frame:
    """Return the state frame of a version 1 segment, its scan's picture made anew.

    Raises:
        KeyError, TypeError, ValueError: the line is no such state (pydantic's errors included).
    """
    data = json.loads(line)
    kept = data["state"]["lidar"]
    picture, kept["picture"] = kept["picture"], None
    frame = FRAMES.validate_json(json.dumps(data))
    if picture is None or not isinstance(frame, StateFrame):
        return frame
    lidar = frame.state.lidar
    if lidar.newest is None:
        raise ValueError("a picture of no scan")
    base_in_odom = Pose2(**picture["base_in_odom"])
    frame.state.lidar = replace(
        lidar,
        picture=ScanPicture.from_scan(lidar.newest, base_in_odom, robot.lidar, sight_m(robot)),
    )
    return frame
