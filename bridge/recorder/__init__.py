"""Record every tick so that it can be run again, and read recordings. Never waits for a disk."""

from bridge.recorder.format import Frame, Gap, Header, StateFrame, TickFrame
from bridge.recorder.reader import BadRecording, read_recording
from bridge.recorder.recorder import Recorder

__all__ = [
    "BadRecording",
    "Frame",
    "Gap",
    "Header",
    "Recorder",
    "StateFrame",
    "TickFrame",
    "read_recording",
]
