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
from planner.voice.audio_preprocess import float_samples
from planner.voice.recogniser import Recognition

UNTOLD = 0.5
"""The confidence of a model that tells no probabilities: understood, and never sure."""
UNDERSTOOD = 0.3
MAX_TEXT = 500
"""Characters; as many as a typed order may have."""
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
        self._recogniser = make(**paths, num_threads=threads)

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
        return self._decode(stream)

    def _decode(self, stream: Any) -> Recognition:
        while self._recogniser.is_ready(stream):
            self._recogniser.decode_stream(stream)
        told = self._recogniser.get_result_all(stream)
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
