"""What may be said on a site, and what the offline brain makes of each form."""

from __future__ import annotations

import itertools

import pytest

from planner.language.grammar import plan
from planner.plan import AnswerPlan, Bilingual, Entry, StepPlan, Vocabulary
from planner.voice.grammar import MAX_NAMES, PLACE, language_of

NAMES = ("kitchen", "living room", "tv")
LANGUAGE = language_of(NAMES, lambda _word: True)
SITE = Vocabulary(
    entries=tuple(
        Entry(id=name.replace(" ", "_"), kind="room", name=Bilingual(en=name, zh="房间" + name))
        for name in NAMES
    )
)
ORDERS = [
    "go to the kitchen",
    "please drive to the living room",
    "can you go to the tv please",
    "go to the kitchen then the living room",
    "move to the tv and then go to the kitchen and come back",
    "return home",
    "where are you",
]


@pytest.mark.parametrize("text", ORDERS)
def test_the_offline_brain_reads_what_may_be_said(text: str) -> None:
    assert LANGUAGE.is_order(text)
    assert isinstance(plan(text, SITE), StepPlan | AnswerPlan)


@pytest.mark.parametrize("text", ["stop", "stop now", "please stop"])
def test_a_stop_is_always_there(text: str) -> None:
    assert LANGUAGE.is_order(text)
    assert language_of((), lambda _word: True).is_order(text)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "go",
        "go to the",
        "go to the living",
        "go to the kitchen and",
        "go to the kitchen then the",
        "don't go to the kitchen",
        "do not stop",
        "open the kitchen",
        "in the kitchen",
        "go away",
        "kitchen",
        "go to the kitchen go to the tv",
    ],
)
def test_pieces_and_decoys_are_no_orders(text: str) -> None:
    assert not LANGUAGE.is_order(text)


def test_names_that_cant_be_said_are_listed() -> None:
    names = ("Kitchen", "bed-room", "room 2", "Küche", "xyzzyx", "kitchen", "客厅")
    language = language_of(names, lambda word: word != "xyzzyx")
    assert language.left_out == ("room 2", "küche", "xyzzyx", "客厅")
    assert language.is_order("go to the bed room")
    assert "xyzzyx" not in language.jsgf


def test_the_owners_orders_are_heard_whole_with_the_names_of_places() -> None:
    own = ("do the evening round", "end the round in _", "tend the xyzzyx", "brew 2 teas")
    language = language_of(NAMES, lambda word: word != "xyzzyx", own)
    assert language.left_out == ("tend the xyzzyx", "brew 2 teas")
    for said in ("do the evening round", "end the round in the tv", "end the round in kitchen"):
        assert language.is_order(said), said
    for said in ("do the evening", "evening round", "end the round in", "end the round in _"):
        assert not language.is_order(said), said
    assert not language.is_order("do the evening round and then the kitchen")
    nowhere = language_of((), lambda _word: True, own[:2])
    assert nowhere.is_order("do the evening round")
    assert not nowhere.is_order("end the round in _")
    odd = language_of(("hall _", PLACE), lambda _word: True)
    assert odd.names == ()


def test_a_site_of_thousands_keeps_its_grammar_small() -> None:
    letters = "abcdefgh"
    names = ["".join(word) for word in itertools.product(letters, repeat=4)]
    language = language_of(names, lambda _word: True)
    assert len(language.left_out) == len(names) - MAX_NAMES


def test_a_name_cannot_write_grammar() -> None:
    language = language_of(("kitchen; public <x> = go", "<said>", "a|b"), lambda _word: True)
    assert len(language.left_out) == 3
    assert language.jsgf.count(";") == 3
