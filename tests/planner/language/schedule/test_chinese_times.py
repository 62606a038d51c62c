"""Times of a Chinese order: hours behind midnight, bedtime, full hours, and an end that is none."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis.strategies import sampled_from

from planner.language.schedule import ScheduleCommand, read_order_command
from planner.plan.timing import CronRule, DayTime

DEEDS = sampled_from(("去充电", "提醒我关灯", "去大门看看"))


def read(text: str) -> ScheduleCommand:
    command = read_order_command(text)
    assert isinstance(command, ScheduleCommand), text
    return command


@given(DEEDS, sampled_from((("今晚", 1), ("今天晚上", 1), ("明晚", 2), ("明天晚上", 2))))
def test_twelve_in_the_evening_is_the_midnight_behind_it(deed: str, day: tuple[str, int]) -> None:
    words, ahead = day
    assert read(f"{words}十二点{deed}").when == DayTime(hour=0, days_ahead=ahead)
    assert read(f"{words}一点半{deed}").when == DayTime(hour=1, minute=30, days_ahead=ahead)
    assert read(f"{words}十一点{deed}").when == DayTime(hour=23, days_ahead=ahead - 1)


@pytest.mark.parametrize(
    ("text", "cron"),
    [
        ("每天晚上十二点去充电", "0 0 * * *"),
        ("每周五晚上十二点去充电", "0 0 * * 6"),
        ("每周六晚上十一点去充电", "0 23 * * 6"),
        ("每天中午十二点去充电", "0 12 * * *"),
        ("每天睡觉前去大门看看", "0 22 * * *"),
        ("每天晚上睡前去大门看看", "0 22 * * *"),
        ("每晚睡觉前去大门看看", "0 22 * * *"),
        ("每个整点去大门看看", "0 * * * *"),
    ],
)
def test_times_that_come_again(text: str, cron: str) -> None:
    assert read(text).when == CronRule(cron=cron)


@given(DEEDS, sampled_from((("睡觉前", 0), ("今晚睡前", 0), ("明天睡觉前", 1), ("睡觉之前", 0))))
def test_bedtime_is_the_usual_hour_of_the_night(deed: str, day: tuple[str, int]) -> None:
    assert read(f"{day[0]}{deed}").when == DayTime(hour=22, days_ahead=day[1])


@pytest.mark.parametrize("text", ["睡前故事讲一个", "睡觉前的灯是谁关的"])
def test_bedtime_in_a_name_is_no_time(text: str) -> None:
    assert not isinstance(read_order_command(text), ScheduleCommand)


@pytest.mark.parametrize("verb", ["一定要去", "一直看着", "三个人都叫来", "二号房间去看看"])
def test_a_digit_behind_the_hour_is_no_minute(verb: str) -> None:
    command = read(f"明晚七点{verb}")
    assert (command.when, command.order) == (DayTime(hour=19, days_ahead=1), verb)


@given(sampled_from(("零五", "五分", "十", "二十五", "05")), DEEDS)
def test_a_minute_is_of_the_hour(minute: str, deed: str) -> None:
    minutes = {"零五": 5, "五分": 5, "十": 10, "二十五": 25, "05": 5}[minute]
    assert read(f"明晚七点{minute}{deed}").when == DayTime(hour=19, minute=minutes, days_ahead=1)


@given(sampled_from((("每周二和周四五点", "0 17 * * 2,4"), ("每周一三五八点", "0 8 * * 1,3,5"),
                     ("每周四五点半", "30 17 * * 4"))), DEEDS)  # fmt: skip
def test_an_hour_behind_days_of_the_week_is_none_of_them(said: tuple[str, str], deed: str) -> None:
    command = read(f"{said[0]}{deed}")
    assert isinstance(command.when, CronRule)
    assert command.when.cron.split()[-1] == said[1].split()[-1]
    assert int(command.when.cron.split()[1]) % 12 == int(said[1].split()[1]) % 12


def test_an_hour_in_words_that_are_said_is_no_end() -> None:
    command = read("每天晚上八点说“可以看到九点”")
    assert (command.problem, command.order) == (None, "说“可以看到九点”")


@pytest.mark.parametrize("condition", ["如果", "要是", "假如"])
def test_a_condition_behind_the_time_is_part_of_the_deed(condition: str) -> None:
    command = read(f"今晚十点{condition}客厅有人就说该睡觉了")
    assert command.order == f"{condition}客厅有人就说该睡觉了"


def test_to_go_somewhere_is_reminded_of_in_full() -> None:
    assert read("下周三下午两点半提醒我去医院").reminder == "去医院"
