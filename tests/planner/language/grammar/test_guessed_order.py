"""A guess is an order in the sentence's own places, and never more than a question."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.language.grammar.context import Context
from planner.language.grammar.guessed_order import (
    COMMANDS,
    ORDERS,
    OTHERS,
    REMEMBERS,
    GuessKind,
    admit_intents,
    guess_meaning,
    write_order,
)
from planner.language.grammar.lexicon import MarkedText, lexicon_of
from planner.language.grammar.parser import plan
from planner.language.grammar.sentence_text import normalise
from planner.language.intent.features import units_of
from planner.language.intent.intent_model import Guess
from planner.language.readers import OrderWords, read_order
from planner.language.sentence import parse
from planner.plan import (
    EVERY_KIND,
    AnswerPlan,
    Clarify,
    Code,
    Language,
    Plan,
    Recall,
    StepPlan,
    places_of,
)
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


def read(text: str) -> Plan:
    return read_order(OrderWords(parse(text), WORLD.vocabulary, CONTEXT)).plan


def said(text: str) -> Clarify:
    made = read(text)
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
    ("text", "offered"),
    [
        ("turn left a bit more", "turn left 30 degrees"),
        ("turn left a bit", "turn left 30 degrees"),
        ("再往左偏一偏", "向左转30度"),
        ("往右转一点", "向右转30度"),
    ],
)
def test_a_guessed_turn_is_offered_to_the_side_that_is_named(text: str, offered: str) -> None:
    assert [button.text for button in said(text).options] == [offered]


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
    made = read(text)
    assert isinstance(made, AnswerPlan) or (isinstance(made, Clarify) and made.options == ())


@pytest.mark.parametrize("text", ["a bit more", "just a bit closer", "再来一点", "再近点"])
def test_how_much_more_is_no_wish_to_go_faster(text: str) -> None:
    made = read(text)
    assert not isinstance(made, Clarify) or made.options == ()


@pytest.mark.parametrize(
    "text", ["go upon thy way to the kitchen but never mind", "不太想让你瞅厨房"]
)
def test_a_word_that_holds_back_is_not_guessed_past(text: str) -> None:
    marked = lexicon_of(WORLD.vocabulary).mark(normalise(text))
    guessed = guess_meaning(marked, Language.EN)
    assert guessed is None or guessed.kind is not GuessKind.ORDER


MARKED = st.lists(
    st.sampled_from(["kitchen", "study", "sofa", "look", "keys", "over", "gone"]),
    min_size=1,
    max_size=8,
).map(lambda words: lexicon_of(WORLD.vocabulary).mark(" ".join(words)))


@given(
    MARKED,
    st.sampled_from([*ORDERS, *REMEMBERS, *COMMANDS, *OTHERS]),
    st.integers(0, 4**8 - 1),
    st.sampled_from(Language),
)
def test_an_order_of_any_guess_names_the_sentences_places_and_no_other(
    marked: MarkedText, intent: str, labels: int, language: Language
) -> None:
    units = units_of(marked.text)
    guess = Guess(intent, 0.9, tuple(labels >> 2 * at & 3 for at in range(len(units))))
    order = write_order(guess, units, marked, language)
    if order is None:
        return
    named = {mention.ids[0] for mention in marked.mentions}
    made = plan(order, WORLD.vocabulary, CONTEXT)
    if isinstance(made, StepPlan) and intent not in ("rounds", "home", "back"):
        driven = {place for step in made.steps for place in places_of(step)}
        assert driven <= named
    if intent in ORDERS:
        assert intent in admit_intents(len(set(re.findall("[\ue000-\ue7ff]", marked.text))))
    elif isinstance(made, StepPlan):
        assert all(isinstance(step, Recall) for step in made.steps)
