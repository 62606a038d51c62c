"""Check the offline brain in other worlds: names of two places, no places, no pose, every alias."""

from __future__ import annotations

import pytest

from planner.language.grammar import plan
from planner.plan import (
    AnswerPlan,
    Bilingual,
    Clarify,
    Code,
    Entry,
    StepPlan,
    Vocabulary,
)


def test_a_name_of_two_places_is_asked_about() -> None:
    rooms = [
        Entry(id=f"bedroom_{n}", kind="room", name=Bilingual(en="bedroom", zh="卧室"))
        for n in (1, 2)
    ]
    made = plan("去卧室", Vocabulary(entries=tuple(rooms)))
    assert isinstance(made, Clarify)
    assert made.code is Code.AMBIGUOUS
    for option in made.options:
        assert isinstance(plan(option.text, Vocabulary(entries=tuple(rooms))), StepPlan)


@pytest.mark.parametrize("vocabulary", [Vocabulary(), Vocabulary(entries=())])
def test_an_empty_world_goes_nowhere(vocabulary: Vocabulary) -> None:
    made = plan("go to the kitchen", vocabulary)
    assert isinstance(made, Clarify)
    assert "none" in made.question.en


def test_a_brain_that_does_not_know_where_it_is_says_so(home: Vocabulary) -> None:
    made = plan("where are you", home)
    assert made == AnswerPlan(
        text=Bilingual(en="I don't know where I am yet.", zh="我还不知道自己在哪里。")
    )


def test_every_spelling_of_every_place_is_understood(home: Vocabulary) -> None:
    for entry in home.entries:
        for spelling in entry.spellings:
            for text in (f"go to the {spelling}", f"去{spelling}"):
                made = plan(text, home)
                assert isinstance(made, StepPlan), text
                assert [getattr(step, "place", None) for step in made.steps] == [entry.id], text


def test_a_typo_that_fits_two_places_asks() -> None:
    rooms = tuple(
        Entry(id=name, kind="room", name=Bilingual(en=name, zh=zh))
        for name, zh in (("storeroom", "储藏室"), ("storerooms", "仓库"))
    )
    for text in ("go to the storerom", "find the cup in the storerom"):
        made = plan(text, Vocabulary(entries=rooms))
        assert isinstance(made, Clarify), text
        assert made.code in (Code.UNKNOWN_PLACE, Code.AMBIGUOUS)
    asked = plan("go to the storerom", Vocabulary(entries=rooms))
    assert isinstance(asked, Clarify)
    assert {option.text for option in asked.options} == {
        "go to the storeroom",
        "go to the storerooms",
    }
