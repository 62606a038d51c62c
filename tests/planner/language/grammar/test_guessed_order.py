"""A guess is an order in the sentence's own places, and never more than a question."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.grammar.context import Context
from planner.language.grammar.guessed_order import NOTHING, ORDERS, guess_order, write_order
from planner.language.grammar.lexicon import lexicon_of
from planner.language.grammar.parser import plan
from planner.language.grammar.sentence_text import normalise
from planner.language.intent.features import units_of
from planner.language.intent.intent_model import Guess
from planner.plan import EVERY_KIND, Clarify, Code, Language, StepPlan, places_of
from pons.evals.suites import HOME_SITE
from pons.evals.world import site_world

WORLD = site_world(HOME_SITE)
CONTEXT = Context(room="hallway", runnable=frozenset(EVERY_KIND))
SPOKEN = (
    "would you fancy a trip to the kitchen",
    "grandma fell asleep in the living room, go keep her company",
    "my glasses have walked off again",
    "the kitchen and the study, one after the other, if you please",
    "能不能麻烦您老人家移步厨房",
    "厨房那边叮叮当当的,什么情况啊",
)


def said(text: str) -> Clarify:
    made = plan(text, WORLD.vocabulary, CONTEXT)
    assert isinstance(made, Clarify)
    return made


@pytest.mark.parametrize("text", SPOKEN)
def test_what_is_not_understood_moves_nothing_whatever_is_guessed(text: str) -> None:
    assert said(text).code is Code.NOT_UNDERSTOOD


def test_a_guess_is_offered_as_an_order_that_the_grammar_reads() -> None:
    (button,) = said("would you fancy a trip to the kitchen").options
    assert button.text == "go to the kitchen"
    assert isinstance(plan(button.text, WORLD.vocabulary, CONTEXT), StepPlan)
    assert button.label.zh == "去厨房"


@pytest.mark.parametrize(
    "text",
    [
        "the kitchen is lovely",
        "I was in the kitchen",
        "what a nice sofa",
        "厨房真好看",
        "我昨天去厨房了",
    ],
)
def test_what_asks_for_nothing_is_offered_nothing(text: str) -> None:
    assert said(text).options == ()


@pytest.mark.parametrize(
    "text", ["go upon thy way to the kitchen but never mind", "不太想让你瞅厨房"]
)
def test_a_word_that_holds_back_is_not_guessed_past(text: str) -> None:
    marked = lexicon_of(WORLD.vocabulary).mark(normalise(text))
    assert guess_order(marked, Language.EN) in (None, NOTHING)


MARKED = st.lists(
    st.sampled_from(["kitchen", "study", "sofa", "look", "keys", "over", "gone"]),
    min_size=1,
    max_size=8,
).map(lambda words: lexicon_of(WORLD.vocabulary).mark(" ".join(words)))


@given(
    MARKED, st.sampled_from([*ORDERS, "none", "?"]), st.integers(0, 255), st.sampled_from(Language)
)
def test_an_order_of_any_guess_names_the_sentences_places_and_no_other(
    marked: object, intent: str, tags: int, language: Language
) -> None:
    text = marked.text  # type: ignore[attr-defined]
    units = units_of(text)
    guess = Guess(intent, 0.9, tuple(bool(tags >> at & 1) for at in range(len(units))))
    order = write_order(guess, units, marked, language)  # type: ignore[arg-type]
    if order is None:
        return
    named = {mention.ids[0] for mention in marked.mentions}  # type: ignore[attr-defined]
    made = plan(order, WORLD.vocabulary, CONTEXT)
    if isinstance(made, StepPlan) and intent != "rounds":
        driven = {place for step in made.steps for place in places_of(step)}
        assert driven <= named
    marks = set(re.findall("[\ue000-\ue7ff]", text))
    assert len(marks) == sum(slot in "".join(ORDERS[intent]) for slot in ("{p}", "{q}"))
