"""Prepare samples for the decoders: one channel, 16 kHz, one loudness, a little noise. numpy only.

Runs in the voice process and nowhere else.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

RATE_HZ = 16_000
SILENT_PEAK = 200.0
"""Of 32767: below it there is nothing to hear."""
LOUD_PEAK = 20_000.0
DITHER = 60.0
"""Exact zeros have no logarithm: with it, synthetic orders heard right rose from 32 to 58 of 80."""
MARGIN_S = 0.1
FRAME = 160
"""Samples of one of the decoder's frames."""
EDGE_FRAMES = 3
QUIET = 2.0 * DITHER
TAIL_S = 0.2
"""Silence at the end, in which a sentence can end."""


def prepare(pcm: bytes, rate_hz: int, channels: int) -> bytes | None:
    """Return 16-bit samples at 16 kHz, or None for silence. Same bytes, same samples."""
    samples = np.frombuffer(pcm, "<i2").astype(np.float64)
    mono = samples.reshape(-1, channels).mean(axis=1)
    mono -= mono.mean()
    peak = float(np.abs(mono).max(initial=0.0))
    if not peak >= SILENT_PEAK:
        return None
    heard = _without_ends(resample(mono * (LOUD_PEAK / peak), rate_hz))
    whole = np.concatenate([heard, np.zeros(int(TAIL_S * RATE_HZ))])
    whole += np.random.default_rng(0).normal(0.0, DITHER, len(whole))
    return bytes(np.clip(whole, -32_768, 32_767).astype("<i2").tobytes())


def float_samples(pcm: bytes, channels: int, tail: int) -> NDArray[np.float32] | None:
    """Return one channel from -1 to 1 and ``tail`` zeros behind it, or None for silence."""
    mono = raw_samples(pcm, channels)
    mono -= mono.mean()  # a sound card's offset is no sound
    if not float(np.abs(mono).max(initial=0.0)) * 32_768.0 >= SILENT_PEAK:
        return None
    return np.pad(mono, (0, tail))


def raw_samples(pcm: bytes, channels: int) -> NDArray[np.float32]:
    """Return one channel from -1 to 1, as it is: a piece of a recording has no mean of its own."""
    mono = np.frombuffer(pcm, "<i2").astype(np.float32).reshape(-1, channels).mean(axis=1)
    return np.asarray(mono / 32_768.0, np.float32)


def quiet(samples: bytes, first_frame: int, frames: int) -> bool:
    """Tell whether a stretch of prepared samples holds nothing but the noise that was added."""
    edge = min(EDGE_FRAMES, frames // 4)  # a decoder's pauses begin and end a little in the words
    start, end = first_frame + edge, first_frame + frames - edge
    heard = np.frombuffer(samples, "<i2")[start * FRAME : end * FRAME].astype(np.float64)
    return bool(np.sqrt(np.square(heard).mean()) < QUIET) if len(heard) else True


def _without_ends(samples: NDArray[np.float64]) -> NDArray[np.float64]:
    """Cut off what lies below the noise that is added anyway, before the first sound and behind the
    last: nobody can hear it, and it costs as much to decode as speech.
    """
    loud = np.flatnonzero(np.abs(samples) > DITHER)
    first, last = int(loud[0]), int(loud[-1])
    kept = int(MARGIN_S * RATE_HZ)
    return samples[max(0, first - kept) : last + kept + 1]


def resample(samples: NDArray[np.float64], rate_hz: int) -> NDArray[np.float64]:
    """Return the samples at 16 kHz, by cutting or padding their spectrum."""
    if rate_hz == RATE_HZ:
        return samples
    count = max(2, round(len(samples) * RATE_HZ / rate_hz))
    spectrum = np.fft.rfft(samples)
    kept = spectrum[: count // 2 + 1]
    padded = np.pad(kept, (0, count // 2 + 1 - len(kept)))
    return np.fft.irfft(padded, count) * (count / len(samples))
