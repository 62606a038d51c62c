"""Record every tick so that it can be run again, and read recordings. Never waits for a disk."""

from bridge.recorder.format import Frame, Gap, Header, StateFrame, TickFrame, config_of, header_of
from bridge.recorder.reader import BadRecording, parsed, read_recording, read_segments
from bridge.recorder.recorder import Recorder

__all__ = [
    "BadRecording",
    "Frame",
    "Gap",
    "Header",
    "Recorder",
    "StateFrame",
    "TickFrame",
    "config_of",
    "header_of",
    "parsed",
    "read_recording",
    "read_segments",
]
