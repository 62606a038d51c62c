"""He, they and there mean whom and what the orders before spoke of, or stay as they were said."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.language.sentence import parse
from planner.mission.events import Planned, Submitted
from planner.mission.follow_up import LEANS_S
from planner.mission.reducer import advance
from planner.mission.state import MissionState
from planner.plan import Find, GoalState, GoTo, Look, Patrol, Recall, StepPlan
from tests.planner.mission.leaning import (
    FACTS,
    NOW_S,
    changed_by,
    means,
    newest,
    order_done,
    order_under_way,
)

THINGS, PLACES = ("cup", "the book", "my red ball"), (("kitchen", "厨房"), ("study", "书房"))
EN = (
    ("look for it", "look for the {t}"),
    ("ok, look for it in the bedroom", "ok, look for the {t} in the bedroom"),
    ("can you find it", "can you find the {t}"),
    ("well, go find her", "well, go find the {t}"),
    ("count them in the hallway", "count the {t} in the hallway"),
    ("now go up to it", "now go up to the {t}"),
    ("was it in the study?", "did you see the {t} in the study"),
    ("what did you see there?", "what did you see in the {p}"),
    ("was anybody there?", "was anybody in the {p}"),
    ("did you see anything over there", "did you see anything in the {p}"),
)
ZH = (
    ("去卧室找它", "去卧室找{t}"),
    ("帮我找一下它", "帮我找一下{t}"),
    ("再去玄关找找", "去玄关找{t}"),
    ("是在书房看到的吗", "你在书房看到过{t}吗"),
    ("你在那里看到什么了", "你在{p}看到什么了"),
)
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


@pytest.mark.parametrize("said", [said for said, _ in EN if said[:3] != "was" and " it" in said])
def test_a_thing_that_was_named_in_another_language_is_no_word_for_it(said: str) -> None:
    assert changed_by(order_under_way("an order", Find(object="杯子")), said) is None


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


@pytest.mark.parametrize(
    "said", ["who is there?", "is anybody there?", "did you see anybody there?"]
)
@pytest.mark.parametrize("state", [GoalState.AWAITING_CONFIRMATION, GoalState.CANCELLED])
def test_a_plan_that_nobody_asked_for_names_no_place(said: str, state: GoalState) -> None:
    book = order_under_way("good morning", GoTo(place="bathroom"))
    last = newest(book)
    kept = {last.id: last.model_copy(update={"state": state})}
    assert changed_by(replace(book, missions=kept), said, -NOW_S) is None
    own = {last.id: kept[last.id].model_copy(update={"text": "go to the bathroom"})}
    named = changed_by(replace(book, missions=own), said, -NOW_S)
    assert named is not None
    assert "bathroom" in named.words


def asked(who: str, place: tuple[str, str], *, chinese: bool = False) -> MissionState:
    text = f"{who}在{place[1]}吗" if chinese else f"is {who} in the {place[0]}?"
    look = Look(question=text.rstrip("?"), place=place[0])
    return order_under_way(text, GoTo(place=place[0]), look)


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
    ["tell her tea is ready", "tell him and tell her tea is ready", "if he is hungry, come back",
     "Anna said to tell him tea is ready"],
)  # fmt: skip
def test_in_doubt_it_stays_as_it_was_said(said: str) -> None:
    assert changed_by(asked("Dad", PLACES[1]), said) is None


def test_an_order_that_speaks_of_nobody_between_changes_nothing() -> None:
    book = asked("Dad", PLACES[1])
    text = "go to the kitchen"
    two, _ = advance(book, Submitted("g1", text, parse(text).language), NOW_S)
    two, _ = advance(two, Planned("g1", StepPlan(steps=(GoTo(place="kitchen"),))), NOW_S)
    assert means(two, "tell him tea is ready", "tell Dad in the study tea is ready")
    assert changed_by(two, "if he is, come back") is None


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
