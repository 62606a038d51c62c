"""What a question asks for and by which neighbour: what eyes know and judge, and what not."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner.language.questions import Relation
from planner.perception.snapshot import LookSnapshot, Sight
from planner.plan import Bilingual, Code, Language
from planner.site.site_view import SiteView, Target
from planner.skills import DriveLeg, Eyesight, Fail, Observe, act_of
from planner.skills.object_matching import anybody_for
from planner.skills.object_query import FLOOR, ObjectQuery, sought_in, unknown_kind
from planner.skills.perception import WantedObject
from tests.planner.mission.fakes import FACTS, room
from tests.planner.skills.scenes import said_of, scene
from wire import CameraConfig, Pose2

CLASSES = ("person", "chair", "sofa", "table", "tv", "fridge", "plant", "box", "cup", "book")
STUDY = replace(room("study", 8.0), name=Bilingual(en="study", zh="书房"), aliases=("den",))
FRIDGE = Target("fridge", False, Bilingual(en="fridge", zh="冰箱"), Pose2(4.0, 0.5, 0.0))
HOME = SiteView({**FACTS.targets, "study": STUDY, "fridge": FRIDGE}, home="dock")


@pytest.mark.parametrize(
    ("question", "kind"),
    [
        ("do you see a piano?", "piano"),
        ("Is there a grand piano in the kitchen?", "grand piano"),
        ("is there any milk in the fridge", "milk"),
        ("are there keys left on the table?", "keys"),
        ("Check if there is a red guitar next to the sofa.", "red guitar"),
        ("go and see whether there is a washing machine", "washing machine"),
        ("is there a cat", "cat"),
        ("is my phone on the desk?", "phone"),
        ("有没有钢琴？", "钢琴"),
        ("书房有钢琴吗", "钢琴"),
        ("去看看厨房里有没有打印机", "打印机"),
        ("冰箱里有没有牛奶", "牛奶"),
        ("有没有烤箱", "烤箱"),
        ("你有没有看到一架红色的钢琴", "红色的钢琴"),
        ("看到窗户了吗", "窗户"),
        ("我的手机在沙发上吗", "手机"),
        ("猫在不在", "猫"),
    ],
)
def test_a_question_about_one_kind_that_is_not_known_is_told_apart(
    question: str, kind: str
) -> None:
    for language in Language:
        assert unknown_kind(question, HOME, language, CLASSES) == kind
        assert unknown_kind(question, HOME, language, ()) is None, "not known yet what they know"


@pytest.mark.parametrize(
    "question",
    [
        "what do you see?", "what is on the piano", "how many pianos are there", "look around",
        "is it tidy?", "is there a problem?", "is there anything on the table", "is there enough",
        "are there any toys on the floor", "is there a light on", "is there a window open",
        "is the window open", "is the oven on", "is there a lot going on",
        "is there a piano or a cup", "do you see what I mean", "do you see Mary?",
        "do you see my mother", "can you see well", "do you see the study", "do you see the den",
        "do you see Mary next to the sofa?",
        "is there a person in a red shirt", "is there a stranger at the door", "do you see anyone",
        "is there a red cup on the table",
        "is there a piano" + " in a" * 60,
        "看看周围", "看到了什么", "有什么", "厨房怎么样", "有没有人", "有没有人在弹钢琴",
        "看到小明了吗", "看到王小明了吗", "妈妈在不在厨房", "有没有问题", "有没有东西",
        "有没有吃的", "有没有宠物", "有没有下雨", "有没有开灯", "有没有收拾", "窗户有没有关好",
        "门有没有锁", "书房的灯亮着吗",
        "冰箱有没有电", "电视有没有声音", "冰箱关好了没有", "钢琴是什么颜色的", "有几架钢琴",
        "厨房里有没有红色的杯子", "看到杯子了吗",
    ],
)  # fmt: skip
def test_whatever_else_is_asked_is_looked_at(question: str) -> None:
    for language in Language:
        assert unknown_kind(question, HOME, language, CLASSES) is None


PIANO, OPEN = "is there a piano in the kitchen?", "what is there?"
SEEING = Eyesight(CameraConfig(), CLASSES)
PICTURE = Sight(LookSnapshot(1, 0.0, Pose2(0.0, 0.0, 0.0), 320, 240, ()))


@pytest.mark.parametrize(
    ("question", "eyes", "moves"),
    [
        (PIANO, SEEING, False),
        (OPEN, SEEING, True),
        (PIANO, replace(SEEING, model=True), True),
        (PIANO, replace(SEEING, classes=(*CLASSES, "piano")), True),
        (PIANO, replace(SEEING, classes=()), True),
    ],
)
def test_a_look_for_what_no_eye_here_knows_ends_with_what_they_know(
    question: str, eyes: Eyesight, moves: bool
) -> None:
    step: dict[str, Any] = {"text": question, "place": "kitchen"}
    act = act_of(scene("look", step=step, eyes=eyes, sight=PICTURE, facts=HOME))
    assert isinstance(act, (DriveLeg, Observe)) is moves
    if isinstance(act, Fail):
        assert act.code is Code.OBJECT_UNKNOWN
        assert "“piano”" in said_of(act).en
        assert "fridge" in said_of(act).en
        assert "冰箱" in said_of(act).zh


KINDS = ("person", "chair", "sofa", "table", "fridge", "box", "cup", "ball", "book")
ON, UNDER, NEAR = Relation
KITCHEN = replace(room("kitchen", 8.0), name=Bilingual(en="kitchen", zh="厨房"))
SOFA = Target("sofa", False, Bilingual(en="sofa", zh="沙发"), Pose2(4.0, 0.5, 0.0))
FURNISHED = SiteView({t.id: t for t in (KITCHEN, SOFA, FRIDGE)}, home="sofa")
CUP, TABLE, CHAIR = WantedObject("cup"), WantedObject("table"), WantedObject("chair")
RED_CUP, BLUE_CHAIR = WantedObject("cup", "red"), WantedObject("chair", "blue")
PERSON, SOFA_KIND = WantedObject("person"), WantedObject("sofa")


@pytest.mark.parametrize(
    ("question", "sought"),
    [
        ("is the cup on the table?", ObjectQuery(CUP, ON, TABLE)),
        ("Is there a red cup on top of the table now?", ObjectQuery(RED_CUP, ON, TABLE)),
        ("do you see a cup beneath the blue chair", ObjectQuery(CUP, UNDER, BLUE_CHAIR)),
        ("check if the cup is next to the table", ObjectQuery(CUP, NEAR, TABLE)),
        ("is anybody sitting on the chair", ObjectQuery(PERSON, ON, CHAIR)),
        ("what is on the table?", ObjectQuery(None, ON, TABLE)),
        ("who is on the chair", ObjectQuery(None, ON, CHAIR)),
        ("is there anything under the chair", ObjectQuery(None, UNDER, CHAIR)),
        ("is there a cup on the floor", ObjectQuery(CUP, ON, FLOOR)),
        ("桌子上有杯子吗", ObjectQuery(CUP, ON, TABLE)),
        ("看看桌上有没有红色的杯子", ObjectQuery(RED_CUP, ON, TABLE)),
        ("杯子还在桌子上吗", ObjectQuery(CUP, ON, TABLE)),
        ("杯子是不是在椅子下面", ObjectQuery(CUP, UNDER, CHAIR)),
        ("看到椅子旁边的杯子了吗", ObjectQuery(CUP, NEAR, CHAIR)),
        ("有人在椅子上吗", ObjectQuery(PERSON, ON, CHAIR)),
        ("椅子上坐着人吗", ObjectQuery(PERSON, ON, CHAIR)),
        ("桌子上都有什么东西", ObjectQuery(None, ON, TABLE)),
        ("谁坐在椅子上", ObjectQuery(None, ON, CHAIR)),
        ("地上有没有杯子", ObjectQuery(CUP, ON, FLOOR)),
    ],
)
def test_a_neighbour_is_read_in_questions_of_both_languages(
    question: str, sought: ObjectQuery
) -> None:
    assert sought_in(question, FURNISHED, None, KINDS) == sought


@pytest.mark.parametrize(
    ("question", "unclear"),
    [
        ("is there a cup on the shelf", "on the shelf"),
        ("is the cup on the small table", "on the small table"),
        ("is there a cup in the box", "in the box"),
        ("is there a cup behind the chair?", "behind the chair"),
        ("is there a cup on the table or on the chair", "on the table or on the chair"),
        ("is the cup by the window in this room", "by the window"),
        ("书架上有没有杯子", "书架上"),
        ("箱子里有没有杯子", "箱子里"),
        ("小桌子上有杯子吗", "小桌子上"),
    ],
)
def test_what_no_eye_here_can_judge_keeps_its_words(question: str, unclear: str) -> None:
    assert sought_in(question, FURNISHED, None, KINDS) == ObjectQuery(CUP, unclear=unclear)


@pytest.mark.parametrize(
    ("question", "place", "sought"),
    [
        ("is there a cup in the kitchen", "kitchen", ObjectQuery(CUP)),
        ("is there a cup on the table in the kitchen", "kitchen", ObjectQuery(CUP, ON, TABLE)),
        ("厨房里有没有杯子", "kitchen", ObjectQuery(CUP)),
        ("厨房的桌子上有没有杯子", "kitchen", ObjectQuery(CUP, ON, TABLE)),
        ("杯子在厨房的桌子上吗", "kitchen", ObjectQuery(CUP, ON, TABLE)),
        ("is there a cup near the sofa", "sofa", ObjectQuery(CUP)),
        ("is there a cup on the sofa", "sofa", ObjectQuery(CUP, ON, SOFA_KIND)),
        ("沙发旁边有杯子吗", "sofa", ObjectQuery(CUP)),
        ("沙发底下有没有杯子", "sofa", ObjectQuery(CUP, UNDER, SOFA_KIND)),
        ("is there a cup in the fridge", "fridge", ObjectQuery(CUP, unclear="in the fridge")),
        ("is there a cup in front of you", None, ObjectQuery(CUP)),
        ("is there a cup in this room", None, ObjectQuery(CUP)),
        ("这里有没有杯子", None, ObjectQuery(CUP)),
        ("你面前有没有杯子", None, ObjectQuery(CUP)),
        ("what is in the kitchen?", "kitchen", ObjectQuery()),
        ("what do you see?", None, ObjectQuery()),
    ],
)
def test_a_place_to_look_in_is_no_neighbour(
    question: str, place: str | None, sought: ObjectQuery
) -> None:
    assert sought_in(question, FURNISHED, place, KINDS) == sought


@pytest.mark.parametrize("name", ["Dad", "Anna", "my mum", "奶奶", "爸爸"])
def test_a_name_is_searched_for_as_anybody(name: str) -> None:
    """Nobody is recognised: who is found is told as a person, and is never followed by a name."""
    assert anybody_for(name, KINDS) == PERSON
    assert anybody_for(name, ("cup",)) is None
    assert anybody_for(f"{name} cup", KINDS) is None


@pytest.mark.parametrize(
    "question",
    [
        "is the cup empty", "is the fridge door open", "is the sofa on in the kitchen",
        "is there an empty cup", "has somebody fallen?", "is anybody in the kitchen asleep?",
        "有人摔倒了吗", "冰箱关着吗", "人在睡觉吗", "餐桌收拾了吗",
    ],
)  # fmt: skip
def test_a_state_is_never_judged_by_presence(question: str) -> None:
    sought = sought_in(question, FURNISHED, None, KINDS)
    assert sought.what is None or not sought.is_presence or sought.unclear


@pytest.mark.parametrize(
    "question",
    [
        "is the man asleep on the sofa", "is anybody sitting on the floor", "is the man sitting",
        "check if the man is asleep on the sofa", "check if the cup is empty", "地上坐着人吗",
        "沙发上躺着人吗",
    ],
)  # fmt: skip
def test_a_posture_is_judged_by_what_is_sat_on_alone(question: str) -> None:
    assert not sought_in(question, FURNISHED, None, KINDS).is_presence


@pytest.mark.parametrize(
    "question",
    ["any shoes in the hallway?", "check if the shoes are on the table", "桌子上放着鞋吗"],
)
def test_a_kind_that_is_merely_named_in_passing_refuses_nothing(question: str) -> None:
    assert unknown_kind(question, FURNISHED, Language.EN, KINDS) is None
    assert unknown_kind(question, FURNISHED, Language.ZH, KINDS) is None
