"""Make recordings: with espeak-ng where it is installed, and by hand."""

from __future__ import annotations

import io
import shutil
import struct
import subprocess
import wave
from pathlib import Path

import pytest

AUDIO = Path(__file__).resolve().parents[4] / "shared" / "data" / "audio"
needs_espeak = pytest.mark.skipif(
    shutil.which("espeak-ng") is None, reason="espeak-ng is not installed (apt: espeak-ng)"
)
needs_clips = pytest.mark.skipif(
    not AUDIO.is_dir(), reason="../shared/data/audio is not beside this checkout"
)


def wav(pcm: bytes, rate_hz: int = 16_000, channels: int = 1, width: int = 2) -> bytes:
    """Return a WAV file of these samples."""
    out = io.BytesIO()
    with wave.open(out, "wb") as file:
        file.setnchannels(channels)
        file.setsampwidth(width)
        file.setframerate(rate_hz)
        file.writeframes(pcm)
    return out.getvalue()


def speak(text: str, voice: str = "en-us+f3", words_per_minute: int = 160) -> bytes:
    """Return a WAV file with a synthetic voice; a text that begins with a dash is no option."""
    command = ["espeak-ng", "-v", voice, "-s", str(words_per_minute), "--stdout", "--", text]
    data = subprocess.run(command, check=True, capture_output=True).stdout
    (rate_hz,) = struct.unpack_from("<I", data, 24)
    return wav(data[44 : len(data) // 2 * 2], rate_hz)  # its header speaks of endless sound
