"""Turn recorded speech into text: check the recording, then hear it in another process.

What is heard is only text. It becomes a goal on the same way as typed text, stop lane first.
"""

from planner.voice.protocol import Heard, Recogniser, VoiceFailure
from planner.voice.wav import MAX_BYTES, MAX_SECONDS, BadRecording, Sound, read_wav
from planner.voice.worker import VoiceWorker

__all__ = [
    "MAX_BYTES",
    "MAX_SECONDS",
    "BadRecording",
    "Heard",
    "Recogniser",
    "Sound",
    "VoiceFailure",
    "VoiceWorker",
    "read_wav",
]
