"""A reminder at a place is a drive and words to say there; more than that is left to be asked."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis.strategies import sampled_from

from planner.language.schedule import ScheduleCommand, read_order_command

TIMES = sampled_from(
    ("每天下午三点", "二十分钟后", "工作日晚上九点", "每周日早上八点", "明天中午十二点")
)
GOES = sampled_from(("到{}来", "去{}", "上{}", "来{}", "到{}那边"))
PLACES = sampled_from(("客厅", "书房", "卧室", "沙发", "冰箱旁边"))
REMINDS = sampled_from(("提醒我", "叫我", "喊我", "催我", "跟我说", "告诉我一声", "提醒一下我"))
WORDS = sampled_from(("吃降压药", "关火", "给奶奶打电话", "收衣服"))


def read(text: str) -> ScheduleCommand:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand), text
    return command


@given(TIMES, GOES, PLACES, REMINDS, WORDS, sampled_from(("", ",你", "请")))
def test_the_words_are_said_at_the_place(
    time: str, goes: str, place: str, reminds: str, words: str, polite: str
) -> None:
    command = read(f"{time}{polite}{goes.format(place)}{reminds}{words}")
    assert (command.order, command.reminder) == (f"去{place}，说“{words}”", None)
    assert command.when == read(f"{time}去客厅").when


@given(TIMES, PLACES, WORDS, sampled_from((",叫三遍", ",喊三声", ",说三次", "三遍")))
def test_how_often_is_kept(time: str, place: str, words: str, often: str) -> None:
    assert read(f"{time}去{place}叫我{words}{often}").order == f"去{place}，说“{words}”3遍"


@given(TIMES, PLACES, WORDS, sampled_from(("我去睡个午觉", "我老忘", "免得我忘了", "不然又忘了")))
def test_why_changes_nothing(time: str, place: str, words: str, why: str) -> None:
    assert read(f"{time}去{place}提醒我{words},{why}").order == f"去{place}，说“{words}”"


@given(
    TIMES, PLACES, WORDS,
    sampled_from((
        "然后去充电", "顺便看看猫在不在", "如果我不在就算了", "我不起就再叫一遍",
        "再去厨房", "关灯",
    )),
)  # fmt: skip
def test_what_is_ordered_besides_is_never_dropped(
    time: str, place: str, words: str, more: str
) -> None:
    order = read(f"{time}去{place}提醒我{words},{more}").order
    assert order == f"去{place}提醒我{words},{more}"


@pytest.mark.parametrize(
    "text",
    [
        "每天晚上八点去客厅告诉我谁在看电视", "每天九点去厨房告诉我有没有人",
        "每天下午五点到书房叫我和弟弟吃饭", "每天早上七点去卧室叫我儿子起床",
    ],
)  # fmt: skip
def test_a_question_and_somebody_else_are_left_as_they_were_said(text: str) -> None:
    assert "“" not in read(text).order


def test_a_reminder_without_a_place_is_said_so_often() -> None:
    command = read("每天早上七点叫我起床,叫三遍")
    assert (command.order, command.reminder) == ("说“起床”3遍", None)
    assert read("每天早上七点叫我起床").reminder == "起床"


@pytest.mark.parametrize("who", ["儿子", "女儿", "爸", "老公", "弟弟"])
def test_who_is_woken_may_be_another(who: str) -> None:
    assert read(f"每天早上七点叫我{who}起床").reminder is None


@pytest.mark.parametrize("text", ["九点来提醒我吃药", "九点提醒我吃药", "九点来钟提醒我吃药"])
def test_to_come_is_no_part_of_the_hour(text: str) -> None:
    assert read(text).reminder == "吃药"


@pytest.mark.parametrize("tail", ["", "一声", "一下", "就行", "一下就好"])
def test_nothing_to_say_is_the_time_itself(tail: str) -> None:
    assert read(f"下午三点叫我{tail}").reminder == ""


def test_who_is_urged_is_reminded() -> None:
    assert read("每天晚上八点去书房，催孩子写作业").order == "去书房,提醒孩子写作业"
    assert read("每天晚上八点去书房，说“别催孩子了”").order == "去书房,说“别催孩子了”"
