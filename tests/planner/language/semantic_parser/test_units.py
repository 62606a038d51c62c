"""Sentences are cut into words, characters, names and amounts, each where it was said."""

from __future__ import annotations

import pytest

from planner.language.semantic_parser.amounts import amount_value, find_amounts, write_amount
from planner.language.semantic_parser.plan_grammar import SlotKind
from planner.language.semantic_parser.units import Gazetteer, cut_units

NAMES = Gazetteer(
    {"kitchen": "kitchen", "kids' room": "kids", "linen store": "linen", "七号病房": "seven"}
)


@pytest.mark.parametrize(
    ("sentence", "places"),
    [
        ("Pop to the kitchen's sink", ["kitchen"]),
        ("get yersel to the Kids’ Room", ["kids"]),
        ("look in t'linen store", ["linen"]),
        ("去七號病房看看", ["seven"]),
        ("the kitchenette", []),
    ],
)
def test_a_place_is_one_unit_however_it_is_written(sentence: str, places: list[str]) -> None:
    units = cut_units(sentence, NAMES).units
    assert [unit.place for unit in units if unit.place] == places


@pytest.mark.parametrize(
    ("sentence", "kind", "value"),
    [
        ("wait five minutes", SlotKind.DURATION, 300.0),
        ("a minute and a half", SlotKind.DURATION, 90.0),
        ("half an hour", SlotKind.DURATION, 1800.0),
        ("three quarters of an hour", SlotKind.DURATION, 2700.0),
        ("turn forty-five degrees", SlotKind.ANGLE, 45.0),
        ("a hundred and eighty degrees", SlotKind.ANGLE, 180.0),
        ("one and a half metres", SlotKind.LENGTH, 1.5),
        ("20cm", SlotKind.LENGTH, 0.2),
        ("three more times", SlotKind.TIMES, 3.0),
        ("do it twice", SlotKind.TIMES, 2.0),
        ("2x pls", SlotKind.TIMES, 2.0),
        ("等一个半小时", SlotKind.DURATION, 5400.0),
        ("半个钟头", SlotKind.DURATION, 1800.0),
        ("一米半", SlotKind.LENGTH, 1.5),
        ("走一米五", SlotKind.LENGTH, 1.5),
        ("两米三十", SlotKind.LENGTH, 2.3),
        ("三十公分", SlotKind.LENGTH, 0.3),
        ("轉兩圈", SlotKind.TIMES, 2.0),
        ("左转九十度", SlotKind.ANGLE, 90.0),
    ],
)
def test_an_amount_is_one_unit_with_its_value(sentence: str, kind: SlotKind, value: float) -> None:
    found = [unit.amount for unit in cut_units(sentence, NAMES).units if unit.amount]
    assert len(found) == 1
    assert found[0][0] is kind
    assert found[0][1] == pytest.approx(value)


@pytest.mark.parametrize("sentence", ["a time", "room 5", "七点", "minutes", "0x7", "半"])
def test_what_is_no_amount_is_none(sentence: str) -> None:
    assert list(find_amounts(sentence)) == []


@pytest.mark.parametrize(
    "kind", [SlotKind.DURATION, SlotKind.LENGTH, SlotKind.ANGLE, SlotKind.TIMES]
)
@pytest.mark.parametrize("value", [1.0, 2.0, 30.0, 90.0, 180.0, 300.0, 5400.0])
def test_an_amount_is_written_so_that_it_is_read_again(kind: SlotKind, value: float) -> None:
    assert amount_value(write_amount(kind, value)) == pytest.approx(value)


def test_units_tell_the_sentence_as_it_was_said() -> None:
    said = cut_units("Tell Dad  I'm LATE, 厨房!", NAMES)
    assert said.words_between(2, 4) == "I'm LATE"
    assert said.words_between(0, len(said.units) - 1) == "Tell Dad  I'm LATE, 厨房!"


@pytest.mark.parametrize("sentence", ["", "   ", "\u200b", "'", "🙂🙂", "\ud800"])
def test_odd_sentences_are_cut_without_an_error(sentence: str) -> None:
    assert len(cut_units(sentence, NAMES).units) <= len(sentence)
