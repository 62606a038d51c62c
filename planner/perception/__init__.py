"""See: pictures in, things on the map out. Detection runs in a process of its own.

This door stays light: numpy, OpenCV and onnxruntime live in that process alone.
"""

from planner.perception.failure import VisionFailure
from planner.perception.interfaces import Eyes, MapPoint, Picture, PointRefusal
from planner.perception.process_client import VisionWorker
from planner.perception.snapshot import (
    Box,
    Detection,
    DetectorInfo,
    LookResult,
    LookSnapshot,
    Sight,
    Thing,
)

__all__ = [
    "Box",
    "Detection",
    "DetectorInfo",
    "Eyes",
    "LookResult",
    "LookSnapshot",
    "MapPoint",
    "Picture",
    "PointRefusal",
    "Sight",
    "Thing",
    "VisionFailure",
    "VisionWorker",
]
