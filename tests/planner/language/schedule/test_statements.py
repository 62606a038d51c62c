"""A time in a statement of how things stand is no time of the order beside it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis.strategies import sampled_from

from planner.language.schedule import ScheduleCommand, read_order_command

ORDERS = sampled_from(
    (
        "go to the study", "Come with me as far as the bathroom", "find my keys",
        "check whether the door is closed", "tell Dad to come down",
    )
)  # fmt: skip
ASKED = sampled_from(("where are my keys", "Right, study please", "Keys, where are my keys"))
STATES = sampled_from(
    (
        "I'm on", "it's nearly", "the doctor's", "I'm a bit wobbly", "we're eating", "it's dark",
        "the guests come", "I have a call", "I've got to leave", "the meeting starts", "dad's home",
        "she's due", "I'll be out", "there's a call", "my train leaves",
    )
)  # fmt: skip
TIMES = sampled_from(
    ("at nine", "in two minutes", "noon", "this morning", "at 18:30", "tomorrow at 7")
)
JOINTS = sampled_from((", ", "; ", ". ", ", and ", ", because "))
ZH_ORDERS = sampled_from(("去书房", "陪我去卫生间", "帮我找钥匙", "看看门关了没"))
ZH_TIMES = sampled_from(("九点", "两分钟后", "下午三点半", "明天八点"))
ZH_STATES = sampled_from(("我要开会", "我们吃饭", "医生来", "就开会", "我就上场了"))


@given(ORDERS | ASKED, JOINTS, STATES, TIMES)
def test_a_time_behind_a_statement_is_no_time_of_the_order(
    order: str, joint: str, state: str, time: str
) -> None:
    for text in (f"{order}{joint}{state} {time}", f"{order}{joint}{state} {time}!".upper()):
        assert not isinstance(read_order_command(text), ScheduleCommand), text


@given(ORDERS, STATES, sampled_from(("at nine", "in two minutes", "at 18:30", "tomorrow at 7")))
def test_a_statement_without_a_time_leaves_the_orders_time_alone(
    order: str, state: str, time: str
) -> None:
    for text in (f"{order} {time}", f"{time} {order}", f"{time} {order}, {state}"):
        command = read_order_command(text)
        assert isinstance(command, ScheduleCommand), text
        assert command.when is not None
        assert command.order.startswith(order)


TOLD = sampled_from(("tell Dad dinner's ready", "let Mum know we're leaving", "say the bus leaves",
    "go to the study and tell Emma I'll be home", "tell the kids lunch is"))  # fmt: skip


@given(TOLD, sampled_from(("in five minutes", "at six", "in half an hour", "tomorrow at 7")))
def test_a_time_behind_words_for_somebody_is_theirs_and_one_before_them_the_orders(
    told: str, time: str
) -> None:
    assert not isinstance(read_order_command(f"{told} {time}"), ScheduleCommand)
    for text in (f"{time} {told}", f"{told} every day at six", f"every day {told} at six"):
        command = read_order_command(text)
        assert isinstance(command, ScheduleCommand), text
        assert command.when is not None
        assert command.order == told


@given(ORDERS, STATES)
def test_what_a_person_is_to_be_reminded_of_may_be_a_statement(order: str, state: str) -> None:
    command = read_order_command(f"remind me {state} at nine")
    assert isinstance(command, ScheduleCommand)
    assert command.reminder
    other = read_order_command(f"remind me to {order}, {state} at nine")
    assert not isinstance(other, ScheduleCommand) or other.problem == "order_time_missing"


@given(ZH_TIMES, ZH_STATES, ZH_ORDERS)
def test_a_chinese_statement_that_begins_with_a_time_keeps_it(
    time: str, state: str, order: str
) -> None:
    assert read_order_command(f"{time}{state}，{order}") is None
    for text in (f"{time}{order}", f"{time}{order}，{state}", f"每天八点{state}，{order}"):
        assert isinstance(read_order_command(text), ScheduleCommand), text


@pytest.mark.parametrize(
    "text",
    [
        "I declare, I've misplaced my heart pills and it's nearly noon.",
        "Keys, where are my keys, the doctor's at nine!",
        "Come with me as far as the bathroom, I'm a bit wobbly this morning.",
        "Right, study please, and quietly, I'm on in two minutes.",
        "Right study please and quietly I'm on in two minutes",
        "At nine the doctor comes, find my keys",
        "I have a tray, Sunday, half nine, you remind us: Mass is at ten.",
        "go to the study, breakfast starts at eight",
        "晚上十点，那个，每晚十点，去厨房",
        "at ten, you know, every evening at ten, go to the kitchen",
        "九点了，去厨房",
    ],
)
def test_how_things_stand_beside_an_order_makes_no_standing_order(text: str) -> None:
    assert read_order_command(text) is None


@pytest.mark.parametrize(
    ("text", "order"),
    [
        ("see if she's there at nine", "see if she's there"),
        ("go to the kitchen and the doctor's at nine", "go to the kitchen and the doctor's"),
        ("check the kitchen, the kid's room at nine", "check the kitchen, the kid's room"),
        ("it is time to go to the kitchen at nine", "go to the kitchen"),
        ("Hey, I'd like you to check the door at nine", "check the door"),
        ("tomorrow go to the study, I'm on at nine", "go to the study, I'm on"),
        ("九点我要你去厨房，看看窗户", "去厨房,看看窗户"),
        ("九点我要吃药，提醒我", "我要吃药,提醒我"),
    ],
)
def test_an_order_that_sounds_like_a_statement_keeps_its_time(text: str, order: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand)
    assert command.order == order


@given(ORDERS, sampled_from(("18:30", "nine", "half past six", "tomorrow")))
def test_the_time_until_which_somebody_waits_is_no_time_of_the_order(order: str, time: str) -> None:
    for text in (f"wait until {time}", f"{order} and wait till {time}", f"stay here until {time}"):
        assert not isinstance(read_order_command(text), ScheduleCommand), text


@pytest.mark.parametrize("words", ["he sees the doctor", "the film starts", "dinner is ready",
                                   "she has to leave"])  # fmt: skip
@pytest.mark.parametrize("told", ["remind him", "remind Tom in the study", "tell Emma",
                                  "let Emma know",
                                  "look for Noah in the kitchen and remind him"])  # fmt: skip
@pytest.mark.parametrize("time", ["at ten", "at half past eight", "tomorrow at nine"])
def test_the_time_of_what_somebody_is_told_is_not_the_orders(
    told: str, words: str, time: str
) -> None:
    for that in ("that ", ""):
        command = read_order_command(f"{told} {that}{words} {time}")
        assert not isinstance(command, ScheduleCommand), that
