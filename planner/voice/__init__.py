"""Turn recorded speech into text: check the recording, then hear it in another process, and by a
server or a model folder where the owner names one.

What is heard is only text. It becomes a goal on the same way as typed text, stop lane first.
"""

from planner.voice.abilities import VoiceAbilities
from planner.voice.ears import STOP_DOUBT, Ears, is_spoken_stop
from planner.voice.process_client import VoiceWorker
from planner.voice.recogniser import Recogniser, Recognition, StopListener, VoiceFailure
from planner.voice.speech_output import SpeechFailure, SpeechOutput, SpeechSink
from planner.voice.wav import MAX_BYTES, MAX_SECONDS, BadSound, Sound, read_wav

__all__ = [
    "MAX_BYTES",
    "MAX_SECONDS",
    "STOP_DOUBT",
    "BadSound",
    "Ears",
    "Recogniser",
    "Recognition",
    "Sound",
    "SpeechFailure",
    "SpeechOutput",
    "SpeechSink",
    "StopListener",
    "VoiceAbilities",
    "VoiceFailure",
    "VoiceWorker",
    "is_spoken_stop",
    "read_wav",
]
