"""He, they and there mean whom and what the orders before spoke of, or stay as they were said."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.mission.follow_up import LEANS_S
from planner.mission.state import MissionState
from planner.plan import Find, GoalState, GoTo, Look, Patrol, Recall
from tests.planner.mission.leaning import (
    FACTS,
    changed_by,
    means,
    order_done,
    order_under_way,
)

THINGS, PLACES = ("cup", "the book", "my red ball"), (("kitchen", "厨房"), ("study", "书房"))
EN = (("was it in the study?", "did you see the {t} in the study"),)
ZH = (("再去玄关找找", "去玄关找{t}"), ("是在书房看到的吗", "你在书房看到过{t}吗"))
LEFT = (
    *("find it and bring it to me", "is it raining", "go there", "say it"),
    *("look for the key and find it", "what time is it there", "去那里", "找到球了", "它在哪"),
)


@pytest.mark.parametrize(("said", "order"), EN)
@pytest.mark.parametrize("thing", THINGS)
@pytest.mark.parametrize("place", PLACES)
def test_a_pronoun_means_the_one_thing_or_place_of_the_last_order(
    said: str, order: str, thing: str, place: tuple[str, str]
) -> None:
    book = order_under_way("an order", GoTo(place=place[0]), Find(object=thing, place=place[0]))
    assert means(
        book, said, order.format(t=thing.removeprefix("the ").removeprefix("my "), p=place[0])
    )


@pytest.mark.parametrize(("said", "order"), ZH)
@pytest.mark.parametrize("thing", ["杯子", "书"])
@pytest.mark.parametrize("place", PLACES)
def test_so_it_does_in_chinese(said: str, order: str, thing: str, place: tuple[str, str]) -> None:
    book = order_under_way("an order", Find(object=thing, place=place[0]))
    assert means(book, said, order.format(t=thing, p=place[1]))


@pytest.mark.parametrize("said", [said for said, _ in EN + ZH])
def test_what_is_in_doubt_stays_as_it_was_said(said: str) -> None:
    two = order_under_way("an order",
        Find(object="cup", place="study"), Find(object="ball", place="kitchen"),
        Find(object="球", place="kitchen"),
    )  # fmt: skip
    for book in (MissionState(FACTS), two, order_under_way("an order", Recall(deeds=True))):
        assert changed_by(book, said) is None
    one = order_under_way("an order", Find(object="cup", place="study"))
    assert changed_by(one, said, LEANS_S + 1.0) is None


@pytest.mark.parametrize("said", LEFT)
def test_other_sentences_stay_as_they_are(said: str) -> None:
    book = order_under_way("an order", Find(object="cup", place="study"))
    assert changed_by(book, said) is None


@pytest.mark.parametrize(
    ("said", "order"),
    [
        ("see anyone?", "did you see anyone"),
        ("so, seen anything odd?", "did you see anything odd"),
        ("spot any cups?", "did you see any cups"),
        ("看到人了吗", "你看到过人吗"),
        ("刚才看见猫没有", "你看到过猫吗"),
        ("有没有看到什么", "你看到过什么吗"),
    ],
)
def test_what_was_seen_is_asked_once_a_look_is_over_and_never_before(said: str, order: str) -> None:
    runs = order_under_way("an order", Patrol(places=("kitchen", "study"), look=True))
    over = runs.missions["g0"].model_copy(update={"state": GoalState.SUCCEEDED})
    done = replace(runs, missions={"g0": over}, running=None)
    assert means(done, said, order)
    assert changed_by(runs, said) is None
    assert changed_by(order_under_way("an order", GoTo(place="kitchen")), said) is None


def asked(who: str, place: tuple[str, str], *, chinese: bool = False) -> MissionState:
    text = f"{who}在{place[1]}吗" if chinese else f"is {who} in the {place[0]}?"
    look = Look(question=text.rstrip("?"), place=place[0])
    return order_under_way(text, GoTo(place=place[0]), look)


@pytest.mark.parametrize(
    "said",
    ["tell her tea is ready", "tell him and tell her tea is ready", "if he is hungry, come back",
     "Anna said to tell him tea is ready"],
)  # fmt: skip
def test_in_doubt_it_stays_as_it_was_said(said: str) -> None:
    assert changed_by(asked("Dad", PLACES[1]), said) is None


def test_of_two_people_a_place_of_an_answer_and_what_was_long_ago_nothing_is_meant() -> None:
    two = order_under_way("are Tom and Peter in the study?", GoTo(place="study"))
    assert changed_by(two, "tell him tea is ready") is None
    found = order_under_way("an order", Find(object="cup", place="kitchen"))
    assert changed_by(found, "go there") is None
    assert changed_by(asked("Dad", PLACES[1]), "if he is, come back", LEANS_S + 1.0) is None


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
