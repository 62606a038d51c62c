"""A pronoun that leans on the goal before it means what naming the thing or the place means."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from planner.language.sentence import parse
from planner.mission.departure import LEANS_S
from planner.mission.events import Planned, Submitted
from planner.mission.reducer import advance
from planner.mission.skills import Eyesight
from planner.mission.state import MissionState
from planner.perception.snapshot import Sight
from planner.plan import Find, GoalState, GoTo, Patrol, Recall, StepPlan
from tests.planner.mission.leaning import FACTS, NOW_S, changed_by, means
from wire import CameraConfig

if TYPE_CHECKING:
    from planner.plan import Step

SEEING = MissionState(
    FACTS, eyes=Eyesight(CameraConfig(), ("cup", "book", "ball", "person")), sight=Sight()
)
THINGS, PLACES = ("cup", "book", "red ball"), (("kitchen", "厨房"), ("study", "书房"))
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


def book_after(*steps: Step, text: str = "an order") -> MissionState:
    book, _ = advance(SEEING, Submitted("g0", text, parse(text).language), NOW_S)
    book, _ = advance(book, Planned("g0", StepPlan(steps=steps)), NOW_S)
    return book


@pytest.mark.parametrize(("said", "order"), EN)
@pytest.mark.parametrize("thing", THINGS)
@pytest.mark.parametrize("article", ["", "the ", "my "])
@pytest.mark.parametrize("place", PLACES)
def test_a_pronoun_means_the_one_thing_or_place_of_the_last_order(
    said: str, order: str, thing: str, article: str, place: tuple[str, str]
) -> None:
    book = book_after(GoTo(place=place[0]), Find(object=article + thing, place=place[0]))
    assert means(book, said, order.format(t=thing, p=place[0]))


@pytest.mark.parametrize(("said", "order"), ZH)
@pytest.mark.parametrize("thing", ["杯子", "书"])
@pytest.mark.parametrize("place", PLACES)
def test_so_it_does_in_chinese(said: str, order: str, thing: str, place: tuple[str, str]) -> None:
    book = book_after(Find(object=thing, place=place[0]))
    assert means(book, said, order.format(t=thing, p=place[1]))


@pytest.mark.parametrize("said", [said for said, _ in EN + ZH])
def test_what_is_in_doubt_stays_as_it_was_said(said: str) -> None:
    two = book_after(
        Find(object="cup", place="study"), Find(object="ball", place="kitchen"),
        Find(object="球", place="kitchen"),
    )  # fmt: skip
    for book in (MissionState(FACTS), two, book_after(Recall(deeds=True))):
        assert changed_by(book, said) is None
    one = book_after(Find(object="cup", place="study"))
    assert changed_by(one, said, LEANS_S + 1.0) is None


@pytest.mark.parametrize("said", [said for said, _ in EN if said[:3] != "was" and " it" in said])
def test_a_thing_that_was_named_in_another_language_is_no_word_for_it(said: str) -> None:
    assert changed_by(book_after(Find(object="杯子")), said) is None


@pytest.mark.parametrize("said", LEFT)
def test_other_sentences_stay_as_they_are(said: str) -> None:
    book = book_after(Find(object="cup", place="study"))
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
    runs = book_after(Patrol(places=("kitchen", "study"), look=True))
    over = runs.missions["g0"].model_copy(update={"state": GoalState.SUCCEEDED})
    done = replace(runs, missions={"g0": over}, running=None)
    assert means(done, said, order)
    assert changed_by(runs, said) is None
    assert changed_by(book_after(GoTo(place="kitchen")), said) is None


@pytest.mark.parametrize(
    "said", ["who is there?", "is anybody there?", "did you see anybody there?"]
)
@pytest.mark.parametrize("state", [GoalState.AWAITING_CONFIRMATION, GoalState.CANCELLED])
def test_a_plan_that_nobody_asked_for_names_no_place(said: str, state: GoalState) -> None:
    book = book_after(GoTo(place="bathroom"), text="good morning")
    [last] = book.missions.values()
    kept = {last.id: last.model_copy(update={"state": state})}
    assert changed_by(replace(book, missions=kept), said, -NOW_S) is None
    own = {last.id: kept[last.id].model_copy(update={"text": "go to the bathroom"})}
    named = changed_by(replace(book, missions=own), said, -NOW_S)
    assert named is not None
    assert "bathroom" in named.words
