"""When an order is believed: every word, every pause and the whole have their say."""

from __future__ import annotations

import pytest

from planner.voice.confidence import (
    MISFIT_LIMIT,
    PAUSE_LIMIT,
    WORD_LIMIT,
    DecoderResult,
    confidence,
    long_pauses,
    misfits,
    pauses,
    stop_confidence,
)
from planner.voice.recogniser import SURE

FRAMES = 100.0
NAT = 1 / 1024
"""One natural logarithm as the decoder keeps it."""


def order(text: str = "go to the sofa", word: float = 0.0, pause: float = 0.0) -> DecoderResult:
    """Return an order of 60 frames with a pause of 40, each that much worse than nothing."""
    words = (("go", word * 60 * NAT, 0, 60), ("<sil>", pause * NAT, 60, 100))
    return DecoderResult(text, -0.5, words)


def short(word: float) -> DecoderResult:
    """Return an order with one word of ten frames that fits so badly per frame."""
    words = (("go", 0.0, 0, 50), ("the", word * 10 * NAT, 50, 60), ("<sil>", 0.0, 60, 100))
    return DecoderResult("go to the sofa", -0.5, words)


PHONES = DecoderResult("G OW", -0.4, (("G", 0.0, 0, 60), ("SIL", 0.0, 60, 100)))
WORDS = DecoderResult("go two the sofa", -0.7, (("go", 0.0, 0, 60), ("<sil>", 0.0, 60, 100)))


def test_what_fits_all_along_is_believed() -> None:
    assert confidence(order(), PHONES, WORDS, FRAMES) > SURE


@pytest.mark.parametrize(
    ("heard", "words"),
    [
        (order(word=(MISFIT_LIMIT - 1.0) / 60), WORDS),
        (short(WORD_LIMIT - 0.1), WORDS),
        (order(pause=PAUSE_LIMIT - 1.0), WORDS),
        (order(), DecoderResult("go two the sofa", -0.5, WORDS.words)),
    ],
)
def test_one_doubt_is_enough(heard: DecoderResult, words: DecoderResult) -> None:
    assert confidence(heard, PHONES, words, FRAMES) < 0.5


def test_a_stop_is_judged_by_the_phones_alone() -> None:
    near = DecoderResult("stop", -0.41, (("stop", -9.0, 0, 60),))
    assert stop_confidence(near, PHONES, FRAMES) > 0.9
    far = DecoderResult("stop", -0.6, (("stop", -9.0, 0, 60),))
    assert stop_confidence(far, PHONES, FRAMES) < 0.5


def test_pauses_known_to_be_silent_need_no_phones() -> None:
    bad = order(pause=PAUSE_LIMIT - 1.0)
    assert confidence(bad, PHONES, WORDS, FRAMES) < 0.5 < confidence(bad, None, WORDS, FRAMES)
    assert long_pauses(bad) == [bad.words[1]]


def test_the_measures() -> None:
    ((fit, frames),) = misfits(order(word=-2.0), WORDS)
    assert fit == pytest.approx(-120.0)
    assert frames == 60
    assert pauses(order(pause=-7.0), PHONES) == pytest.approx(-7.0)
    assert pauses(order(pause=7.0), PHONES) == 0.0
    assert confidence(DecoderResult("go home", -0.5, ()), PHONES, WORDS, FRAMES) < 0.5, (
        "no word at all"
    )


def test_no_score_is_too_odd() -> None:
    odd = DecoderResult("go to the sofa", -1e9, (("go", -1e9, 0, 60),))
    assert confidence(odd, PHONES, WORDS, FRAMES) < 0.01
    assert confidence(order(), DecoderResult("", -1e9, ()), WORDS, FRAMES) > 0.5
