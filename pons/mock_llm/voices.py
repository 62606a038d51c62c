"""Play a server that hears and speaks: transcriptions as the switches say, speech as a tone."""

from __future__ import annotations

import io
import math
import struct
import wave
from typing import Any

from pons.mock_llm.fault_switches import Switches

RATE_HZ = 16_000
SECONDS_A_CHARACTER = 0.06
MAX_SECONDS = 30.0


def transcription(switches: Switches, body: bytes) -> dict[str, Any] | None:
    """Return what a request's sound is said to be, or None where no WAV came with it."""
    if b"RIFF" not in body or b"WAVEfmt " not in body:
        return None
    told: dict[str, Any] = {"text": switches.transcript}
    if b"verbose_json" in body and switches.probability is not None:
        silent = 0.95 if not switches.transcript else 0.01
        log = math.log(max(switches.probability, 1e-9))
        told["segments"] = [{"avg_logprob": log, "no_speech_prob": silent}]
    return told


def tone(text: str) -> bytes:
    """Return a WAV that lasts about as long as a text does when it is spoken."""
    count = int(RATE_HZ * min(MAX_SECONDS, SECONDS_A_CHARACTER * max(1, len(text))))
    samples = (int(3000 * math.sin(2 * math.pi * 220 * k / RATE_HZ)) for k in range(count))
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(RATE_HZ)
        file.writeframes(b"".join(struct.pack("<h", each) for each in samples))
    return out.getvalue()
