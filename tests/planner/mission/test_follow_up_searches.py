"""A look is repeated, asked of another thing, or narrowed to where somebody or something is."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians
from typing import Any

import pytest

from planner.mission.follow_up import LEANS_S
from planner.mission.state import MissionState
from planner.plan import (
    ChangedOrder,
    Count,
    Find,
    GoalState,
    GoTo,
    GoToObject,
    Look,
    MoveStraight,
    Say,
    Turn,
)
from tests.planner.mission.fakes import status
from tests.planner.mission.leaning import (
    changed_by,
    each,
    heard,
    means,
    newest,
    order_asked_about,
    order_done,
    order_under_way,
    steps_after,
)
from wire import Pose2


def order_in_vain(text: str) -> MissionState:
    """Return the book once a search is over that found nothing."""
    book = order_done(text)
    failed = newest(book).model_copy(update={"state": GoalState.FAILED})
    return replace(book, missions={"g0": failed})


COUNT = "count the cups in the kitchen"
COUNTED = order_done(COUNT, GoTo(place="kitchen"), Count(object="cups", place="kitchen"))
COUNT_ZH = "去厨房数一下瓶子"
COUNTED_ZH = order_done(COUNT_ZH, GoTo(place="kitchen"), Count(object="瓶子", place="kitchen"))
BOTH = order_done(
    "count the cups in the kitchen and the study",
    Count(object="cups", place="kitchen"),
    Count(object="cups", place="study"),
)
SEEKING = order_under_way(
    "go to the kitchen and look for a bottle",
    GoTo(place="kitchen"),
    Find(object="bottle", place="kitchen"),
)
CHAIR = order_done("find a chair", Find(object="chair"))
CHAIR_ZH = order_done("帮我找椅子", Find(object="椅子"))
TOLD = order_done("tell Nan good night", Say(text="Nan, good night"))
LOOKED = order_done("look around the kitchen", Look(question="look", place="kitchen"))
DRIVE = order_done("go to the kitchen", GoTo(place="kitchen"))
CUP, CUP_ZH = order_under_way("look for a cup"), order_under_way("帮我找个杯子")
NO_CUP = order_in_vain("look for a cup in the bedroom")
NO_CUP_ZH = order_in_vain("去卧室找杯子")
FOUND = order_done("look for a cup in the bedroom")
MUM = order_asked_about("tell Mum that tea is ready")
MUM_ZH = order_asked_about("跟妈妈说饭好了")
HOME = order_asked_about("tell Mum I'm home")
HER = order_asked_about("tell her dinner is ready")
TEA, TEA_ZH = "tell Mum in the study that tea is ready", "跟书房的妈妈说饭好了"
STUDY, EVERYWHERE = "look for the cup in the study", "look for the cup in every room"


@pytest.mark.parametrize(
    ("book", "said", "order"),
    [
        # A look is taken once more.
        *each(COUNTED, COUNT, "are you sure? Count again", "count again please"),
        *each(COUNTED, COUNT, "can you recount them, please", "count them once more"),
        *each(COUNTED, COUNT, "look again, there must be more", "have another look"),
        (COUNTED, "have another look, I think you missed a bottle", COUNT),
        *each(COUNTED, COUNT, "go back and check again", "really? count them again"),
        *each(COUNTED, COUNT, "double-check that", "have another look, I think you missed one"),
        (COUNTED, "count again, there should be five of them", COUNT),
        *each(COUNTED_ZH, COUNT_ZH, "你确定吗？再数一遍", "再数一次"),
        *each(COUNTED_ZH, COUNT_ZH, "刚才那边再看一遍，应该不止吧", "重新数一下", "再看看"),
        *each(COUNTED_ZH, COUNT_ZH, "再数一遍呗，都过十分钟了", "我觉得不对，再数一遍"),
        # Another thing is looked for at the same place, of two places at neither.
        *each(COUNTED, "count the bottles in the kitchen", "and bottles?", "bottles too"),
        *each(COUNTED, "count the chairs in the kitchen", "And the chairs", "what about chairs?"),
        (SEEKING, "also look for a cup", "look for the cup in the kitchen"),
        (SEEKING, "look for a cup too while you're there", "look for the cup in the kitchen"),
        (SEEKING, "and a cup", "look for the cup in the kitchen"),
        *each(COUNTED_ZH, "去厨房数一下杯子", "杯子呢", "还有杯子"),
        (COUNTED_ZH, "顺便看看有没有杯子", "去厨房看看有没有杯子"),
        (BOTH, "and bottles?", None),
        # What was found or said is spoken of.
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
        # A drive looks at nothing.
        *each(DRIVE, None, "count again", "and bottles?", "what colour is it?"),
        (DRIVE, "say it again, louder", None),
        (LOOKED, "count again", None),
        # A guess narrows the search.
        *each(CUP_ZH, "去厨房找杯子", "厨房咯", "厨房", "应该在厨房吧", "可能在厨房", "我猜在厨房"),
        *each(CUP_ZH, "去厨房找杯子", "那试试厨房", "再去厨房看看，应该在那", "它在厨房"),
        *each(CUP, STUDY, "I think I left it in the study", "we had it in the study"),
        *each(FOUND, None, "I think I left it in the study", "we had it in the study"),
        # A search goes on elsewhere.
        (NO_CUP, "okay, try the hallway then", "look for the cup in the hallway"),
        *each(NO_CUP, STUDY, "have another look in the study", "it's not there, try the study"),
        *each(NO_CUP, STUDY, "nothing there? Try the study then.", "no luck, try the study"),
        (NO_CUP, "ok, then the study", STUDY),
        (CUP, "the living room, I guess, near the TV", "look for the cup near the tv"),
        *each(NO_CUP, EVERYWHERE, "I dunno, try all of them", "no idea, just look everywhere"),
        (NO_CUP, "try another room", EVERYWHERE),
        *each(NO_CUP_ZH, "到处找杯子", "再去别的房间找找看", "不知道，都找找看吧"),
        (NO_CUP_ZH, "那试试书房", "去书房找杯子"),
        (CUP, "then the study", None),
        (FOUND, "check the kitchen", None),
        # Where somebody is completes the order, whatever they do there.
        *each(MUM, TEA, "she's in the study, as usual", "She's in the study."),
        *each(MUM, TEA, "the study, I think", "try the study"),
        (MUM, "she'll be in the study, watching TV", TEA),
        *each(MUM, TEA, "she's probably working in the study", "in her study"),
        (HOME, "she's in the study", "tell Mum in the study I'm home"),
        *each(MUM_ZH, TEA_ZH, "她在书房", "在书房吧", "那你去书房看看，她应该在那", "书房咯"),
        # Only who was asked for is there, and whom the word fits.
        *each(MUM, None, "he's in the study", "Dad's in the study", "she's out"),
        (MUM, "she's not in the study", None),
        *each(HER, None, "Dad, he's in the study", "the cat, she's in the study", "Mum"),
    ],
)
def test_a_look_is_renewed_or_led_elsewhere(
    book: MissionState, said: str, order: str | None
) -> None:
    assert means(book, said, order)


@pytest.mark.parametrize(
    "said",
    [
        "the kitchen, probably",
        "probably the kitchen",
        "the kitchen",
        "in the kitchen I think",
        "I think it's in the kitchen",
        "it should be in the kitchen",
        "maybe try the kitchen",
        "I'd say the kitchen",
        "ok, try the kitchen again",
        "most likely in the kitchen, as always",
        "the kitchen, that's where I saw it last",
        "the kitchen, it's always in there",
        "you could look in the kitchen first",
        "have another look in the kitchen, it was there this morning",
    ],
)
def test_a_guess_narrows_the_search(said: str) -> None:
    assert means(CUP, said, "look for the cup in the kitchen")
    assert (heard(CUP, said).takes_back, heard(CUP, said).given.first) == ("g0", True)


def test_a_thing_besides_waits_for_what_runs() -> None:
    said = "oh and see if there's a cup as well"
    assert (heard(SEEKING, said).takes_back, heard(SEEKING, said).given.first) == (None, True)
    asks = Look(question="see if there is a cup", place="kitchen")
    assert changed_by(SEEKING, said) == ChangedOrder(steps=(GoTo(place="kitchen"), asks))


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


@pytest.mark.parametrize(
    "said",
    [
        *("the kitchen is dirty", "the kitchen or the study"),
        *("is it in the kitchen?", "it isn't in the kitchen", "I was in the kitchen"),
        *("go to the kitchen", "she's in the kitchen", "all of them are broken"),
        *("try the kitchen if the door is open", "everywhere is a mess", "I don't know"),
        *("all over", "probably", "I guess so", "it's in my hand"),
    ],
)
def test_another_sentence_narrows_nothing(said: str) -> None:
    assert changed_by(CUP, said) is None


@pytest.mark.parametrize(
    "said", ["厨房很脏", "厨房还是书房", "去厨房", "在厨房吗", "都行", "都好了", "都在吧"]
)
def test_nor_does_it_in_chinese(said: str) -> None:
    assert changed_by(CUP_ZH, said) is None


def test_a_drive_is_no_search_and_long_ago_is_forgotten() -> None:
    drive = order_under_way("go to the bedroom", GoTo(place="bedroom"))
    assert changed_by(drive, "the kitchen, probably") is None
    assert changed_by(CUP, "the kitchen, probably", LEANS_S + 1.0) is None


LEFT, AHEAD = Turn(angle_rad=pi / 2.0), MoveStraight(distance_m=0.2)


@pytest.mark.parametrize(
    "said",
    [
        "no, the other left!",
        "your other left! I meant right",
        "the other way",
        "wrong way!",
        "no, right!",
        "I meant right",
        "no, turn to the right, not left",
        "right, I meant",
        "that's the wrong way, dear, turn right",
    ],
)
def test_the_other_side_ends_where_the_right_turn_would_have(said: str) -> None:
    assert means(order_under_way("turn left", LEFT), said, "turn right by 90 degrees")
    assert means(order_done("turn left", LEFT), said, "turn right by 180 degrees")


@pytest.mark.parametrize(
    "said", ["反了，右边！", "不对，是右边", "不对，往右", "另一边", "我说的是右边", "转反了"]
)
def test_so_it_ends_in_chinese(said: str) -> None:
    assert means(order_under_way("往左转", LEFT), said, "向右转90度")


def test_a_turn_under_way_is_undone_as_far_as_it_came() -> None:
    begun = order_under_way("turn left", LEFT)
    assert heard(begun, "no, the other left!").takes_back == "g0", "it comes in its place"
    last = newest(begun).model_copy(update={"accepted_at": (0.0, 0.0, 0.0)})
    here = status(base_in_map=Pose2(x_m=0.0, y_m=0.0, yaw_rad=radians(40.0)))
    [turn] = steps_after(replace(begun, missions={last.id: last}, status=here), "no, right!")
    assert isinstance(turn, Turn)
    assert turn.angle_rad == pytest.approx(radians(-130.0))


@pytest.mark.parametrize(
    ("step", "said", "order"),
    [
        (LEFT, "a bit more", "turn left by 30 degrees"),
        (LEFT, "too far, back a bit", "turn right by 30 degrees"),
        (LEFT, "that was too far, now turn back a little", "turn right by 30 degrees"),
        (MoveStraight(distance_m=-0.5), "too far, come forward a little", "move forward 20 cm"),
        (MoveStraight(distance_m=0.5), "another half metre", "move forward half a metre"),
        *each(LEFT, "向右转30度", "转多了，往回转一点", "多了多了，转回来一点"),
        (LEFT, "再转一点", "向左转30度"),
        *each(AHEAD, "move forward 20 cm", "bit more", "just a little further please", "closer"),
        (AHEAD, "back a bit", "move back 20 cm"),
        (MoveStraight(distance_m=-0.2), "a bit more", "move back 20 cm"),
        *each(AHEAD, "前进20厘米", "再来一点", "再近一点"),
        (GoToObject(object="cup"), "a bit closer", "move forward 20 cm"),
        # So much more is measured as the motion was.
        (AHEAD, "another 20 cm", "move forward 20 cm"),
        (MoveStraight(distance_m=-1.0), "another metre", "move back a metre"),
        (AHEAD, "再往前走一米", "前进一米"),
        *each(LEFT, "turn left by 30 degrees", "another 30 degrees", "a bit more to the left"),
        *each(LEFT, "向左转30度", "再转30度", "再左一点"),
        *each(LEFT, None, "another metre", "a bit more to the right", "再右一点"),
        *each(AHEAD, None, "another 30 degrees", "a bit more to the left"),
    ],
)
def test_a_motion_goes_on_or_back_a_little(step: Any, said: str, order: str | None) -> None:
    assert means(order_done("an order", step), said, order)


@pytest.mark.parametrize(
    "said",
    [
        *("no more", "no", "right", "that's right", "no, left", "not closer", "more?"),
        *("closer to the table", "a bit more tea", "don't go any further", "the other room"),
        *("不对", "不对，左边", "别再近了", "够了", "不要再转了", "好了"),
    ],
)
@pytest.mark.parametrize("step", [LEFT, AHEAD])
def test_another_sentence_moves_nothing(step: Any, said: str) -> None:
    assert steps_after(order_under_way("an order", step), said) == ()


@pytest.mark.parametrize("said", ["a bit more", "the other left", "再来一点", "反了"])
def test_nothing_is_adjusted_where_nothing_was_turned_or_moved(said: str) -> None:
    for steps in ((Find(object="cup"),), (LEFT, LEFT)):
        assert changed_by(order_under_way("an order", *steps), said) is None
