"""Questions about standing orders, and those that are about something else."""

from __future__ import annotations

import pytest

from planner.language.schedule import ListOrders, read_order_command
from planner.language.schedule.parts import OnceDay

TODAY, TOMORROW = OnceDay(ahead=0), OnceDay(ahead=1)
LEFT = ListOrders(next_runs=True, is_sure=False)


@pytest.mark.parametrize(
    ("text", "asked"),
    [
        ("How long have I got left?", LEFT), ("how much time is left?", LEFT),
        ("how long is left on my reminder?", ListOrders(reminders=True, next_runs=True)),
        ("when is my reminder?", ListOrders(reminders=True, next_runs=True)),
        ("when will you remind me?", ListOrders(reminders=True, next_runs=True)),
        ("what time is the pill reminder?", ListOrders("pill", reminders=True, next_runs=True)),
        ("what have I asked you to do every evening?", ListOrders("every evening")),
        ("what did I tell you to do on weekdays?", ListOrders("weekdays")),
        ("what have I asked you to do?", ListOrders()),
        ("what do you do every day?", ListOrders()),
        ("what's on for tomorrow?", ListOrders(day=TOMORROW)),
        ("do I have anything tomorrow?", ListOrders(day=TOMORROW)),
        ("what are you going to do today?", ListOrders(day=TODAY)),
        ("what's planned for Friday?", ListOrders(day=OnceDay(weekday=4))),
        ("what have I got you down to do every day?", ListOrders()),
        ("any reminders set for tomorrow?", ListOrders(day=TOMORROW)),
        ("have I got any reminders today", ListOrders(day=TODAY)),
        ("what jobs have I given you", ListOrders()),
        ("我都给你安排了哪些事，念一遍", ListOrders()), ("我都让你记着哪些事儿了", ListOrders()),
        ("还有多久？", LEFT), ("还剩多少时间", LEFT),
        ("Which orders have I given you that you still keep?", ListOrders()),
        ("What have I got you doing every day at the moment?", ListOrders()),
        ("what do you do for me every morning?", ListOrders("every morning")),
        ("我的提醒是几点？", ListOrders(reminders=True, next_runs=True)),
        ("吃药的提醒是几点", ListOrders("吃药", reminders=True, next_runs=True)),
        ("几点提醒我吃药", ListOrders("吃药", reminders=True, next_runs=True)),
        ("明天有什么安排", ListOrders(day=TOMORROW)), ("明天有安排吗", ListOrders(day=TOMORROW)),
        ("你今天要做什么", ListOrders(day=TODAY)), ("我让你每天晚上做什么", ListOrders("每天晚上")),
        ("你每天都做什么", ListOrders()),
    ],
)  # fmt: skip
def test_a_question_about_orders_is_read(text: str, asked: ListOrders) -> None:
    assert read_order_command(text) == asked


@pytest.mark.parametrize(
    "text",
    ["what is on the table?", "how long did you wait?", "when did you see the cup?",
     "what's on the floor",
     "how long is the hallway", "what will you do in the kitchen?", "when will you come back?",
     "what happened yesterday evening at eight", "what have you seen today?",
     "还有多久到", "厨房有什么",
     "今天有没有人来过", "你今天去过哪些地方", "你在做什么", "房间里有什么"],
)  # fmt: skip
def test_a_question_about_something_else_is_not(text: str) -> None:
    assert not isinstance(read_order_command(text), ListOrders)


@pytest.mark.parametrize("tail", ["", " at the moment", " for me", " right now"])
@pytest.mark.parametrize(
    "text",
    ["what have I got you doing every day", "which orders have I given you that you still keep",
     "which jobs are you still keeping", "can you tell me what you've got planned",
     "what are you supposed to be doing every day", "which reminders are you keeping"],
)  # fmt: skip
def test_what_is_kept_is_told_however_it_is_asked(text: str, tail: str) -> None:
    assert read_order_command(f"{text}{tail}?") == ListOrders()


@pytest.mark.parametrize("text", ["when do I have to take my pills?", "what time must I eat?"])
def test_when_something_is_to_be_done_is_asked_of_what_is_kept(text: str) -> None:
    command = read_order_command(text)
    assert isinstance(command, ListOrders)
    assert command.next_runs
    assert not command.is_sure


@pytest.mark.parametrize(
    "text",
    [
        "你现在手里都有哪些定时的活儿？给我念念。",
        "有哪些事情是你每天要做的？讲给我听听。",
        "我之前让你定时做的事都有啥",
        "现在还有几个提醒没响？",
        "帮我看看设了什么闹钟",
        "你都记着哪些事要提醒我的？",
        "把定好的任务都报一遍",
        "现在有啥定时任务在跑？",
        "看看还有什么提醒",
        "给我列一下都有哪些定时",
        "我给你定的规矩都有哪些",
    ],
)
def test_a_list_is_asked_for_in_many_words_in_chinese(text: str) -> None:
    assert read_order_command(text) == ListOrders()


def test_a_list_of_one_day_is_of_that_day() -> None:
    assert read_order_command("明天你要提醒我啥？") == ListOrders(day=OnceDay(ahead=1))
    assert read_order_command("周六都有什么提醒") == ListOrders(day=OnceDay(weekday=5))


@pytest.mark.parametrize(
    "text",
    [
        "今天你提醒了我什么？",
        "你提醒过我什么",
        "去看看任务",
        "告诉我有什么事",
        "你看看桌上有什么",
        "提醒我看看闹钟",
        "看看闹钟在不在桌上",
        "你每天做了什么",
    ],
)
def test_what_is_over_and_what_is_looked_at_is_no_list(text: str) -> None:
    assert not isinstance(read_order_command(text), ListOrders)
