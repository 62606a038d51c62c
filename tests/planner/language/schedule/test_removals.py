"""Standing orders are dropped in everyday words; what names none of them drops nothing."""

from __future__ import annotations

import pytest

from planner.language.schedule import ChangeOrders, ListOrders, read_order_command

ALL_REMINDERS = ("", True, True)


@pytest.mark.parametrize(
    ("text", "which", "reminders", "every"),
    [
        ("you can forget about the tablets reminder now", "tablets", True, False),
        ("you don't need to remind me about the pills anymore", "the pills", True, False),
        ("no need to remind me about the plumber", "the plumber", True, False),
        ("scrap the plumber one", "plumber", False, False),
        ("you know what, forget the welcome home thing", "welcome home", False, False),
        ("forget about the pill reminder in the morning", "pill in the morning", True, False),
        ("scrap all the reminders, the lot", *ALL_REMINDERS),
        ("forget all the things I told you to do every day", "every day", False, True),
        ("the pill reminder can go", "pill", True, False),
        ("晚上九点看门那个不要了", "晚上九点看门", False, False),
        ("周六早上七点那个叫起床的，给我取消了", "周六早上七点叫起床", False, False),
        ("早上叫我起床那个删了吧，放暑假了", "早上叫我起床", False, False),
        ("吃药那个提醒不要了，医生讲可以停了", "吃药", True, False),
        ("第一个删了", "第一", False, False), ("把第二条取消掉", "第二", False, False),
        ("把明早的闹钟取消了", "明早", False, False),
        ("所有提醒都给我取消掉", *ALL_REMINDERS), ("定的那些提醒全取消吧", *ALL_REMINDERS),
        ("以后不用再提醒我吃药了", "吃药", True, False),
    ],
)  # fmt: skip
def test_an_order_is_dropped(text: str, which: str, reminders: bool, every: bool) -> None:
    command = read_order_command(text)
    assert isinstance(command, ChangeOrders)
    assert command.act == "remove"
    assert (command.which, command.reminders, command.is_every) == (which, reminders, every)


@pytest.mark.parametrize(
    ("plain", "reason"),
    [
        ("cancel the tablets reminder", ", I've finished the course"),
        ("scrap the plumber one", ", he's been"), ("push it back an hour", ", I'm still at work"),
        ("把吃药的提醒取消", "，我已经好了"), ("改成八点吧", "，起不来"),
    ],
)  # fmt: skip
def test_a_reason_beside_it_changes_nothing(plain: str, reason: str) -> None:
    command = read_order_command(plain)
    assert command is not None
    assert read_order_command(plain + reason) == command


@pytest.mark.parametrize(
    "text",
    ["forget the kitchen", "drop the cup", "scrap that", "I don't need the cup any more",
     "you can forget about the kitchen now", "cancel the reminder or the alarm",
     "did you cancel the reminder?", "if it rains cancel the reminder",
     "cancel the reminder, then go to the kitchen", "厨房不要了", "这个不要了", "取消了吗",
     "提醒取消了没有", "要是下雨就把提醒取消了"],
)  # fmt: skip
def test_what_names_no_order_drops_none(text: str) -> None:
    assert not isinstance(read_order_command(text), ChangeOrders | ListOrders)


@pytest.mark.parametrize("text", ["晚上就别说了", "晚上别吵了", "晚上就不要到处跑了"])
def test_what_no_order_is_called_by_drops_none(text: str) -> None:
    assert not isinstance(read_order_command(text), ChangeOrders)


@pytest.mark.parametrize(
    ("text", "which"),
    [("forget the welcome home thing", "welcome home"), ("scrap that hello business", "hello"),
     ("that good morning business can go", "good morning"), ("cancel my wake-up call", "wake-up"),
     ("enough with the cat checks", "cat"), ("never mind the hello thing", "hello"),
     ("don't bother checking the door any more", "checking the door"),
     ("you can stop saying hello any more", "saying hello"),
     ("I don't want you to greet people any longer", "greet people"),
     ("you know what, forget the hello thing, it'll drive us mad", "hello")],
)  # fmt: skip
def test_what_people_call_an_order_drops_it_where_one_is_called_so(text: str, which: str) -> None:
    command = read_order_command(text)
    assert command == ChangeOrders("remove", which, is_sure=False)


def test_of_two_reminders_the_part_of_the_day_says_which() -> None:
    text = "forget about the pill reminder in the morning, the doctor's changed it"
    command = read_order_command(text)
    assert isinstance(command, ChangeOrders)
    assert (command.which, command.reminders) == ("pill in the morning", True)


@pytest.mark.parametrize("text", ["forget the kitchen", "drop the cup", "cancel the drive",
                                  "don't go to the kitchen", "don't bother", "stop saying hello",
                                  "forget the hello thing and go to the sofa",
                                  "don't check the door any more unless I ask"])  # fmt: skip
def test_what_may_be_about_now_drops_nothing(text: str) -> None:
    assert not isinstance(read_order_command(text), ChangeOrders)


@pytest.mark.parametrize(
    "text", ["你现在手里都有哪些定时的活儿？给我念念", "有哪些事情是你每天要做的？讲给我听听"]
)
def test_they_are_listed_and_read_out(text: str) -> None:
    assert isinstance(read_order_command(text), ListOrders)
