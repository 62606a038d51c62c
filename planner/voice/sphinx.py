"""Hear English orders with pocketsphinx: a grammar search, and a phone loop to doubt it with.

The grammar search always finds the order that fits best, whatever was said. So the same samples are
also decoded as free phones, which fit anything; an order is believed only where it explains the
sound nearly as well, as a whole and in its worst word (docs/adr/0013). Runs in the voice process.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import pocketsphinx

from planner.voice.grammar import Language, language_of
from planner.voice.protocol import Heard
from planner.voice.samples import prepare

FIT_LIMIT = -14.0
"""Per frame, the order's score less the phones', in 1e-4 of natural logarithm as the decoder
scales them; synthetic orders heard right are above it in 19 of 20 cases."""
STOP_FIT_LIMIT = -20.0
"""A stop heard wrongly moves nothing."""
WORD_LIMIT = -7.0
"""The same of the worst word; an order bent from other words breaks here."""
_STEEPNESS = 2.0
_FRAME_SAMPLES = 160
_SHORT_FRAMES = 3
_BREATH_FRAMES = 45
_JOINTS = frozenset({"and", "then", "the"})
_NEVER = -1e9


@dataclass(frozen=True, slots=True)
class _Decoded:
    text: str
    score: float
    """Natural logarithm, as the decoder scales whole sentences."""
    words: tuple[tuple[str, float, int, int], ...]
    """Word, natural logarithm of its acoustic score, first frame, frame after its last."""


class Sphinx:
    """Decode by one site's grammar."""

    def __init__(self, names: Sequence[str]) -> None:
        """Load the model that pocketsphinx brings, about 0.4 s."""
        pocketsphinx.set_loglevel("FATAL")
        self._decoder = pocketsphinx.Decoder(
            samprate=16_000,
            lm=None,
            cmn="batch",
            silprob=0.1,
            fillprob=1e-20,
            lw=3.0,
            wip=0.1,
            allphone_ci=True,
        )
        known = self._decoder.lookup_word
        self.language: Language = language_of(names, lambda word: known(word) is not None)
        self._decoder.add_jsgf_string("orders", self.language.jsgf)
        self._decoder.add_allphone_file("phones", None)

    def hear(self, pcm: bytes, rate_hz: int, channels: int) -> Heard:
        """Return what was said and how sure that is."""
        samples = prepare(pcm, rate_hz, channels)
        if samples is None:
            return Heard("", 0.0, understood=False)
        order = _trimmed(self._decode("orders", samples))
        if order is None or not order.text:
            return Heard("", 0.0, understood=False)
        phones = self._decode("phones", samples)
        frames = len(samples) / (2 * _FRAME_SAMPLES)
        fit = _NEVER if phones is None else (order.score - phones.score) / frames * 1e4
        limit = STOP_FIT_LIMIT if order.text in ("stop", "stop now", "please stop") else FIT_LIMIT
        confidence = 1.0 / (1.0 + math.exp(min(50.0, (limit - fit) / _STEEPNESS)))
        clear = phones is not None and _worst_word(order, phones) >= WORD_LIMIT
        sure = confidence >= 0.5 and clear and self.language.is_order(order.text)
        return Heard(order.text, round(confidence if clear else confidence / 2, 3), sure)

    def _decode(self, search: str, samples: bytes) -> _Decoded | None:
        decoder = self._decoder
        decoder.activate_search(search)
        decoder.start_utt()
        decoder.process_raw(samples, full_utt=True)
        decoder.end_utt()
        best = decoder.hyp()
        if best is None or not best.score > 0.0:
            return None
        words = tuple(
            (part.word, _log(part.ascore), part.start_frame, part.end_frame + 1)
            for part in decoder.seg()
        )
        return _Decoded(best.hypstr, math.log(best.score), words)


def _trimmed(order: _Decoded | None) -> _Decoded | None:
    """Drop a short "and" or "then" at the end: what a decoder makes of a last breath.

    The frames stay in the whole sentence's score, so words that were said there still tell.
    """
    if order is None:
        return None
    said = order.text.split()
    while len(said) > 1 and said[-1] in _JOINTS:
        said.pop()
    spoken = [word for word in order.words if not word[0].startswith("<")]
    dropped = spoken[len(said) :]
    if not dropped or sum(end - start for _, _, start, end in dropped) > _BREATH_FRAMES:
        return order
    kept = tuple(word for word in order.words if word not in dropped)
    return _Decoded(" ".join(said), order.score, kept)


def _worst_word(order: _Decoded, phones: _Decoded) -> float:
    """Return the lowest fit of a word per frame; fillers and what is too short do not count."""
    per_frame = [0.0] * (max((end for *_, end in (*order.words, *phones.words)), default=0) + 1)
    for _, score, start, end in phones.words:
        for frame in range(start, end):
            per_frame[frame] = score / (end - start)
    fits = [
        (score - sum(per_frame[start:end])) / (end - start)
        for word, score, start, end in order.words
        if not word.startswith("<") and end - start >= _SHORT_FRAMES
    ]
    return min(fits, default=_NEVER)


def _log(score: float) -> float:
    return math.log(score) if score > 0.0 else _NEVER
