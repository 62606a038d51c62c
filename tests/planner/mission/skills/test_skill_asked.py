"""Which questions ask for one kind of thing that the eyes don't know, and what comes of them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner.mission.skills import DriveLeg, Eyesight, Fail, Observe, act_of
from planner.mission.skills.object_query import unknown_kind
from planner.perception.snapshot import LookSnapshot, Sight
from planner.plan import Bilingual, Code, Language
from planner.site.site_view import SiteView, Target
from tests.planner.mission.fakes import FACTS, room
from tests.planner.mission.skills.scenes import scene
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
        assert act.said is not None
        assert "“piano”" in act.said.en
        assert "fridge" in act.said.en
        assert "冰箱" in act.said.zh
