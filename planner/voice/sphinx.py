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

from planner.voice.grammar import STOPS, Language, is_stop, language_of
from planner.voice.protocol import Heard
from planner.voice.samples import prepare

FIT_LIMIT = -17.5
"""Per frame, the order's score less the phones', in 1e-4 of natural logarithm as the decoder
scales whole sentences. Of synthetic orders heard right 19 in 20 are above it."""
SHORT_FIT_LIMIT = -13.5
"""For an order without a place: a few words fit many a sound."""
STOP_FIT_LIMIT = -8.0
"""Synthetic stops lie above -3, what is taken for one below -9; a wrong one costs a resume."""
WORD_LIMIT = -7.0
"""The worst word's fit per frame [natural logarithm]: an order bent from others breaks here."""
SILENCE_LIMIT = -5.0
"""The same of a pause: below it somebody spoke where the order is silent."""
_SOUNDS = (
    ("settee", "S EH T IY"),
    ("bath(2)", "B AA TH"),
    ("bathroom(2)", "B AA TH R UW M"),
    ("corridor(3)", "K AO R IH D AO"),
    ("toilet(2)", "T OY L AH T"),
)
"""Words of a home that the American dictionary lacks or that Britons say otherwise: without its
own sound "bath" was heard as "office"."""
_STEEPNESS = 2.0
_SURE = 0.5
_FRAME_SAMPLES = 160
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
        for word, phones in _SOUNDS:
            self._decoder.add_word(word, phones, False)
        known = self._decoder.lookup_word
        self.language: Language = language_of(names, lambda word: known(word) is not None)
        self._decoder.add_jsgf_string("orders", self.language.jsgf)
        self._decoder.add_jsgf_string("stops", STOPS)
        self._decoder.add_allphone_file("phones", None)

    def hear(self, pcm: bytes, rate_hz: int, channels: int) -> Heard:
        """Return what was said and how sure that is."""
        samples = prepare(pcm, rate_hz, channels)
        if samples is None:
            return Heard("", 0.0, understood=False)
        order = _trimmed(self._decode("orders", samples))
        if order is None or is_stop(order.text) or not self.language.is_order(order.text):
            # A stop must not drown among the names, nor pay for them in its score.
            order = self._decode("stops", samples) or order
        if order is None or not order.text:
            return Heard("", 0.0, understood=False)
        return self._judged(order, samples)

    def _judged(self, order: _Decoded, samples: bytes) -> Heard:
        phones = self._decode("phones", samples)
        if phones is None:
            return Heard(order.text, 0.0, understood=False)
        frames = len(samples) / (2 * _FRAME_SAMPLES)
        fit = (order.score - phones.score) / frames * 1e4
        confidence = 1.0 / (1.0 + math.exp(min(50.0, (_limit(order.text) - fit) / _STEEPNESS)))
        if not _fits_all_along(order, phones):
            confidence /= 2.0
        sure = confidence >= _SURE and self.language.is_order(order.text)
        return Heard(order.text, round(confidence, 3), sure)

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


def _limit(text: str) -> float:
    if is_stop(text):
        return STOP_FIT_LIMIT
    return FIT_LIMIT if " the " in text else SHORT_FIT_LIMIT


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


def _fits_all_along(order: _Decoded, phones: _Decoded) -> bool:
    """Tell whether every word and every pause explains its own frames; the shortest do not count.

    The whole may fit where a part does not: "open the door" is nearly "go to the door".
    """
    per_frame = [0.0] * (max((end for *_, end in (*order.words, *phones.words)), default=0) + 1)
    for _, score, start, end in phones.words:
        for frame in range(start, end):
            per_frame[frame] = score / (end - start)
    for word, score, start, end in order.words:
        frames = end - start
        fit = (score - sum(per_frame[start:end])) / max(1, frames)
        limit, shortest = (SILENCE_LIMIT, 10) if word.startswith("<") else (WORD_LIMIT, 3)
        if frames >= shortest and not fit >= limit:
            return False
    return True


def _log(score: float) -> float:
    return math.log(score) if score > 0.0 else _NEVER
