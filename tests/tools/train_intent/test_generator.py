"""Sentences are drawn by seed, marked where they name a thing, and denied ones ask for nothing."""

from __future__ import annotations

from random import Random

import pytest

from planner.language.grammar.guessed_order import NONE, ORDERS
from tools.train_intent.generator import LANGUAGES, draw, intents, phrases


def test_both_languages_know_the_same_intents_and_every_order_is_one_of_them() -> None:
    assert [tuple(phrases(language)) for language in LANGUAGES] == [intents()] * 2
    assert set(ORDERS) < set(intents())
    assert NONE in intents()


def test_the_same_chance_draws_the_same_sentences() -> None:
    first, second = Random("a"), Random("a")
    assert [draw(first) for _ in range(50)] == [draw(second) for _ in range(50)]


@pytest.mark.parametrize("seed", range(5))
def test_a_sentence_tells_which_units_name_its_thing(seed: int) -> None:
    random = Random(seed)
    for _ in range(200):
        example = draw(random)
        assert len(example.thing) == len(example.units) > 0
        if example.intent in ("find", "find_at", "count_at"):
            assert any(example.thing)


def test_phrases_kept_away_and_phrases_used_are_no_common_ones() -> None:
    used, kept = Random(1), Random(2)
    plain = {draw(used, 0.3).units for _ in range(3_000)}
    held = {draw(kept, 0.3, from_held=True).units for _ in range(3_000)}
    assert len(plain & held) < 0.02 * len(held)  # what differs by a slip alone may meet
