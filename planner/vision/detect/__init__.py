"""Detect things in pictures with a model file. Heavy: numpy, OpenCV and onnxruntime load here.

The planner's own process never imports this; its door is :class:`planner.vision.VisionWorker`.
"""

from planner.vision.detect.detector import Detector
from planner.vision.detect.draw import drawn, save
from planner.vision.detect.inner import depth_at
from planner.vision.detect.model_file import Wanted
from planner.vision.detect.pictures import shrink, unpack_color, unpack_depth

__all__ = [
    "Detector", "Wanted", "depth_at", "drawn", "save", "shrink", "unpack_color", "unpack_depth"
]  # fmt: skip
