"""See: pictures in, things on the map out. Detection runs in a process of its own.

This door stays light: numpy, OpenCV and onnxruntime live in that process alone.
"""

from planner.vision.failure import VisionFailure
from planner.vision.ports import Eyes, Picture, PointRefused, Spot
from planner.vision.records import Box, Detection, Look, Sight, Thing
from planner.vision.result import About, LookResult
from planner.vision.worker import VisionWorker

__all__ = [
    "About",
    "Box",
    "Detection",
    "Eyes",
    "Look",
    "LookResult",
    "Picture",
    "PointRefused",
    "Sight",
    "Spot",
    "Thing",
    "VisionFailure",
    "VisionWorker",
]
