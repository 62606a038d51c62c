"""A look is repeated, asked of another thing, or of the thing that was found."""

from __future__ import annotations

import pytest

from planner.language.sentence import parse
from planner.mission.events import Submitted
from planner.mission.reception import receive
from planner.mission.state import MissionState
from planner.plan import ChangedOrder, Count, Find, GoTo, Language, Look, Say
from tests.planner.mission.leaning import NOW_S, changed_by, means, order_done, order_under_way

COUNT = "count the cups in the kitchen"
COUNTED = order_done(COUNT, GoTo(place="kitchen"), Count(object="cups", place="kitchen"))
SEEKING = order_under_way(
    "go to the kitchen and look for a bottle",
    GoTo(place="kitchen"),
    Find(object="bottle", place="kitchen"),
)
COUNT_ZH = "去厨房数一下瓶子"
COUNTED_ZH = order_done(COUNT_ZH, GoTo(place="kitchen"), Count(object="瓶子", place="kitchen"))
CHAIR = order_done("find a chair", Find(object="chair"))
CHAIR_ZH = order_done("帮我找椅子", Find(object="椅子"))
TOLD = order_done("tell Nan good night", Say(text="Nan, good night"))


@pytest.mark.parametrize(
    "said",
    [
        "are you sure? Count again",
        "count again please",
        "can you recount them, please",
        "count them once more",
        "look again, there must be more",
        "have another look",
        "have another look, I think you missed a bottle",
        "go back and check again",
        "really? count them again",
        "double-check that",
        "have another look, I think you missed one",
        "count again, there should be five of them",
    ],
)
def test_a_look_is_taken_once_more(said: str) -> None:
    assert means(COUNTED, said, COUNT)


@pytest.mark.parametrize(
    "said",
    [
        "你确定吗？再数一遍",
        "再数一次",
        "刚才那边再看一遍，应该不止吧",
        "重新数一下",
        "再看看",
        "再数一遍呗，都过十分钟了",
        "我觉得不对，再数一遍",
    ],
)
def test_so_it_is_in_chinese(said: str) -> None:
    assert means(COUNTED_ZH, said, COUNT_ZH)


@pytest.mark.parametrize(
    ("book", "said", "order"),
    [
        (COUNTED, "and bottles?", "count the bottles in the kitchen"),
        (COUNTED, "And the chairs", "count the chairs in the kitchen"),
        (COUNTED, "what about chairs?", "count the chairs in the kitchen"),
        (COUNTED, "bottles too", "count the bottles in the kitchen"),
        (SEEKING, "also look for a cup", "look for the cup in the kitchen"),
        (SEEKING, "look for a cup too while you're there", "look for the cup in the kitchen"),
        (SEEKING, "and a cup", "look for the cup in the kitchen"),
        (COUNTED_ZH, "杯子呢", "去厨房数一下杯子"),
        (COUNTED_ZH, "顺便看看有没有杯子", "去厨房看看有没有杯子"),
        (COUNTED_ZH, "还有杯子", "去厨房数一下杯子"),
    ],
)
def test_another_thing_is_looked_for_at_the_same_place(
    book: MissionState, said: str, order: str
) -> None:
    assert means(book, said, order)


def test_a_thing_besides_waits_for_what_runs() -> None:
    said = "oh and see if there's a cup as well"
    heard = receive(SEEKING, parse(said), Submitted("new", said, Language.EN), NOW_S)
    assert (heard.takes_back, heard.given.first) == (None, True)


@pytest.mark.parametrize(
    ("book", "said", "order"),
    [
        (CHAIR, "go to the one in the kitchen", "go to the chair in the kitchen"),
        (CHAIR, "what colour is it?", "what colour is the chair"),
        (CHAIR, "what does it look like?", "what does the chair look like"),
        (CHAIR_ZH, "去厨房那把", "去厨房的椅子那里"),
        (CHAIR_ZH, "什么颜色的", "看看椅子是什么颜色的"),
        (TOLD, "say it again, louder, she's a bit deaf", 'say "Nan, good night"'),
        (TOLD, "and again, louder", 'say "Nan, good night"'),
        (TOLD, "she didn't hear you, say it again", 'say "Nan, good night"'),
        (TOLD, "say it twice more", 'say "Nan, good night" and then say "Nan, good night"'),
        (TOLD, "她没听见，再讲两遍", "说“Nan, good night”，再说“Nan, good night”"),
        (TOLD, "再说一遍，大声点", "说“Nan, good night”"),
    ],
)
def test_what_was_found_or_said_is_spoken_of(book: MissionState, said: str, order: str) -> None:
    assert means(book, said, order)


@pytest.mark.parametrize(
    "said",
    [
        *("and thanks", "and you?", "and the weather?", "and the time?", "cups are nice"),
        *("count again if the light is on", "count again, but go to the study"),
        *("再数一遍，如果灯开着", "再数一遍，先去书房"),
        *("are you sure?", "don't count again", "look for a cup", "and then?", "and why?"),
        *("and the dinner is ready", "go to the one", "what colour do you like?", "louder"),
        *("天气呢", "你呢", "确定吗", "别再数了", "什么颜色好看"),
    ],
)
def test_another_sentence_repeats_nothing(said: str) -> None:
    assert changed_by(COUNTED, said) is None
    assert changed_by(COUNTED_ZH, said) is None


def test_a_look_besides_asks_whether_the_thing_is_there() -> None:
    asks = Look(question="see if there is a cup", place="kitchen")
    changed = changed_by(SEEKING, "oh and see if there's a cup as well")
    assert changed == ChangedOrder(steps=(GoTo(place="kitchen"), asks))


def test_two_places_are_told_apart_by_nobody() -> None:
    steps = (Count(object="cups", place="kitchen"), Count(object="cups", place="study"))
    both = order_done("count the cups in the kitchen and the study", *steps)
    assert changed_by(both, "and bottles?") is None


def test_a_drive_looks_at_nothing() -> None:
    drive = order_done("go to the kitchen", GoTo(place="kitchen"))
    for said in ("count again", "and bottles?", "what colour is it?", "say it again, louder"):
        assert changed_by(drive, said) is None
    looked = order_done("look around the kitchen", Look(question="look", place="kitchen"))
    assert changed_by(looked, "count again") is None
