"""Sentences are drawn by seed, with what they ask for and what their units belong to."""

from __future__ import annotations

from random import Random

import pytest

from planner.language.grammar.guessed_order import COMMANDS, NONE, ORDERS, OTHERS, REMEMBERS
from planner.language.intent.intent_model import THING
from tools.train_intent.generator import (
    LANGUAGES,
    draw,
    intents,
    phrases,
    said_by_people,
    writers,
)


def test_both_languages_know_the_same_intents_and_every_order_is_one_of_them() -> None:
    assert len({tuple(phrases(language)) for language in LANGUAGES}) == 1
    assert {*ORDERS, *COMMANDS, *OTHERS, *REMEMBERS} == set(intents())
    assert NONE in intents()


def test_the_same_chance_draws_the_same_sentences() -> None:
    first, second = Random("a"), Random("a")
    assert [draw(first) for _ in range(50)] == [draw(second) for _ in range(50)]


@pytest.mark.parametrize("seed", range(5))
def test_a_unit_has_a_label_and_what_is_counted_or_sought_by_a_phrase_is_named(seed: int) -> None:
    random = Random(seed)
    for _ in range(200):
        example = draw(random)
        assert len(example.labels) == len(example.units) > 0
        by_phrase = draw(random, frozenset(writers()))
        if by_phrase.intent in ("find", "find_at", "count_at"):
            assert THING in by_phrase.labels


def test_a_writer_who_is_kept_away_is_never_drawn() -> None:
    away = frozenset(writers()[::2])
    kept = {one.example.units for one in said_by_people() if one.writer in away}
    kept -= {one.example.units for one in said_by_people() if one.writer not in away}
    random = Random(1)
    assert not kept & {draw(random, away).units for _ in range(3_000)}


def test_people_say_each_sentence_once_and_every_slot_stands_in_it() -> None:
    said = [one.example.units for one in said_by_people()]
    assert len(set(said)) > 0.99 * len(said)
    sought = [one.example for one in said_by_people() if one.example.intent == "find_at"]
    assert sum(THING in each.labels for each in sought) > 0.9 * len(sought)
