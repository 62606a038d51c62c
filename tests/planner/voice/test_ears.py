"""Two recognisers at once: whose word counts, and that nothing delays a stop."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.plan import Language
from planner.voice import Ears, Recognition, Sound, StopListener, VoiceFailure
from planner.voice import ears as joined

SECOND = Sound(16_000, 1, bytes(32_000))
NEVER = None

Answered = Recognition | VoiceFailure | None


class Played:
    """Answer as a test says: at once, after others, with a failure, or never."""

    def __init__(self, answer: Answered, after: int = 0) -> None:
        self.answer, self.after, self.cancelled = answer, after, False
        self.listeners: tuple[StopListener, ...] = ()
        self.warmed = 0

    async def hear(self, sound: Sound, *, awaits_answer: bool = False) -> Recognition:
        try:
            for _ in range(self.after):
                await asyncio.sleep(0)
            if self.answer is NEVER:
                await asyncio.Event().wait()
        except asyncio.CancelledError:
            self.cancelled = True
            raise
        if isinstance(self.answer, VoiceFailure):
            raise self.answer
        assert self.answer is not None
        return self.answer

    def warm(self) -> None:
        self.warmed += 1

    def listen(self) -> tuple[StopListener, ...]:
        return self.listeners


def heard(text: str, confidence: float = 0.9, *, by: str = "server") -> Recognition:
    zh = any(each > "\u2e80" for each in text)
    understood = confidence >= 0.5
    return Recognition(text, confidence, understood, Language.ZH if zh else Language.EN, by)


def run(story: Coroutine[Any, Any, Recognition]) -> Recognition:
    return asyncio.run(story)


def ears(near: Played, far: Played, timeout_s: float = 5.0) -> Ears:
    return Ears(near, far, "server", timeout_s)


UNKNOWN = heard("", 0.0, by="grammar")
DOWN = VoiceFailure("transcription_unreachable", "nobody")


def test_the_others_word_counts_and_the_grammars_does_not() -> None:
    near, far = Played(heard("go to the kitchen", by="grammar")), Played(heard("去客厅看看"))
    found = run(ears(near, far).hear(SECOND))
    assert (found.transcript, found.language, found.by) == ("去客厅看看", Language.ZH, "server")


@pytest.mark.parametrize("words", ["stop", "stop now"])
@pytest.mark.parametrize("confidence", [0.2, 0.6])
def test_a_stop_of_the_grammar_waits_for_nobody(words: str, confidence: float) -> None:
    far = Played(NEVER)
    found = run(ears(Played(heard(words, confidence, by="grammar")), far).hear(SECOND))
    assert (found.transcript, found.by) == (words, "grammar")
    assert far.cancelled


def test_a_stop_of_the_other_waits_for_nobody() -> None:
    near = Played(NEVER)
    assert run(ears(near, Played(heard("停下"))).hear(SECOND)).transcript == "停下"
    assert near.cancelled


@pytest.mark.parametrize("near", [DOWN, NEVER])
def test_a_grammar_that_hangs_or_fails_keeps_no_order_of_the_other_back(
    near: Answered, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(joined, "GRAMMAR_S", 0.01)
    far = heard("go home")
    assert run(ears(Played(near), Played(far)).hear(SECOND)) == far


def test_where_the_other_fails_the_grammar_answers_and_says_for_whom() -> None:
    near = heard("go to the kitchen", by="grammar")
    found = run(ears(Played(near, after=3), Played(DOWN)).hear(SECOND))
    assert (found.transcript, found.by) == ("go to the kitchen", "grammar")
    assert (found.instead_of, found.trouble) == ("server", "transcription_unreachable")


def test_the_other_has_its_time_and_no_more() -> None:
    found = run(ears(Played(UNKNOWN), Played(NEVER), 0.01).hear(SECOND))
    assert (found.understood, found.trouble) == (False, "transcription_timeout")


def test_where_both_fail_the_others_reason_is_told() -> None:
    near = Played(VoiceFailure("recogniser_unavailable", "no wheel"))
    with pytest.raises(VoiceFailure, match="transcription_unreachable"):
        run(ears(near, Played(DOWN)).hear(SECOND))


TEXTS = st.sampled_from(("stop", "go to the kitchen", "停", "去厨房", "", "nonsense"))
ANSWERS = st.one_of(st.builds(heard, TEXTS, st.floats(0, 1)), st.just(DOWN), st.none())


@given(near=ANSWERS, far=ANSWERS, delays=st.tuples(st.integers(0, 4), st.integers(0, 4)))
def test_a_stop_that_either_hears_is_never_lost(
    near: Answered, far: Answered, delays: tuple[int, int]
) -> None:
    """Whatever the other one hears, says, or does not say at all."""
    stops = [
        each.transcript
        for each in (near, far)
        if isinstance(each, Recognition)
        and each.transcript in ("stop", "停")
        and (each.understood or each.confidence >= 0.2)
    ]
    both = ears(Played(near, delays[0]), Played(far, delays[1]), 0.005)
    if near is None:
        return  # the built-in recogniser has its own bound (VoiceWorker) and never hangs
    try:
        found = run(both.hear(SECOND)).transcript
    except VoiceFailure:
        found = ""
    assert not stops or found in stops
