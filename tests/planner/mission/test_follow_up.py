"""What leans on the goal before it means what a person means, and cancels nothing by chance."""

from __future__ import annotations

from typing import Any

import pytest

from planner.brain.offline_brain import TAG
from planner.language.sentence import parse
from planner.mission.departure import LEANS_S
from planner.mission.events import Planned, Submitted
from planner.mission.reception import receive
from planner.mission.reducer import advance
from planner.mission.skills import Eyesight
from planner.mission.state import Mission, MissionState
from planner.perception.snapshot import Sight
from planner.plan import (
    ChangedOrder,
    Clarify,
    Code,
    Count,
    Find,
    GoTo,
    Language,
    Option,
    StepPlan,
    say_same,
)
from tests.planner.mission.leaning import FACTS, NOW_S, changed_by, means, order_under_way
from wire import CameraConfig


def book_after(*orders: tuple[str, str]) -> MissionState:
    """Return the book after these orders, each planned as a drive to a place."""
    book = MissionState(FACTS)
    for number, (text, place) in enumerate(orders):
        given = Submitted(f"g{number}", text, parse(text).language)
        book, _ = advance(book, given, NOW_S)
        plan = StepPlan(steps=(GoTo(place=place),))
        book, _ = advance(book, Planned(given.id, plan), NOW_S)
    return book


BEDROOM = book_after(("go to the bedroom", "bedroom"))
ZH = order_under_way("去卧室找我的杯子")
EITHER = book_after(("go to the kitchen or the study, whichever you like", "kitchen"))

MEANINGS = (
    (BEDROOM, "no, I meant the study", "go to the study"),
    (BEDROOM, "No, sorry, the study.", "go to the study"),
    (BEDROOM, "oh no, I meant the study, sorry", "go to the study"),
    (ZH, "不是不是，是书房", "去书房找我的杯子"),
    (BEDROOM, "no I meant the study", "go to the study"),
    (BEDROOM, "No, the study!", "go to the study"),
    (BEDROOM, "not the bedroom, the study", "go to the study"),
    (BEDROOM, "sorry, I meant the kitchen", "go to the kitchen"),
    (BEDROOM, "不对，书房", "go to the study"),
    (BEDROOM, "哦不好意思，我说的是书房", "go to the study"),
    (BEDROOM, "对不起，不对，去书房", "去书房"),
    (BEDROOM, "and then the kitchen too", "go to the kitchen"),
    (BEDROOM, "the kitchen as well", "go to the kitchen"),
    (BEDROOM, "and then come back", "come back"),
    (BEDROOM, "again", "go to the bedroom"),
    (BEDROOM, "do that twice more", "go to the bedroom 2 times"),
    (BEDROOM, "three more times", "go to the bedroom 3 times"),
    (BEDROOM, "no no, the study", "go to the study"),
    (BEDROOM, "hmm no, try the study first", "go to the study"),
    (BEDROOM, "I meant the kitchen, go there", "go to the kitchen"),
    (BEDROOM, "oh wait, the kitchen I mean", "go to the kitchen"),
    (BEDROOM, "not there, by the desk", "go to the desk"),
    (BEDROOM, "and then on to the kitchen", "go to the kitchen"),
    (BEDROOM, "and the kitchen?", "go to the kitchen"),
    (BEDROOM, "and then have a look in the study", "have a look in the study"),
    (BEDROOM, "还是去厨房吧", "去厨房"),
    (BEDROOM, "do that again, please", "go to the bedroom"),
    (BEDROOM, "再来一次", "go to the bedroom"),
    (ZH, "不对，书房", "去书房找我的杯子"),
    (ZH, "不是卧室，是书房", "去书房找我的杯子"),
    (ZH, "还有厨房", "去厨房找我的杯子"),
    (ZH, "然后再去厨房", "去厨房"),
    (ZH, "again", "去卧室找我的杯子"),
    (ZH, "再找两次", "去卧室找我的杯子2次"),
    (ZH, "哎不是，我说的是书房", "去书房找我的杯子"),
    (ZH, "不对，应该在书房", "去书房找我的杯子"),
    (ZH, "哎等等，我是说书房", "去书房找我的杯子"),
    (ZH, "不是那儿，是书房那边", "去书房找我的杯子"),
    (ZH, "找完再去客厅看看", "去客厅看看"),
    (ZH, "巡逻完了就回家", "回家"),
    (EITHER, "the other one", "go to the study"),
    (EITHER, "no, the other one", "go to the study"),
    (EITHER, "另一个", "go to the study"),
)


@pytest.mark.parametrize(("book", "text", "order"), MEANINGS)
def test_a_sentence_means_what_it_leans_on(book: MissionState, text: str, order: str) -> None:
    assert means(book, text, order)


@pytest.mark.parametrize(("book", "text", "order"), MEANINGS)
@pytest.mark.parametrize("frame", ["{}", " {} ", "{}.", "um, {}", "{}!!"])
def test_courtesy_and_noise_change_nothing(
    frame: str, book: MissionState, text: str, order: str
) -> None:
    assert means(book, frame.format(text), order)


@pytest.mark.parametrize("text", [text for book, text, _ in MEANINGS if book is EITHER])
def test_what_is_in_doubt_stays_as_it_was_said(text: str) -> None:
    assert changed_by(BEDROOM, text) is None
    assert changed_by(MissionState(FACTS), text) is None


@pytest.mark.parametrize("text", ["again", "do that again", "再来一次", "the other one"])
def test_what_was_long_ago_is_not_meant(text: str) -> None:
    assert changed_by(EITHER, text, LEANS_S + 1.0) is None


@pytest.mark.parametrize(
    "text",
    [
        "no, the dinner is ready",
        "no, not yet",
        "no",
        "no, that's fine",
        "and you?",
        "me too",
        "不，我很好",
        "不是的",
        "不好意思",
        "不好意思，我很好",
        "不好意思，去书房",
        "say hello again",
        "go to the kitchen; if you can't get in, wait in the hallway instead",
        "if the door is open, go to the study instead",
        "go to the kitchen or, if you can't, to the study instead",
        "如果进不去就改去书房",
        "no, if it rains",
    ],
)
def test_what_is_no_correction_takes_nothing_back(text: str) -> None:
    assert changed_by(BEDROOM, text) is None
    heard = receive(BEDROOM, parse(text), Submitted("new", text, Language.EN), NOW_S)
    assert heard.takes_back is None
    assert (heard.given.first, heard.given.replace) == (False, False)


@pytest.mark.parametrize(("text", "ends"), [
    ("no, I meant the study", True), ("不对，书房", True), ("forget that, go home", True),
    ("哦不好意思，我说的是书房", True),
    ("and then the kitchen too", False), ("again", False), ("还有厨房", False),
])  # fmt: skip
def test_a_correction_ends_what_runs_and_an_addition_waits_for_it(text: str, ends: bool) -> None:
    heard = receive(BEDROOM, parse(text), Submitted("new", text, Language.EN), NOW_S)
    assert (heard.takes_back == "g0") is ends
    assert heard.given.first is (text != "again")


def test_the_goal_keeps_both_what_was_said_and_what_it_means() -> None:
    given = receive(BEDROOM, parse("again"), Submitted("g9", "again", Language.EN), NOW_S).given
    book, effects = advance(BEDROOM, given, NOW_S)
    kept: Mission = book.missions["g9"]
    assert (kept.text, kept.words) == ("again", "again")
    asks: list[Any] = [each for each in effects if type(each).__name__ == "AskBrain"]
    assert [(each.text, each.changed) for each in asks] == [("again", given.changed)]
    assert given.changed == ChangedOrder(steps=(GoTo(place="bedroom"),))


def rounds() -> MissionState:
    """Return the book while the robot is on its way to three rooms."""
    given = Submitted("g0", "go to the bedroom, the bathroom and the hallway", Language.EN)
    book, _ = advance(BARE, given, NOW_S)
    steps = (GoTo(place="bedroom"), GoTo(place="bathroom"), GoTo(place="hallway"))
    return advance(book, Planned("g0", StepPlan(steps=steps)), NOW_S)[0]


BARE = MissionState(FACTS)


@pytest.mark.parametrize(
    ("text", "left"),
    [("skip the bathroom", "go to the bedroom, then go to the hallway"),
     ("leave the bedroom out", "go to the bathroom, then go to the hallway"),
     ("skip the kitchen", "skip the kitchen"),
     ("you can leave out the bathroom", "go to the bedroom, then go to the hallway"),
     ("except the bathroom", "go to the bedroom, then go to the hallway"),
     ("except my dog", "except my dog"),
     ("跳过卫生间，有人在洗澡", "go to the bedroom, then go to the hallway"),
     ("厨房别进去", "厨房别进去"),
     ("除了卫生间", "go to the bedroom, then go to the hallway"),
     ("跳过卫生间", "go to the bedroom, then go to the hallway")],
)  # fmt: skip
def test_a_place_is_left_out_of_what_is_still_to_do(text: str, left: str) -> None:
    assert means(rounds(), text, left) if left != text else changed_by(rounds(), text) is None
    heard = receive(rounds(), parse(text), Submitted("new", text, Language.EN), NOW_S)
    assert (heard.takes_back == "g0") is (left != text)


@pytest.mark.parametrize("text", ["厨房别进去", "别进厨房", "不要进去", "别去厨房"])
def test_a_denial_that_leaves_no_place_out_stops(text: str) -> None:
    thinking, _ = advance(BARE, Submitted("g0", "把所有房间都转一圈", Language.ZH), NOW_S)
    heard = receive(thinking, parse(text), Submitted("new", text, Language.ZH), NOW_S)
    assert (heard.stops, heard.takes_back) == (True, None)


def test_who_has_one_place_to_go_to_leaves_none_out() -> None:
    assert changed_by(BEDROOM, "skip the bedroom") is None
    assert changed_by(BARE, "skip the bedroom") is None


ROUNDS = (
    (Count(object="chairs", place="kitchen"), Count(object="chairs", place="bedroom")),
    (Find(object="red cup"),),
)
ROUNDS_ZH = tuple(Count(object="椅子", place=place) for place in ("kitchen", "living_room"))
ASKED = ("and in the study?", "what about the study?", "and the study?")
ASKED_ZH = ("书房呢", "那书房里呢")


@pytest.mark.parametrize(
    ("steps", "text", "order"),
    [
        (
            ROUNDS[0],
            "count the chairs in the kitchen and the bedroom",
            "count the chairs in the {}",
        ),
        (ROUNDS[1], "find my red cup", "look for the red cup in the {}"),
    ],
)
@pytest.mark.parametrize("asked", ASKED)
def test_what_was_looked_for_is_asked_of_one_more_place(
    steps: tuple[Any, ...], text: str, order: str, asked: str
) -> None:
    assert means(book_of_looks(steps, text), asked, order.format("study"))


@pytest.mark.parametrize(
    ("steps", "text", "order"),
    [
        (ROUNDS_ZH, "去厨房和客厅数椅子", "数一下{}的椅子"),
        ((Find(object="红杯子"),), "找红杯子", "去{}找红杯子"),
    ],
)
@pytest.mark.parametrize("asked", ASKED_ZH)
def test_so_it_is_in_chinese(steps: tuple[Any, ...], text: str, order: str, asked: str) -> None:
    assert means(book_of_looks(steps, text), asked, order.format("书房"))


def book_of_looks(steps: tuple[Any, ...], text: str) -> MissionState:
    """Return the book after an order that looks for something."""
    book = MissionState(FACTS, eyes=Eyesight(CameraConfig(), ("cup", "chair")), sight=Sight())
    book, _ = advance(book, Submitted("g0", text, parse(text).language), NOW_S)
    book, _ = advance(book, Planned("g0", StepPlan(steps=steps)), NOW_S)
    return book


@pytest.mark.parametrize("said", ["the second one", "the study, please", "the study"])
def test_an_order_that_a_question_offers_is_chosen_aloud(said: str) -> None:
    book = MissionState(FACTS)
    text = "go to the kitchen or the study"
    book, _ = advance(book, Submitted("g0", text, Language.EN), NOW_S)
    options = tuple(Option(text=f"go to the {place}", label=say_same(f"go to the {place}"))
                    for place in ("kitchen", "study"))  # fmt: skip
    asks = Clarify(code=Code.AMBIGUOUS, question=say_same("Which one?"), options=options)
    book, _ = advance(book, Planned("g0", asks, None, TAG), NOW_S)
    assert means(book, said, "go to the study")
    assert changed_by(book, "the third one") is None


def test_a_correction_of_a_search_without_a_place_narrows_it() -> None:
    search = book_of_looks((Find(object="red cup"),), "find my red cup")
    assert means(search, "no, the study", "look for the red cup in the study")
