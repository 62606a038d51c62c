"""See: pictures in, things on the map out. Detection runs in a process of its own.

This door stays light: numpy, OpenCV and onnxruntime live in that process alone.
"""

from planner.perception.failure import VisionFailure
from planner.perception.interfaces import Eyes, Picture, PointRefused, Spot
from planner.perception.process_client import VisionWorker
from planner.perception.result import About, LookResult
from planner.perception.snapshot import Box, Detection, Look, Sight, Thing

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
