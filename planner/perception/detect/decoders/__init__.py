"""Read what detectors of several families put out. One layout a file; :func:`choose` takes one."""

from planner.perception.detect.decoders.base import Decoder
from planner.perception.detect.decoders.layout_choice import ALL, Choice, choose

__all__ = ["ALL", "Choice", "Decoder", "choose"]
