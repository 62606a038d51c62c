"""One more place joins what is done at the places before, in whichever words it is added."""

from dataclasses import replace
from typing import Any

import pytest

from planner.language.sentence import parse
from planner.mission.events import Submitted
from planner.mission.reception import receive
from planner.mission.state import MissionState
from planner.plan import Count, GoalState, GoTo, Language, Patrol, Say
from tests.planner.mission.leaning import NOW_S, changed_by, means, order_done, order_under_way


def run(text: str, *steps: Any) -> MissionState:
    """Return the book while the robot is at this order."""
    book = order_under_way(text, *steps)
    runs = book.missions["g0"].model_copy(update={"state": GoalState.RUNNING})
    return replace(book, missions={"g0": runs}, running="g0")


ROUND = Patrol(places=("kitchen", "hallway"), look=True)
PATROL = run("patrol the kitchen and the hallway", ROUND)
PATROL_ZH = run("巡逻厨房和走廊", ROUND)
COUNTED = order_done("count the cups in the kitchen")
COUNTED_ZH = order_done("数一下厨房的杯子")
ADDED = ("and the study while you're at it", "do the study too", "and the study as well",
         "include the study", "take in the study as well, please")  # fmt: skip
ADDED_ZH = ("书房也去一下", "顺便把书房也看一下", "书房也加上", "书房也转一圈吧")


@pytest.mark.parametrize("said", ADDED)
def test_a_patrol_that_runs_takes_one_more_place_in(said: str) -> None:
    assert means(PATROL, said, "patrol the kitchen and the hallway and the study")
    heard = receive(PATROL, parse(said), Submitted("new", said, Language.EN), NOW_S)
    assert (heard.takes_back, heard.given.first, heard.stops) == ("g0", True, False)


@pytest.mark.parametrize("said", ADDED_ZH)
def test_so_it_does_in_chinese(said: str) -> None:
    assert means(PATROL_ZH, said, "巡逻厨房、走廊、书房")


@pytest.mark.parametrize("said", ADDED)
def test_what_was_counted_is_counted_there_too(said: str) -> None:
    assert means(COUNTED, said, "count the cups in the study")


@pytest.mark.parametrize("said", ["书房也数一下", "不够，书房的也数一下", "书房也帮我数一遍呗"])
def test_so_it_is_in_chinese(said: str) -> None:
    assert means(COUNTED_ZH, said, "数一下书房的杯子")


def test_a_look_that_is_asked_for_says_nothing_there() -> None:
    told = order_done("去厨房说吃饭了", GoTo(place="kitchen"), Say(text="吃饭了"))
    assert means(told, "书房也瞅瞅", "去书房看看")


@pytest.mark.parametrize("said", ["do the dishes too", "add the milk", "别数书房", "书房别数了"])
def test_what_names_no_place_or_denies_one_adds_none(said: str) -> None:
    for book in (COUNTED, COUNTED_ZH, PATROL):
        assert changed_by(book, said) is None


@pytest.mark.parametrize(
    ("said", "then"),
    [
        ("when you're done in the kitchen, go to the study", "go to the study"),
        ("once you've finished the kitchen, come back", "come back"),
        ("when you're done, go to the study", "go to the study"),
        ("when you're done in the bedroom, go to the study", ""),
    ],
)
def test_what_follows_a_place_waits_for_what_is_done_there(said: str, then: str) -> None:
    runs = run("count the cups in the kitchen", Count(object="cup", place="kitchen"))
    assert means(runs, said, then) if then else changed_by(runs, said) is None


@pytest.mark.parametrize(
    ("said", "then"),
    [
        ("数完厨房，顺便去书房看看", "去书房看看"),
        ("数完了去书房", "去书房"),
        ("数完卧室去书房", ""),
    ],
)
def test_so_it_waits_in_chinese(said: str, then: str) -> None:
    runs = run("数一下厨房的杯子", Count(object="杯子", place="kitchen"))
    assert means(runs, said, then) if then else changed_by(runs, said) is None
