"""Somebody waited for by name is anybody, told under the name; other events are asked about."""

from __future__ import annotations

import pytest

from planner.language.schedule import ScheduleCommand, read_order_command
from planner.plan.timing import EventRule, WorldEvent

COMES = EventRule(event=WorldEvent.PERSON_SEEN)


@pytest.mark.parametrize(
    ("text", "who", "order"),
    [
        ("When the kids come home, tell them there's pizza in the fridge.", "the kids",
         'say "Kids, there\'s pizza in the fridge"'),
        ("when Dad comes in, tell him dinner is in the oven", "Dad",
         'say "Dad, dinner is in the oven"'),
        ("when Tom gets home, tell him to call the bank", "Tom", 'say "Tom, please call the bank"'),
        ("when my husband comes in, say welcome home", "my husband", "say welcome home"),
        ("等爸爸回来了跟他说饭在锅里", "爸爸", "说“爸爸，饭在锅里”"),
        ("当孩子们回来的时候告诉他们冰箱里有披萨", "孩子们", "说“孩子们，冰箱里有披萨”"),
    ],
)  # fmt: skip
def test_anybody_is_told_under_the_name(text: str, who: str, order: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand)
    assert (command.when, command.who, command.order) == (COMES, who, order)


@pytest.mark.parametrize(
    ("text", "offer"),
    [
        ("if you see anybody in the hallway at night, let me know",
         "when you see somebody at night, say I see somebody"),
        ("whenever you see somebody in the kitchen, tell me",
         "when you see somebody, say I see somebody"),
        ("要是看到阿婆一个人去门口，马上跟我讲", "看到人的时候，说我看到有人了"),
        ("看见孩子进厨房就跟他说小心烫", "看到人的时候，说小心烫"),
    ],
)  # fmt: skip
def test_the_nearest_event_is_offered_and_is_one(text: str, offer: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand)
    assert (command.when, command.problem, command.offer) == (None, "order_event_place", offer)
    offered = read_order_command(offer)
    assert isinstance(offered, ScheduleCommand)
    assert isinstance(offered.when, EventRule)


def test_what_nothing_can_tell_is_refused_as_an_event() -> None:
    text = "whenever you see a backpack in the hallway tell the kids to put it away"
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand)
    assert (command.when, command.problem) == (None, "order_no_event")


@pytest.mark.parametrize(
    "text",
    ["when Dad comes in, go to the kitchen", "when it comes in, say hello",
     "when dinner comes in, tell them", "when he comes, tell him dinner is ready",
     "if you see anybody in the kitchen, let me know", "whenever you are ready go to the kitchen",
     "when you get to the kitchen say hello", "the kids come home at four", "如果看到猫就告诉我",
     "孩子们回来了", "爸爸回来了去厨房", "等爸爸回来就去厨房"],
)  # fmt: skip
def test_what_drives_or_names_nobody_waits_for_none(text: str) -> None:
    command = read_order_command(text)
    assert not (isinstance(command, ScheduleCommand) and (command.who or command.problem))


@pytest.mark.parametrize(
    ("plain", "excepting", "cron"),
    [
        ("every day at seven in the morning say good morning", ", but not at weekends", "1-5"),
        ("every day at seven in the morning say good morning", ", not on Sundays", "1,2,3,4,5,6"),
        ("每天早上七点说早上好", "，周末就不要了", "1-5"),
    ],
)  # fmt: skip
def test_days_are_left_out_of_a_new_order(plain: str, excepting: str, cron: str) -> None:
    command, less = read_order_command(plain), read_order_command(plain + excepting)
    assert isinstance(command, ScheduleCommand)
    assert isinstance(less, ScheduleCommand)
    assert less.order == command.order
    assert less.when is not None
    assert less.when.model_dump() == {"kind": "cron", "cron": f"0 7 * * {cron}"}


@pytest.mark.parametrize("way", ["in the front door", "through the door", "to the door", "home"])
def test_the_way_in_is_part_of_the_event(way: str) -> None:
    command = read_order_command(f"when someone comes {way}, say hi")
    assert isinstance(command, ScheduleCommand)
    assert (command.when, command.order) == (COMES, "say hi")


@pytest.mark.parametrize("place", ["in the kitchen", "into the study", "near the sofa"])
def test_somebody_who_comes_elsewhere_is_no_event_and_no_drive_there(place: str) -> None:
    command = read_order_command(f"when somebody comes {place}, say hi")
    assert not isinstance(command, ScheduleCommand) or command.when is None


@pytest.mark.parametrize("way", ["从大门", "从门口", "从外面", ""])
@pytest.mark.parametrize("opens", ["只要", "每次", "以后只要", "当"])
def test_the_way_in_is_part_of_the_event_in_chinese(opens: str, way: str) -> None:
    command = read_order_command(f"{opens}有人{way}进来，你就说“记得换鞋”")
    assert isinstance(command, ScheduleCommand)
    assert command.when == EventRule(event=WorldEvent.PERSON_SEEN)
    assert command.order == "说“记得换鞋”"


@pytest.mark.parametrize("text", ["有人从卧室出来就说早上好", "门口有人就说你好"])
def test_another_place_and_a_state_are_no_such_event(text: str) -> None:
    assert not isinstance(read_order_command(text), ScheduleCommand)


@pytest.mark.parametrize("comes", ["我一进门就", "每次我回家，你就", "我下班回家的时候"])
@pytest.mark.parametrize("says", ["说“辛苦啦”", "跟我说辛苦啦", "对我说一声“辛苦啦”"])
def test_whoever_comes_is_greeted_for_me(comes: str, says: str) -> None:
    command = read_order_command(comes + says)
    assert isinstance(command, ScheduleCommand)
    assert (command.who, command.order) == ("您", "说“辛苦啦”")


@pytest.mark.parametrize(
    "text",
    [
        "我回来了，说一下今天的情况", "等我回来告诉我今天有没有人来过", "我一进门就说今天有谁来过",
        "我进门之后去充电", "我一回来就跟我说奶奶在哪",
    ],
)  # fmt: skip
def test_my_coming_once_and_a_question_are_no_standing_order(text: str) -> None:
    assert not isinstance(read_order_command(text), ScheduleCommand)
