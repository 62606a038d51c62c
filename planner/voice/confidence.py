"""Doubt a grammar search's result: it always finds the order that fits best, of any sound.

The same samples are decoded twice more, freely: as phones, which fit anything, and as everyday
words. An order is believed where no word of it fits much worse than the words that would have been
heard instead, where nobody spoke in its pauses, and where the words do not tell the whole better.
Pure: limits and their measurements (docs/adr/0013); no engine.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

WORD_LIMIT = -4.5
"""The worst word against everyday words in the same frames [natural logarithm per frame]. Of
synthetic orders heard right all but the odd one lie above -3.3; "is the desk clean", heard as "move
to the desk", below -5."""
MISFIT_LIMIT = -90.0
"""The worst word's whole distance from everyday words [natural logarithm]: a long word need not fit
as badly. "put the book on the sofa" heard as "go to the sofa and the sofa" has a sofa at -78."""
PAUSE_LIMIT = -85.0
"""All pauses against phones [natural logarithm]: below it somebody spoke where the order is silent.
Heard right mostly above -37, which is sure; "return home" for a longer sentence below -60."""
WHOLE_LIMIT = 2.0
"""The order against everyday words, per frame, as the decoder scales whole sentences [1e-4]. They
pay for each word, so it is above zero: right mostly 7.7 to 20, which is sure; "go to the basement"
3 to 5."""
STOP_LIMIT = -8.0
"""A stop against phones, per frame [1e-4]. Synthetic stops lie above -3, what is taken for one
below -9; a wrong one costs a resume."""
_SCALES = (1.27, 29.0, 43.0, 5.1)
"""How far past its limit a measure must be for 0.73; past 1.1 times that nobody is asked first."""
_SHIFT = 1024
"""The decoder keeps scores without their last ten bits."""
_SHORT_FRAMES = 5
_PAUSE_FRAMES = 8

Timed = tuple[str, float, int, int]
"""Word, natural logarithm of its acoustic score, first frame, frame after its last."""


@dataclass(frozen=True, slots=True)
class DecoderResult:
    """Hold one search's result over the samples."""

    text: str
    score: float
    """Natural logarithm, as the decoder scales whole sentences."""
    words: tuple[Timed, ...]


def stop_confidence(stop: DecoderResult, phones: DecoderResult, frames: float) -> float:
    """Return how far to believe a stop, 0 to 1; from one half on it is believed."""
    return _sure(((stop.score - phones.score) / frames * 1e4 - STOP_LIMIT) / 2.0)


def confidence(
    order: DecoderResult, phones: DecoderResult | None, words: DecoderResult, frames: float
) -> float:
    """Return how far to believe an order, 0 to 1; from one half on it is believed.

    Without ``phones`` its pauses are known to be silent.
    """
    fits = misfits(order, words)
    measured = (
        min((fit / frames for fit, frames in fits), default=-math.inf) - WORD_LIMIT,
        min((fit for fit, _ in fits), default=-math.inf) - MISFIT_LIMIT,
        (0.0 if phones is None else pauses(order, phones)) - PAUSE_LIMIT,
        (order.score - words.score) / frames * 1e4 - WHOLE_LIMIT,
    )
    margins = (over / scale for over, scale in zip(measured, _SCALES, strict=True))
    return _sure(min(margins))


def misfits(order: DecoderResult, words: DecoderResult) -> list[tuple[float, int]]:
    """Return each word's fit against a free search and its frames; the shortest are let off."""
    free = _by_frame(words)
    return [
        ((score - sum(free[start:end])) * _SHIFT, end - start)
        for word, score, start, end in order.words
        if not word.startswith("<") and end - start >= _SHORT_FRAMES
    ]


def pauses(order: DecoderResult, phones: DecoderResult) -> float:
    """Return how much better phones explain an order's pauses; 0 where they are silent."""
    free = _by_frame(phones)
    return sum(
        min(0.0, (score - sum(free[start:end])) * _SHIFT)
        for _, score, start, end in long_pauses(order)
    )


def long_pauses(order: DecoderResult) -> list[Timed]:
    """Return the pauses that are long enough to hide a word."""
    return [
        timed
        for timed in order.words
        if timed[0].startswith("<") and timed[3] - timed[2] >= _PAUSE_FRAMES
    ]


def _by_frame(decoded: DecoderResult) -> list[float]:
    scores = [0.0] * (max((end for *_, end in decoded.words), default=0) + 1)
    for _, score, start, end in decoded.words:
        for frame in range(start, end):
            scores[frame] = score / (end - start)
    return scores


def _sure(margin: float) -> float:
    return 1.0 / (1.0 + math.exp(max(-50.0, min(50.0, -margin))))
