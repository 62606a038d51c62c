"""What somebody is told may deny anything: the order to tell it denies nothing."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis.strategies import sampled_from

from planner.language.grammar import Context, plan
from planner.language.grammar.en.told_words import quote_told_words
from planner.plan import EVERY_KIND, Ask, Say, StepPlan, Vocabulary

WHOLE = Context(runnable=EVERY_KIND)
HEARERS = sampled_from(
    ("Dad", "Emma", "my brother", "everyone", "the kids", "Grandpa in the study")
)
WORDS = sampled_from(
    (
        "I won't be home for dinner", "the car isn't there", "there's no milk left",
        "nobody's at the door", "we're not eating yet", "she doesn't have to wait",
        "we leave in ten minutes", "the game starts at eight", "I can't come tomorrow",
    )
)  # fmt: skip
MORE = sampled_from(
    (" if he asks", " unless it rains", " or something", " until six", " when I call")
)


def _said(text: str, home: Vocabulary) -> list[str] | None:
    made = plan(text, home, WHOLE)
    if not isinstance(made, StepPlan):
        return None
    return [step.text for step in made.steps if isinstance(step, Say)]


@given(HEARERS, WORDS, sampled_from(("", ", please", ", thanks")))
def test_words_that_deny_are_told_as_they_stand(
    home: Vocabulary, who: str, words: str, end: str
) -> None:
    for text in (f"tell {who} {words}", f"please let {who} know that {words}", f"say {words}"):
        said = _said(text + end, home)
        assert said is not None, text
        assert len(said) == 1
        assert said[0].endswith(words), said


@given(HEARERS, WORDS)
def test_a_denied_order_to_tell_tells_nothing(home: Vocabulary, who: str, words: str) -> None:
    for text in (f"don't tell {who} {words}", f"never tell {who} that {words}"):
        assert _said(text, home) is None, text


@given(HEARERS, WORDS, MORE)
def test_words_with_a_condition_or_a_choice_are_not_quoted(who: str, words: str, more: str) -> None:
    assert quote_told_words(f"tell {who} {words}{more}") is None


@given(HEARERS, WORDS)
def test_an_order_beside_the_words_keeps_its_own_denial(
    home: Vocabulary, who: str, words: str
) -> None:
    assert _said(f"tell {who} {words} and don't go to the kitchen", home) is None
    assert _said(f"don't go to the kitchen and tell {who} {words}", home) is None


@pytest.mark.parametrize("verb", ["tell", "ask", "remind"])
def test_what_somebody_is_not_to_do_is_asked_of_them(home: Vocabulary, verb: str) -> None:
    said = _said(f"{verb} Emma not to go into the kitchen", home)
    assert said == ["Emma, please don't go into the kitchen"]


def test_the_speaker_and_nobody_are_no_hearers() -> None:
    for who in ("me", "us", "nobody", "no one"):
        assert quote_told_words(f"tell {who} it isn't there") is None


@pytest.mark.parametrize(
    ("order", "asked"),
    [
        ("ask Emma if she wants tea or coffee", "Emma, do you want tea or coffee?"),
        ("ask Emma whether she'd like pizza tonight", "Emma, would you like pizza tonight?"),
        ("ask Emma if I can borrow the car tomorrow", "Emma, can I borrow the car tomorrow?"),
        ("ask Emma when dinner is", "Emma, when is dinner?"),
        ("ask Emma what time she's leaving tomorrow", "Emma, what time are you leaving tomorrow?"),
    ],
)
def test_what_somebody_is_asked_holds_its_own_choice_and_time(
    home: Vocabulary, order: str, asked: str
) -> None:
    made = plan(order, home, WHOLE)
    assert isinstance(made, StepPlan)
    assert [step.question for step in made.steps if isinstance(step, Ask)] == [asked]


@pytest.mark.parametrize(
    "text",
    [
        "ask Emma or Dad if they want tea", "ask Emma if she wants tea or go home",
        "ask Emma if she wants tea unless she is asleep", "ask Emma if she is up when Dad comes",
        "don't ask Emma if she wants tea or coffee",
    ],
)  # fmt: skip
def test_a_choice_or_a_condition_of_the_order_is_no_part_of_the_question(
    home: Vocabulary, text: str
) -> None:
    assert not isinstance(plan(text, home, WHOLE), StepPlan), text
