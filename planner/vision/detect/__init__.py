"""Detect things in pictures with a model file. Heavy: numpy, OpenCV and onnxruntime load here.

The planner's own process never imports this; its door is :class:`planner.vision.VisionWorker`.
"""

from planner.vision.detect.detector import Detector
from planner.vision.detect.draw import drawn, save
from planner.vision.detect.inner import depth_at
from planner.vision.detect.model_file import Wanted
from planner.vision.detect.pictures import scaled, shrink, unpack_color, unpack_depth
from planner.vision.detect.session import bound_memory
from planner.vision.detect.sheet import lay_out

__all__ = [
    "Detector", "Wanted", "bound_memory", "depth_at", "drawn", "lay_out", "save", "scaled",
    "shrink", "unpack_color", "unpack_depth",
]  # fmt: skip
