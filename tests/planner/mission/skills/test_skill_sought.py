"""What a question asks for and by which neighbour: what eyes judge, and what they can't."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.language.questions import Relation
from planner.mission.skills import Wanted
from planner.mission.skills.object_query import FLOOR, Sought, sought_in
from planner.mission.state import SiteView, Target
from planner.plan import Bilingual
from tests.planner.mission.fakes import room
from wire import Pose2

CLASSES = ("person", "chair", "sofa", "table", "fridge", "box", "cup", "ball", "book")
ON, UNDER, NEAR = Relation
KITCHEN = replace(room("kitchen", 8.0), name=Bilingual(en="kitchen", zh="厨房"))
SOFA = Target("sofa", False, Bilingual(en="sofa", zh="沙发"), Pose2(4.0, 0.5, 0.0))
FRIDGE = Target("fridge", False, Bilingual(en="fridge", zh="冰箱"), Pose2(4.0, 0.5, 0.0))
HOME = SiteView({t.id: t for t in (KITCHEN, SOFA, FRIDGE)}, home="sofa")
CUP, TABLE, CHAIR = Wanted("cup"), Wanted("table"), Wanted("chair")


@pytest.mark.parametrize(
    ("question", "sought"),
    [
        ("is the cup on the table?", Sought(CUP, ON, TABLE)),
        (
            "Is there a red cup on top of the table now?",
            Sought(Wanted("cup", "red"), ON, TABLE),
        ),
        (
            "do you see a cup beneath the blue chair",
            Sought(CUP, UNDER, Wanted("chair", "blue")),
        ),
        ("check if the cup is next to the table", Sought(CUP, NEAR, TABLE)),
        ("is anybody sitting on the chair", Sought(Wanted("person"), ON, CHAIR)),
        ("what is on the table?", Sought(None, ON, TABLE)),
        ("who is on the chair", Sought(None, ON, CHAIR)),
        ("is there anything under the chair", Sought(None, UNDER, CHAIR)),
        ("is there a cup on the floor", Sought(CUP, ON, FLOOR)),
        ("桌子上有杯子吗", Sought(CUP, ON, TABLE)),
        ("看看桌上有没有红色的杯子", Sought(Wanted("cup", "red"), ON, TABLE)),
        ("杯子还在桌子上吗", Sought(CUP, ON, TABLE)),
        ("杯子是不是在椅子下面", Sought(CUP, UNDER, CHAIR)),
        ("看到椅子旁边的杯子了吗", Sought(CUP, NEAR, CHAIR)),
        ("有人在椅子上吗", Sought(Wanted("person"), ON, CHAIR)),
        ("椅子上坐着人吗", Sought(Wanted("person"), ON, CHAIR)),
        ("桌子上都有什么东西", Sought(None, ON, TABLE)),
        ("谁坐在椅子上", Sought(None, ON, CHAIR)),
        ("地上有没有杯子", Sought(CUP, ON, FLOOR)),
    ],
)
def test_a_neighbour_is_read_in_questions_of_both_languages(question: str, sought: Sought) -> None:
    assert sought_in(question, HOME, None, CLASSES) == sought


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
    assert sought_in(question, HOME, None, CLASSES) == Sought(CUP, unclear=unclear)


@pytest.mark.parametrize(
    ("question", "place", "sought"),
    [
        ("is there a cup in the kitchen", "kitchen", Sought(CUP)),
        ("is there a cup on the table in the kitchen", "kitchen", Sought(CUP, ON, TABLE)),
        ("厨房里有没有杯子", "kitchen", Sought(CUP)),
        ("厨房的桌子上有没有杯子", "kitchen", Sought(CUP, ON, TABLE)),
        ("杯子在厨房的桌子上吗", "kitchen", Sought(CUP, ON, TABLE)),
        ("is there a cup near the sofa", "sofa", Sought(CUP)),
        ("is there a cup on the sofa", "sofa", Sought(CUP, ON, Wanted("sofa"))),
        ("沙发旁边有杯子吗", "sofa", Sought(CUP)),
        ("沙发底下有没有杯子", "sofa", Sought(CUP, UNDER, Wanted("sofa"))),
        ("is there a cup in the fridge", "fridge", Sought(CUP, unclear="in the fridge")),
        ("is there a cup in front of you", None, Sought(CUP)),
        ("is there a cup in this room", None, Sought(CUP)),
        ("这里有没有杯子", None, Sought(CUP)),
        ("你面前有没有杯子", None, Sought(CUP)),
        ("what is in the kitchen?", "kitchen", Sought()),
        ("what do you see?", None, Sought()),
    ],
)
def test_a_place_to_look_in_is_no_neighbour(
    question: str, place: str | None, sought: Sought
) -> None:
    assert sought_in(question, HOME, place, CLASSES) == sought
