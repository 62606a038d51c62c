"""The offline brain drives up to what eyes know, where it is no place of the site."""

from __future__ import annotations

import pytest

from planner.language.grammar.context import Context
from planner.language.grammar.parser import plan
from planner.plan import (
    EVERY_KIND,
    Clarify,
    Code,
    Count,
    Find,
    GoTo,
    GoToObject,
    Look,
    Step,
    StepPlan,
    Vocabulary,
)

WHOLE = Context(runnable=EVERY_KIND)
THINGS = {
    "go to the red chair": ("red chair", None),
    "drive up to the box in the study": ("box", "study"),
    "去红色的椅子那里": ("红色的椅子", None),
    "开到客厅里的箱子旁边": ("箱子", "living_room"),
}


@pytest.mark.parametrize(("text", "thing"), THINGS.items(), ids=ascii)
def test_what_eyes_know_is_driven_up_to_though_it_is_no_place(
    text: str, thing: tuple[str, str | None], home: Vocabulary
) -> None:
    sees = Context(runnable=EVERY_KIND, things=frozenset({"chair", "box", "椅子", "箱子"}))
    label, place = thing
    assert plan(text, home, sees) == StepPlan(steps=(GoToObject(object=label, place=place),))
    for blind in (Context(runnable=EVERY_KIND), Context(things=sees.things)):
        made = plan(text, home, blind)
        assert isinstance(made, Clarify)
        assert made.code in (Code.UNKNOWN_PLACE, Code.NOT_UNDERSTOOD)


BESIDE = {
    "go to the box beside the chair": GoToObject(object="box beside the chair"),
    "go to the cup on the desk": GoToObject(object="cup on the desk", place="desk"),
    "drive to the cup on the chair in the study": (
        GoToObject(object="cup on the chair", place="study")
    ),
    "find the cup next to the chair": Find(object="cup next to the chair"),
    "find the cup on the chair": Find(object="cup on the chair"),
    "find the box under the chair in the study": Find(object="box under the chair", place="study"),
    "count the cups on the chair": Count(object="cups on the chair"),
    "椅子上有几本书": Count(object="椅子上的书"),
    "数一数椅子上放着多少本红色的书": Count(object="椅子上的红色的书"),
    "椅子旁边的箱子一共有几个": Count(object="椅子旁边的箱子"),
    "有几个箱子在椅子下面": Count(object="椅子下面的箱子"),
    "厨房里的椅子上坐着几个人": Count(object="椅子上的人", place="kitchen"),
    "去厨房看看椅子上有几本书": Count(object="椅子上的书", place="kitchen"),
    "所有椅子上一共有几本书": Count(object="所有椅子上的书"),
    "椅子上有没有书": Look(question="椅子上有没有书"),
    "箱子在椅子下面吗？": Look(question="箱子在椅子下面吗"),
    "厨房的椅子上有杯子吗": Look(question="厨房的椅子上有杯子吗", place="kitchen"),
    "椅子上有书？": Look(question="椅子上有书"),
    "椅子上有什么": Look(question="椅子上有什么"),
    "谁坐在椅子上": Look(question="谁坐在椅子上"),
    "去椅子旁边的箱子那里": GoToObject(object="椅子旁边的箱子"),
    "去书桌上的箱子那里": GoToObject(object="书桌上的箱子", place="desk"),
    "找椅子旁边的箱子": Find(object="椅子旁边的箱子"),
    "找床下面的箱子": Find(object="床下面的箱子", place="bed"),
}


@pytest.mark.parametrize(("text", "step"), BESIDE.items(), ids=ascii)
def test_a_thing_may_be_told_by_its_neighbour(text: str, step: Step, home: Vocabulary) -> None:
    things = frozenset({"chair", "box", "cup", "desk", "bed", "椅子", "箱子", "书桌", "床"})
    made = plan(text, home, Context(runnable=EVERY_KIND, things=things))
    assert isinstance(made, StepPlan), made
    assert made.steps[-1] == step


JOINED = {
    "找杯子和球": ("杯子", "球"),
    "到处找找红色的杯子与一个球": ("红色的杯子", "球"),
    "找杯子以及毯子和球": ("杯子", "毯子", "球"),
    "找暖和的毯子": ("暖和的毯子",),
    "找和平鸽": ("和平鸽",),
    "找杯子和和平鸽": ("杯子和和平鸽",),
    "找杯子和暖和的毯子": ("杯子和暖和的毯子",),
    "找红色和蓝色的球": ("红色和蓝色的球",),
    "去厨房找杯子和球": ("杯子", "球"),
    "去厨房找暖和的毯子": ("暖和的毯子",),
}


@pytest.mark.parametrize(("text", "sought"), JOINED.items(), ids=ascii)
def test_only_things_that_eyes_know_are_sought_one_after_the_other(
    text: str, sought: tuple[str, ...], home: Vocabulary
) -> None:
    known = frozenset({"cup", "杯子", "球", "毯子"})
    made = plan(text, home, Context(runnable=EVERY_KIND, things=known))
    assert isinstance(made, StepPlan), made
    finds = [step for step in made.steps if isinstance(step, Find)]
    assert tuple(step.object for step in finds) == sought


@pytest.mark.parametrize(
    "text",
    [
        "go to the garage", "find a cup near the chair", "去猫窝", "去月球", "去台球那里",
        "楼上有几个人", "书架上有几本书", "网上有多少人", "晚上有几个人", "手上有书吗",
        "月球上有没有人",
        "每把椅子上有几本书", "椅子旁边的桌子上有几本书", "椅子上有几本书和几个杯子", "椅子有几把",
        "椅子上有书", "椅子上没有书", "在椅子上放几本书", "如果椅子上有书就回来", "椅子上有几点",
        "书桌上有几个杯子", "沙发旁边有几个人", "床下面有没有球", "有几把椅子",
    ],
)  # fmt: skip
def test_what_is_no_thing_or_asks_for_more_than_that_is_read_as_before(
    text: str, home: Vocabulary
) -> None:
    known = frozenset({"chair", "cup", "球", "椅子", "书", "沙发", "床", "书桌"})
    sees = Context(runnable=EVERY_KIND, things=known)
    assert plan(text, home, sees) == plan(text, home, WHOLE)


UP_TO_SOMEBODY = {
    "go to the person": ("person", None),
    "face the person": ("person", None),
    "approach the person in the kitchen": ("person", "kitchen"),
    "走到人面前": ("人", None),
    "去厨房的人那里": ("人", "kitchen"),
}


@pytest.mark.parametrize(("text", "thing"), UP_TO_SOMEBODY.items(), ids=ascii)
def test_somebody_is_driven_up_to_alike_in_both_languages(
    text: str, thing: tuple[str, str | None], home: Vocabulary
) -> None:
    sees = Context(runnable=EVERY_KIND, things=frozenset({"person", "人"}))
    label, place = thing
    assert plan(text, home, sees) == StepPlan(steps=(GoToObject(object=label, place=place),))


def test_who_is_only_named_is_looked_for_where_the_sentence_says(home: Vocabulary) -> None:
    sees = Context(runnable=EVERY_KIND, things=frozenset({"person", "人"}))
    steps = (GoTo(place="kitchen"), Find(object="Mary", place="kitchen"))
    assert plan("go to Mary in the kitchen", home, sees) == StepPlan(steps=steps)


def test_everybody_that_eyes_know_is_not_one_person(home: Vocabulary) -> None:
    sees = Context(runnable=EVERY_KIND, things=frozenset({"person", "people", "人"}))
    made = plan("go to all the people in the kitchen", home, sees)
    assert isinstance(made, Clarify)
    assert made.code is Code.INCOMPLETE
