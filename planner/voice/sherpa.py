"""Hear English and Chinese with sherpa-onnx and a streaming model of the owner's, on this machine.

Runs in a process of its own: the library ends its process over some files that are no model.
"""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Mapping
from typing import Any

import sherpa_onnx

from planner.language.folding import has_chinese
from planner.plan import Language
from planner.voice.audio_preprocess import float_samples, raw_samples
from planner.voice.recogniser import Recognition

UNTOLD = 0.5
"""The confidence of a model that tells no probabilities: understood, and never sure."""
UNDERSTOOD = 0.3
MAX_TEXT = 500
"""Characters; as many as a typed order may have."""
PAUSE_S, LONG_PAUSE_S = 0.4, 2.0
"""Of silence after words, and without any, that end a piece of speech: the next is read alone."""
TAIL_S = 0.8
"""Silence behind a recording: a streaming model looks ahead, and its last word comes with it."""


class Sherpa:
    """Decode with one model."""

    def __init__(self, paths: Mapping[str, str], threads: int) -> None:
        """Load the model; a transducer where ``paths`` has a joiner, else a paraformer.

        Raises:
            RuntimeError: a file is no ONNX model. For one that is, but another kind than
                expected, the library ends this process.
        """
        kinds = sherpa_onnx.OnlineRecognizer
        make = kinds.from_transducer if "joiner" in paths else kinds.from_paraformer
        self._recogniser = make(
            **paths,
            num_threads=threads,
            enable_endpoint_detection=True,
            rule1_min_trailing_silence=LONG_PAUSE_S,
            rule2_min_trailing_silence=PAUSE_S,
        )

    def hear(
        self, pcm: bytes, rate_hz: int, channels: int, *, awaits_answer: bool = False
    ) -> Recognition:
        """Return the transcript and its confidence: the mean probability of its tokens.

        Raises:
            IndexError: the model names a token that ``tokens.txt`` lacks.
        """
        del awaits_answer  # a free recogniser hears a yes as any other word
        samples = float_samples(pcm, channels, int(TAIL_S * rate_hz))
        if samples is None:
            return Recognition("", 0.0, understood=False, by="sherpa")
        stream = self._recogniser.create_stream()
        stream.accept_waveform(rate_hz, samples)
        stream.input_finished()
        return decode(self._recogniser, stream)

    def listener(self, rate_hz: int, channels: int) -> SherpaListener:
        """Return what hears a recording while it is being spoken."""
        return SherpaListener(self._recogniser, rate_hz, channels)


class SherpaListener:
    """Decode one recording as it grows, from pause to pause."""

    def __init__(self, recogniser: Any, rate_hz: int, channels: int) -> None:
        self._recogniser, self._stream = recogniser, recogniser.create_stream()
        self._rate_hz, self._channels = rate_hz, channels

    def take(self, pcm: bytes) -> Recognition | None:
        """Add samples; return what was heard since the last pause, None for nothing.

        Raises:
            IndexError: the model names a token that ``tokens.txt`` lacks.
        """
        self._stream.accept_waveform(self._rate_hz, raw_samples(pcm, self._channels))
        heard = decode(self._recogniser, self._stream)
        if self._recogniser.is_endpoint(self._stream):
            self._recogniser.reset(self._stream)
        return heard if heard.transcript else None


def decode(recogniser: Any, stream: Any) -> Recognition:
    """Return what a stream says by now.

    Raises:
        IndexError: the model names a token that ``tokens.txt`` lacks.
    """
    while recogniser.is_ready(stream):
        recogniser.decode_stream(stream)
    told = recogniser.get_result_all(stream)
    return read_result(told.text, told.ys_probs)


def read_result(text: str, token_logs: list[float]) -> Recognition:
    """Return the recognition of a decoded text and the natural logarithms of its tokens' chances.

    The library flattens them by a temperature of 2, which asks for a yes rather too often.
    """
    transcript = _clean(text)
    confidence = _confidence(token_logs) if transcript else 0.0
    return Recognition(
        transcript,
        round(confidence, 3),
        understood=bool(transcript) and confidence >= UNDERSTOOD,
        language=Language.ZH if has_chinese(transcript) else Language.EN,
        by="sherpa",
    )


def _confidence(token_logs: list[float]) -> float:
    if not token_logs:
        return UNTOLD
    mean = sum(token_logs) / len(token_logs)
    return math.exp(mean) if mean <= 0.0 else 0.0  # NaN, too, is no chance at all


def _clean(text: str) -> str:
    """Return one line in small letters: such models write English in capitals."""
    seen = "".join(" " if unicodedata.category(each)[0] in "CZ" else each for each in text)
    return " ".join(seen.split())[:MAX_TEXT].lower()
