"""What a question asks for in its words: the thing, its neighbour, the place to look in."""

from __future__ import annotations

import pytest

from planner.language.questions import (
    Relation,
    Whereabouts,
    fold_names,
    has_several_neighbours,
    looks_round,
    names_floor,
    read_question,
    split_relation,
)

NAMES = fold_names(((True, ("Study", "书房", "den")), (False, ("fridge", "冰箱"))))


@pytest.mark.parametrize(
    ("question", "asked"),
    [
        ("is there a red cup next to the coffee table?", ("red cup", "next to the coffee table")),
        ("Do you see Mary on the sofa?", ("mary", "on the sofa")),
        ("is my cup still on the table", ("cup", "on the table")),
        ("沙发旁边有没有红色的杯子？", ("红色的杯子", "沙发旁边")),
        ("桌子上有书吗", ("书", "桌子上")),
        ("书在桌子上吗", ("书", "桌子上")),
        ("有人在桌子旁边吗", ("有人", "桌子旁边")),
        ("有没有杯子在桌子上", ("杯子", "桌子上")),
        ("看到两瓶牛奶了吗", ("牛奶", "")),
        ("what is on the table?", None),
        ("客厅什么情况", None),
    ],
)
def test_where_a_thing_may_be_is_told_apart_from_what_is_asked_for(
    question: str, asked: tuple[str, str] | None
) -> None:
    found = next(iter(read_question(question, NAMES).asked), None)
    assert (found and (found.what, found.where)) == asked


@pytest.mark.parametrize(
    ("question", "place", "where"),
    [
        ("is there milk in the fridge", "fridge", Whereabouts(None, "the fridge", "in the fridge")),
        ("is there a cup near the fridge", "fridge", None),
        ("is there a cup near the fridge", None, (Relation.NEAR, "the fridge", "near the fridge")),
        ("is there a cup in the den", None, None),
        (
            "is there a cup on the table in the study",
            None,
            (Relation.ON, "the table", "on the table"),
        ),
        ("书房的桌子上有杯子吗", None, (Relation.ON, "桌子", "桌子上")),
        ("is there a cup here", None, None),
        ("你这里有没有杯子", None, None),
    ],
)
def test_a_place_says_where_to_look_and_a_thing_is_a_neighbour(
    question: str, place: str | None, where: Whereabouts | None
) -> None:
    assert read_question(question, NAMES, place).where == where


def test_only_a_form_that_is_read_is_sure() -> None:
    assert read_question("what is on the table", NAMES).is_sure
    loose = read_question("the cup on the table, is it red", NAMES)
    assert (loose.is_sure, loose.what) == (False, "the cup")
    assert not read_question("is there a cup" + " in a" * 60, NAMES).asked, "too long to be read"


def test_a_thing_is_parted_from_its_neighbour() -> None:
    assert split_relation("red cup") is None
    for words in ("Bottle on top of the table", "the table上面的bottle"):
        assert (split_relation(words) or ())[1:2] == (Relation.ON,)
    assert split_relation("椅子旁边的箱子") == ("箱子", Relation.NEAR, "椅子")


def test_several_neighbours_are_told_by_their_number_or_their_plural() -> None:
    several = ("cups on the tables", "cup on all tables", "两张桌子上的杯子")
    assert all(has_several_neighbours(words, "table") for words in several)
    assert not has_several_neighbours("cup on the bus", "bus")
    assert not has_several_neighbours("cup", "table")


def test_the_floor_has_its_own_words() -> None:
    assert all(map(names_floor, ("the floor", "ground", "地", "地板")))
    assert not names_floor("the table")


@pytest.mark.parametrize(
    ("question", "about"),
    [
        ("look around", True), ("Look round, please", True), ("what is around you?", True),
        ("who is around?", True), ("describe your surroundings", True), ("看看四周", True),
        ("周围有什么？", True), ("环顾一下", True), ("你的周围有人吗", True),
        ("is there a round table?", False), ("what stands around the table?", False),
        ("桌子周围有什么", False), ("what do you see?", False), ("有没有圆桌", False),
    ],
)  # fmt: skip
def test_only_who_asks_for_it_has_the_robot_turn_about(question: str, about: bool) -> None:
    assert looks_round(question) is about
