"""A question about a place that nobody knows is about that place, and never about here."""

from __future__ import annotations

import pytest

from planner.language.grammar.context import Context
from planner.language.grammar.parser import plan
from planner.language.questions import find_elsewhere
from planner.plan import EVERY_KIND, Clarify, Code, Language, StepPlan, Vocabulary
from tests.planner.language.grammar.conftest import NOON

UNKNOWN_EN = ("conservatory", "garage", "cellar", "attic", "back room", "gym")
ASKED_EN = (
    "is there a cup in the {}?", "is anybody in the {}?", "see if anyone is in the {}",
    "what is in the {}?", "who is in the {}?", "is the light on in the {}?", "look in the {}",
    "look into the {}", "is there a cup on the shelf in the {}?", "tell me what is in the {}",
    "is there still a dog in our {} right now?", "do you see a chair in the {}?",
)  # fmt: skip
UNKNOWN_ZH = ("车库", "地下室", "阁楼", "储藏室", "婴儿房", "健身房")
ASKED_ZH = (
    "{}里有人吗", "看看{}有没有猫", "去{}看看有没有人", "检查一下{}", "看看{}", "{}里有什么",
    "{}里有没有杯子", "杯子在{}里吗", "把{}检查一遍", "看看{}里有没有椅子",
)  # fmt: skip
SORTS = ("garage", "cellar", "attic", "conservatory", "balcony", "garden")
ABOUT_SORTS = ("is the {} door open?", "check the {}", "is the {} light on?", "inspect the {}")


def refused(text: str, home: Vocabulary) -> Clarify:
    language = Language.EN if text.isascii() else Language.ZH
    made = plan(text, home, Context(room="study", language=language, runnable=EVERY_KIND, now=NOON))
    assert isinstance(made, Clarify), (text, made)
    return made


@pytest.mark.parametrize(
    ("asked", "names"), [(a, UNKNOWN_EN) for a in ASKED_EN] + [(a, UNKNOWN_ZH) for a in ASKED_ZH]
)
def test_an_unknown_place_is_named_and_the_known_ones_are_told(
    asked: str, names: tuple[str, ...], home: Vocabulary
) -> None:
    for name in names:
        made = refused(asked.format(name), home)
        assert made.code is Code.UNKNOWN_PLACE, asked.format(name)
        assert f"“{name}”" in made.question.en, made.question.en
        assert "Known places: living room, kitchen" in made.question.en
        assert "客厅" in made.question.zh


@pytest.mark.parametrize("asked", ABOUT_SORTS)
@pytest.mark.parametrize("sort", SORTS)
def test_a_sort_of_room_is_a_place_wherever_it_stands(
    asked: str, sort: str, home: Vocabulary
) -> None:
    made = refused(asked.format(sort), home)
    assert made.code is Code.UNKNOWN_PLACE
    assert f"“{sort}”" in made.question.en


@pytest.mark.parametrize(
    "text",
    ["check the {}", "is the {} open?", "look at the {}", "检查{}", "看看{}"],
)
def test_a_door_that_is_told_by_its_side_is_one_place(text: str, home: Vocabulary) -> None:
    known, unknown = ("front door", "back door") if text.isascii() else ("大门", "后门")
    made = refused(text.format(unknown), home)
    assert made.code is Code.UNKNOWN_PLACE
    assert f"“{unknown}”" in made.question.en
    there = plan(text.format(known), home, Context(runnable=EVERY_KIND, now=NOON))
    assert isinstance(there, StepPlan)
    assert any(getattr(step, "place", None) == "front_door" for step in there.steps)


@pytest.mark.parametrize(
    "text",
    [
        "is there a cup in the box?", "is there a cup in front of you?", "is anybody there?",
        "is there a cup in the corner?", "is the cat in the house?", "is anything in the way?",
        "is there a cup on the shelf", "what do you see?", "look at the picture", "look around",
        "is anyone in the room?", "what is in the picture?", "is it dark in here?",
        "is the door behind you open?", "open the door and look", "是不是有人", "看看门口",
        "这里有没有杯子", "箱子里有没有杯子", "家里有人吗", "房间里有人吗", "你看到了什么",
        "画面里有什么", "看看前面有没有人", "书架上有没有杯子", "屋里有人吗", "你手里有什么",
        "in the " * 3000, "看看" * 3000, "the garage door " * 800,  # too long to be read
    ],
)  # fmt: skip
def test_what_is_about_here_or_a_thing_names_no_place(text: str) -> None:
    assert find_elsewhere(text) is None


def test_a_known_place_is_never_elsewhere(home: Vocabulary) -> None:
    for entry in home.entries:
        for name, asked in ((entry.name.en, ASKED_EN), (entry.name.zh, ASKED_ZH)):
            for form in asked:
                text = form.format(name)
                assert find_elsewhere(text, {name}) is None, text
        if entry.kind == "room":
            made = plan(
                f"is there a cup in the {entry.name.en}?", home,
                Context(runnable=EVERY_KIND, now=NOON),
            )  # fmt: skip
            assert isinstance(made, StepPlan)
            assert any(getattr(step, "place", None) == entry.id for step in made.steps)
