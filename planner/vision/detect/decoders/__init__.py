"""Read what detectors of several families put out. One layout a file; :func:`choose` takes one."""

from planner.vision.detect.decoders.base import Decoder
from planner.vision.detect.decoders.choose import ALL, Choice, choose

__all__ = ["ALL", "Choice", "Decoder", "choose"]
