"""What is ordered behind several places is done at each of them, or it is asked where."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from planner.language.grammar import Context, plan
from planner.plan import EVERY_KIND, Bilingual, Clarify, Code, Entry, Look, StepPlan, Vocabulary

EACH = {
    "go to the kitchen and the bedroom and count the chairs": (
        "kitchen count=chairs@kitchen bedroom count=chairs@bedroom"
    ),
    "visit the kitchen, the study and the bedroom, count the chairs and come back": (
        "kitchen count=chairs@kitchen study count=chairs@study"
        " bedroom count=chairs@bedroom come_back"
    ),
    "go to the kitchen and the bedroom, count the chairs and the cups and tell me": (
        "kitchen count=chairs@kitchen count=cups@kitchen"
        " bedroom count=chairs@bedroom count=cups@bedroom"
    ),
    "patrol the kitchen and the study and look around": (
        "kitchen look=look around@kitchen study look=look around@study"
    ),
    "去厨房和卧室数一下椅子": "kitchen count=椅子@kitchen bedroom count=椅子@bedroom",
    "去厨房和卧室看看有没有人": (
        "kitchen look=看看有没有人@kitchen bedroom look=看看有没有人@bedroom"
    ),
    "去厨房、书房和卧室数椅子然后回来": (
        "kitchen count=椅子@kitchen study count=椅子@study bedroom count=椅子@bedroom come_back"
    ),
    # one place after the other, each with its verb, is no list; nor is a way from place to place
    "go to the kitchen, then go to the bedroom and count the chairs": (
        "kitchen bedroom count=chairs@bedroom"
    ),
    "go from the kitchen to the bedroom and count the chairs": (
        "kitchen bedroom count=chairs@bedroom"
    ),
    "go to the kitchen and the bedroom and count the chairs in the study": (
        "kitchen bedroom study count=chairs@study"
    ),
    "先去厨房再去卧室数椅子": "kitchen bedroom count=椅子@bedroom",
    # two orders, each with its verb; or two things
    "find the cup in the kitchen and find the ball in the bedroom": (
        "kitchen find=cup@kitchen bedroom find=ball@bedroom"
    ),
    "find the cup and the ball": "find=cup find=ball",
    # all rooms are the home, which these steps search by themselves
    "go to every room and count the chairs": "count=chairs",
    "go to every room, count the chairs and come back": "count=chairs come_back",
    "visit every room and look for the cup": "find=cup",
    "patrol the house and look for people": "find=people",
    "search every room for the cup": "find=cup",
    "check every room for people": "find=people",
    "look for the cup in every room": "find=cup",
    "count the chairs in every room": "count=chairs",
    "去所有房间数椅子": "count=椅子",
    "去每个房间找杯子": "find=杯子",
    "在每个房间里找杯子": "find=杯子",
    "检查所有房间有几把椅子": "count=椅子",
    "数一下所有房间的椅子": "count=椅子",
}
EVERY_ROOM = (
    "look in every room",
    "visit every room and tell me if anybody is there",
    "检查每个房间有没有人",
    "去每个房间看看",
    "每个房间都看看有没有人",
)
ASKED = {
    "go to the kitchen and the bedroom and find the cup": (
        "find the cup in the kitchen", "find the cup in the bedroom", "find the cup",
    ),
    "patrol the kitchen and the study and look for people": (
        "find the people in the kitchen", "find the people in the study", "find the people",
    ),
    "find the cup in the kitchen and in the bedroom and come back": (
        "find the cup in the kitchen, then come back",
        "find the cup in the bedroom, then come back",
        "find the cup, then come back",
    ),
    "find the cup in the kitchen and the bedroom": (
        "find the cup in the kitchen", "find the cup in the bedroom", "find the cup",
    ),
    "去厨房和卧室找杯子": ("去厨房找杯子", "去卧室找杯子", "找杯子"),
}  # fmt: skip


@pytest.mark.parametrize(("text", "steps"), EACH.items())
def test_what_follows_several_places_is_done_at_each(
    text: str, steps: str, understood: Callable[[str], str]
) -> None:
    assert understood(text) == steps


@pytest.mark.parametrize("text", EVERY_ROOM)
def test_every_room_is_looked_in(text: str, home: Vocabulary) -> None:
    made = plan(text, home, Context(runnable=EVERY_KIND))
    assert isinstance(made, StepPlan)
    looked = [step.place for step in made.steps if isinstance(step, Look)]
    assert looked == [entry.id for entry in home.entries if entry.kind == "room"]


@pytest.mark.parametrize("text", EVERY_ROOM)
def test_more_rooms_than_a_plan_holds_are_asked_about(text: str) -> None:
    rooms = (
        Entry(id=f"room_{at}", kind="room", name=Bilingual(en=f"room {at}", zh=f"第{at}间"))
        for at in range(11)
    )
    made = plan(text, Vocabulary(entries=tuple(rooms)), Context(runnable=EVERY_KIND))
    assert isinstance(made, Clarify)
    assert made.code is Code.INCOMPLETE


@pytest.mark.parametrize(("text", "options"), ASKED.items())
def test_a_search_of_some_rooms_is_asked_about(
    text: str, options: tuple[str, ...], home: Vocabulary
) -> None:
    """It would end in the first room that has none, and miss the others."""
    made = plan(text, home, Context(runnable=EVERY_KIND))
    assert isinstance(made, Clarify)
    assert made.code is Code.INCOMPLETE
    assert tuple(option.text for option in made.options) == options
    context = Context(runnable=EVERY_KIND)
    assert all(isinstance(plan(option, home, context), StepPlan) for option in options)
