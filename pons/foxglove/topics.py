"""Name the topics that Foxglove is shown."""

from __future__ import annotations

from enum import StrEnum


class LiveTopic(StrEnum):
    """Name one topic."""

    SCAN = "/scan"
    TRANSFORMS = "/tf"
    POSE = "/pose"
    ROUTE = "/route"
    MAP = "/map"
    PLACES = "/places"
    FENCE = "/fence"
    OBJECTS = "/objects"
    CAMERA = "/camera"
    BOXES = "/camera/boxes"
    ROWS = "/rows"
    SPEEDS = "/speeds"
    TICKS = "/ticks"
    LOG = "/log"
