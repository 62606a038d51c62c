"""Record every tick so that it can be run again. Never waits for a disk.

This door is the loop's; whoever reads recordings enters by bridge.recorder.reading.
"""

from bridge.recorder.encode import warm_frames
from bridge.recorder.process import Sizes
from bridge.recorder.recorder import Recorder

__all__ = ["Recorder", "Sizes", "warm_frames"]
