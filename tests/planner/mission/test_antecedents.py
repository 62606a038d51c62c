"""He, they and there mean whom and what the orders before spoke of, or stay as they were said."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from planner.language.sentence import parse
from planner.mission.departure import LEANS_S
from planner.mission.events import Planned, Submitted
from planner.mission.reducer import advance
from planner.plan import Find, GoTo, Look, StepPlan
from tests.planner.mission.leaning import NOW_S, changed_by, means, order_done
from tests.planner.mission.test_pronouns import book_after

if TYPE_CHECKING:
    from planner.mission.state import MissionState

PLACES = (("kitchen", "厨房"), ("study", "书房"))


def asked(who: str, place: tuple[str, str], *, chinese: bool = False) -> MissionState:
    text = f"{who}在{place[1]}吗" if chinese else f"is {who} in the {place[0]}?"
    look = Look(question=text.rstrip("?"), place=place[0])
    return book_after(GoTo(place=place[0]), look, text=text)


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(
    ("said", "order"),
    [
        ("if he is, tell him tea is ready", "if Dad is in the {p}, tell him tea is ready"),
        ("if he isn't, come back", "if Dad is not in the {p}, come back"),
        (
            "then say hello, otherwise come back",
            "if Dad is in the {p}, say hello, otherwise come back",
        ),
        ("tell him tea is ready", "tell Dad in the {p} tea is ready"),
        ("please ask him what he wants", "please ask Dad in the {p} what he wants"),
        ("go there", "go to the {p}"),
        ("go there and wait", "go to the {p} and wait"),
        ("wait there", "wait in the {p}"),
    ],
)
def test_they_mean_those_of_the_question_before(
    said: str, order: str, place: tuple[str, str]
) -> None:
    assert means(asked("Dad", place), said, order.format(p=place[0]))


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize(
    ("said", "order"),
    [
        ("如果他在，就告诉他吃饭了", "如果{p}有爸爸，就告诉他吃饭了"),
        ("要是不在就回来", "如果{p}没有爸爸，就回来"),
        ("跟他说吃饭了", "告诉{p}的爸爸吃饭了"),
        ("问问他要不要喝茶", "问问{p}的爸爸要不要喝茶"),
        ("去那里", "去{p}"),
    ],
)
def test_so_they_do_in_chinese(said: str, order: str, place: tuple[str, str]) -> None:
    book = asked("爸爸", place, chinese=True)
    assert means(book, said, order.format(p=place[1]))


@pytest.mark.parametrize(
    "said",
    [
        *(
            "tell her tea is ready",
            "tell him and tell her tea is ready",
            "if he is hungry, come back",
        ),
        *("Anna said to tell him tea is ready", "go there or come back"),
    ][:4],
)
def test_in_doubt_it_stays_as_it_was_said(said: str) -> None:
    assert changed_by(asked("Dad", PLACES[1]), said) is None


def test_two_people_are_told_apart_by_nobody() -> None:
    book = book_after(GoTo(place="study"), text="are Tom and Peter in the study?")
    assert changed_by(book, "tell him tea is ready") is None


def test_an_order_that_speaks_of_nobody_between_changes_nothing() -> None:
    book = asked("Dad", PLACES[1])
    text = "go to the kitchen"
    two, _ = advance(book, Submitted("g1", text, parse(text).language), NOW_S)
    two, _ = advance(two, Planned("g1", StepPlan(steps=(GoTo(place="kitchen"),))), NOW_S)
    assert means(two, "tell him tea is ready", "tell Dad in the study tea is ready")
    assert changed_by(two, "if he is, come back") is None


def test_a_place_of_an_answer_is_none_that_a_person_named() -> None:
    book = book_after(Find(object="cup", place="kitchen"), text="an order")
    assert changed_by(book, "go there") is None


def test_long_ago_is_forgotten() -> None:
    book = asked("Dad", PLACES[1])
    said = "if he is, come back"
    assert changed_by(book, said, LEANS_S + 1.0) is None


TOLD = order_done("tell Mum tea is ready")
TOLD_ZH = order_done("去书房问小明要不要喝茶")


@pytest.mark.parametrize(
    "said", ["tell her again", "ok, ask her once more", "go back and tell her again, please"]
)
def test_who_is_told_again_hears_the_same(said: str) -> None:
    assert means(TOLD, said, "tell Mum tea is ready")
    assert changed_by(TOLD, said.replace("her", "him")) is None


@pytest.mark.parametrize("said", ["再问他一遍", "再跟他说一遍吧", "你再去问他一次"])
def test_so_it_is_in_chinese(said: str) -> None:
    assert means(TOLD_ZH, said, "去书房问小明要不要喝茶")
