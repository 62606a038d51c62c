"""Detect things in pictures with a model file. Heavy: numpy, OpenCV and onnxruntime load here.

The planner's own process never imports this; its door is :class:`planner.perception.VisionWorker`.
"""

from planner.perception.detect.depth_sampling import depth_at
from planner.perception.detect.detector import OnnxDetector
from planner.perception.detect.model_file import ModelOptions
from planner.perception.detect.pictures import (
    draw_detections,
    lay_out,
    save,
    scale_down,
    shrink,
    unpack_color,
    unpack_depth,
)
from planner.perception.detect.session import bound_memory

__all__ = [
    "ModelOptions",
    "OnnxDetector",
    "bound_memory",
    "depth_at",
    "draw_detections",
    "lay_out",
    "save",
    "scale_down",
    "shrink",
    "unpack_color",
    "unpack_depth",
]  # fmt: skip
