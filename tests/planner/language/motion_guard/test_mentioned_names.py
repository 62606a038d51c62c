"""Names are found as they are written, and with one letter wrong where one place alone is meant."""

from __future__ import annotations

import pytest

from planner.language.motion_guard.mentioned_names import find_places, places_named
from tests.planner.language.grammar.conftest import HOME

LONG = [
    (entry.id, name)
    for entry in HOME.entries
    for name in entry.spellings
    if name.isascii() and name.replace(" ", "").isalpha() and len(name.replace(" ", "")) > 6
]


@pytest.mark.parametrize(("place", "name"), LONG)
def test_a_letter_that_is_missing_inside_a_long_name_changes_no_meaning(
    place: str, name: str
) -> None:
    slip = name[:3] + name[4:]
    assert places_named(f"go to the {name.lower()} now", HOME) == (place,)
    assert set(places_named(f"go to the {slip.lower()} now", HOME)) <= {place}


@pytest.mark.parametrize("word", ["bathrooms", "table", "kitten", "between", "livid room"])
def test_another_word_is_no_place(word: str) -> None:
    assert places_named(word, HOME) == ()


def test_places_stand_in_the_order_of_the_text() -> None:
    found = find_places("from the bathrom to the kitchen and the livng room", HOME)
    assert [each.id for each in found] == ["bathroom", "kitchen", "living_room"]
    assert [each.start for each in found] == sorted(each.start for each in found)
