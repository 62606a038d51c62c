"""A place said alone answers where somebody is, or narrows a search, and nothing else."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.language.sentence import parse
from planner.mission.departure import LEANS_S
from planner.mission.events import Submitted
from planner.mission.reception import receive
from planner.mission.state import MissionState
from planner.plan import GoalState, GoTo, Language
from tests.planner.mission.leaning import (
    NOW_S,
    changed_by,
    means,
    newest,
    order_asked_about,
    order_done,
    order_under_way,
)

CUP = order_under_way("look for a cup")


def order_in_vain(text: str) -> MissionState:
    """Return the book once a search is over that found nothing."""
    book = order_done(text)
    failed = newest(book).model_copy(update={"state": GoalState.FAILED})
    return replace(book, missions={"g0": failed})


NO_CUP = order_in_vain("look for a cup in the bedroom")
NO_CUP_ZH = order_in_vain("去卧室找杯子")
FOUND = order_done("look for a cup in the bedroom")
MUM = order_asked_about("tell Mum that tea is ready")
CUP_ZH = order_under_way("帮我找个杯子")
MUM_ZH = order_asked_about("跟妈妈说饭好了")

GUESSES = (
    "the kitchen, probably",
    "probably the kitchen",
    "the kitchen",
    "in the kitchen I think",
    "I think it's in the kitchen",
    "it should be in the kitchen",
    "it was in the kitchen this morning, I left it there",
    "maybe try the kitchen",
    "I'd say the kitchen",
    "ok, try the kitchen again",
    "most likely in the kitchen, as always",
    "the kitchen, that's where I saw it last",
    "the kitchen, it's always in there",
    "you could look in the kitchen first",
    "have another look in the kitchen, it was there this morning",
)
GUESSES_ZH = (
    "厨房咯",
    "厨房",
    "应该在厨房吧",
    "可能在厨房",
    "我猜在厨房",
    "那试试厨房",
    "再去厨房看看，应该在那",
    "它在厨房",
)


@pytest.mark.parametrize("said", [g for g in GUESSES if "this morning, I" not in g])
def test_a_guess_narrows_the_search(said: str) -> None:
    assert means(CUP, said, "look for the cup in the kitchen")
    heard = receive(CUP, parse(said), Submitted("new", said, Language.EN), NOW_S)
    assert (heard.takes_back, heard.given.first) == ("g0", True)


@pytest.mark.parametrize("said", GUESSES_ZH)
def test_so_it_does_in_chinese(said: str) -> None:
    assert means(CUP_ZH, said, "去厨房找杯子")


@pytest.mark.parametrize(
    ("book", "said", "order"),
    [
        (NO_CUP, "okay, try the hallway then", "look for the cup in the hallway"),
        (NO_CUP, "have another look in the study", "look for the cup in the study"),
        (CUP, "the living room, I guess, near the TV", "look for the cup near the tv"),
        (NO_CUP, "I dunno, try all of them", "look for the cup in every room"),
        (NO_CUP, "no idea, just look everywhere", "look for the cup in every room"),
        (NO_CUP, "try another room", "look for the cup in every room"),
        (NO_CUP_ZH, "再去别的房间找找看", "到处找杯子"),
        (NO_CUP_ZH, "不知道，都找找看吧", "到处找杯子"),
        (NO_CUP_ZH, "那试试书房", "去书房找杯子"),
    ],
)
def test_a_search_goes_on_elsewhere(book: MissionState, said: str, order: str) -> None:
    assert means(book, said, order)


@pytest.mark.parametrize(
    "said",
    ["she's in the study, as usual", "She's in the study.", "the study, I think", "try the study"],
)
def test_where_somebody_is_completes_the_order(said: str) -> None:
    assert means(MUM, said, "tell Mum in the study that tea is ready")


@pytest.mark.parametrize("said", ["她在书房", "在书房吧", "那你去书房看看，她应该在那", "书房咯"])
def test_so_it_is_completed_in_chinese(said: str) -> None:
    assert means(MUM_ZH, said, "跟书房的妈妈说饭好了")


@pytest.mark.parametrize(
    "said",
    [
        *("the kitchen is dirty", "the kitchen or the study"),
        *("is it in the kitchen?", "it isn't in the kitchen", "I was in the kitchen"),
        *("go to the kitchen", "she's in the kitchen", "all of them are broken"),
        *(
            "try the kitchen if the door is open",
            "everywhere is a mess",
            "I don't know",
            "all over",
        ),
        *("probably", "I guess so", "it's in my hand"),
    ],
)
def test_another_sentence_narrows_nothing(said: str) -> None:
    assert changed_by(CUP, said) is None


@pytest.mark.parametrize(
    "said",
    ["厨房很脏", "厨房还是书房", "去厨房", "在厨房吗", "都行", "都好了", "都在吧"],
)
def test_nor_does_it_in_chinese(said: str) -> None:
    assert changed_by(CUP_ZH, said) is None


@pytest.mark.parametrize(
    "said", ["he's in the study", "Dad's in the study", "she's out", "she's not in the study"]
)
def test_only_who_was_asked_for_is_there(said: str) -> None:
    assert changed_by(MUM, said) is None


def test_a_drive_is_no_search_and_long_ago_is_forgotten() -> None:
    drive = order_under_way("go to the bedroom", GoTo(place="bedroom"))
    assert changed_by(drive, "the kitchen, probably") is None
    later_s = LEANS_S + 1.0
    assert changed_by(CUP, "the kitchen, probably", later_s) is None


def test_a_look_that_is_an_order_stays_one_after_a_search_that_found() -> None:
    assert changed_by(FOUND, "check the kitchen") is None


def test_i_am_is_nobodys_name() -> None:
    home = order_asked_about("tell Mum I'm home")
    assert means(home, "she's in the study", "tell Mum in the study I'm home")


def test_a_search_that_is_over_is_followed_by_another_place() -> None:
    assert means(NO_CUP, "ok, then the study", "look for the cup in the study")
    assert changed_by(CUP, "then the study") is None


@pytest.mark.parametrize(
    "said",
    ["she'll be in the study, watching TV", "she's probably working in the study", "in her study"],
)
def test_what_somebody_does_there_changes_nothing(said: str) -> None:
    assert means(MUM, said, "tell Mum in the study that tea is ready")


@pytest.mark.parametrize("said", ["I think I left it in the study", "we had it in the study"])
def test_where_a_thing_was_left_narrows_the_search(said: str) -> None:
    assert means(CUP, said, "look for the cup in the study")
    assert changed_by(FOUND, said) is None


@pytest.mark.parametrize("said", ["Dad, he's in the study", "the cat, she's in the study", "Mum"])
def test_whom_the_word_does_not_fit_is_not_meant(said: str) -> None:
    assert changed_by(order_asked_about("tell her dinner is ready"), said) is None


@pytest.mark.parametrize(
    "said",
    [
        "it's not there, try the study",
        "nothing there? Try the study then.",
        "no luck, try the study",
    ],
)
def test_where_it_was_not_is_said_before_the_next_place(said: str) -> None:
    assert means(NO_CUP, said, "look for the cup in the study")
