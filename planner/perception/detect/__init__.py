"""Detect things in pictures with a model file. Heavy: numpy, OpenCV and onnxruntime load here.

The planner's own process never imports this; its door is :class:`planner.perception.VisionWorker`.
"""

from planner.perception.detect.depth_sampling import depth_at
from planner.perception.detect.detector import Detector
from planner.perception.detect.draw import drawn, save
from planner.perception.detect.image_decode import scaled, shrink, unpack_color, unpack_depth
from planner.perception.detect.model_file import Wanted
from planner.perception.detect.session import bound_memory
from planner.perception.detect.sheet import lay_out

__all__ = [
    "Detector", "Wanted", "bound_memory", "depth_at", "drawn", "lay_out", "save", "scaled",
    "shrink", "unpack_color", "unpack_depth",
]  # fmt: skip
