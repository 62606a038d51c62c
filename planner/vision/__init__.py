"""See: pictures in, things on the map out. Detection runs in a process of its own.

This door stays light: numpy, OpenCV and onnxruntime live in that process alone.
"""

from planner.vision.records import Box, Detection, Look, Sight, Thing

__all__ = ["Box", "Detection", "Look", "Sight", "Thing"]
