"""Turn recorded speech into text: check the recording, then hear it in another process.

What is heard is only text. It becomes a goal on the same way as typed text, stop lane first.
"""

from planner.voice.process_client import VoiceWorker
from planner.voice.recogniser import Recogniser, Recognition, VoiceFailure
from planner.voice.wav import MAX_BYTES, MAX_SECONDS, BadSound, Sound, read_wav

__all__ = [
    "MAX_BYTES",
    "MAX_SECONDS",
    "BadSound",
    "Recogniser",
    "Recognition",
    "Sound",
    "VoiceFailure",
    "VoiceWorker",
    "read_wav",
]
