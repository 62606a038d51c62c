"""Find the days that a Chinese sentence names by the calendar: 3月28号, 下周五, 下个月一号.

Part of ``chinese``: same folding, same kinds of parts. A number alone (五号) is a day only where a
time follows it: 三号房间 is a room.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.numbers import chinese_number
from planner.language.schedule.parts import After, MonthDay, OnceDay, Part

if TYPE_CHECKING:
    from collections.abc import Callable

_N = r"\d{1,2}|[一二三四五六七八九十]{1,3}"
_COUNT = r"\d{1,3}|[一二三四五六七八九十两]{1,3}"
_WEEK = r"(?:周|星期|礼拜)"
_WEEKDAYS = "日一二三四五六"
_BEFORE_TIME = r"(?=,|的?(?:清晨|早|上午|中午|正午|下午|傍晚|晚|夜|凌晨|半夜|午夜)|[零一二三四五六七八九十两\d]{1,3}[点:时]|提醒|叫我)"

_DATE = re.compile(
    rf"在?(?:(?P<year>20\d\d)年|(?P<nextyear>明年)|今年)?的?(?P<month>{_N})月(?P<day>{_N})[号日]"
)
_ISO = re.compile(r"在?(?P<year>20\d\d)-(?P<month>\d\d)-(?P<day>\d\d)")
_OF_MONTH = re.compile(rf"在?(?:(?P<next>下个?月)|这个?月|本月)的?(?P<day>{_N})[号日]")
_NUMBER = re.compile(rf"在?(?P<day>{_N})[号日]{_BEFORE_TIME}")
_FEASTS = {"平安夜": (12, 24), "圣诞节": (12, 25), "圣诞": (12, 25), "元旦": (1, 1),
           "情人节": (2, 14), "劳动节": (5, 1), "儿童节": (6, 1), "国庆节": (10, 1),
           "国庆": (10, 1)}  # fmt: skip
"""Those that lie on the same date each year."""
_FEAST = re.compile(
    rf"在?(?P<nextyear>明年)?的?(?P<feast>{'|'.join(_FEASTS)})(?:那天|当天)?{_BEFORE_TIME}"
)
_WEEKDAY = re.compile(rf"在?(?P<which>下下个?|下个?|这个?|本){_WEEK}(?P<day>[一二三四五六日天])")
_LATER = re.compile(
    rf"(?P<n>{_COUNT})(?:(?P<week>个?(?:星期|礼拜)|周)|天)(?:之后|以后|过后|后)"
    rf"|(?:再?过)(?P<n2>{_COUNT})(?:(?P<week2>个?(?:星期|礼拜)|周)|天)(?:之后|以后|后)?"
    r"|(?P<after>大后天)"
)


def _number(word: str) -> int:
    value = float(word) if word.isdigit() else chinese_number(word)
    return -1 if value is None else int(value)


def _read_date(found: re.Match[str]) -> tuple[Part, ...]:
    group = found.groupdict()
    year = int(group["year"]) if group["year"] else None
    ahead = 1 if group.get("nextyear") else None
    return (MonthDay(_number(found["day"]), _number(found["month"]), year, years_ahead=ahead),)


def _of_month(found: re.Match[str]) -> tuple[Part, ...]:
    return (MonthDay(_number(found["day"]), months_ahead=1 if found["next"] else 0),)


def _read_day_number(found: re.Match[str]) -> tuple[Part, ...]:
    return (MonthDay(_number(found["day"])),)


def _feast(found: re.Match[str]) -> tuple[Part, ...]:
    month, day = _FEASTS[found["feast"]]
    ahead = 1 if found["nextyear"] else None
    return (MonthDay(day, month, years_ahead=ahead, coming=True),)


def _weekday(found: re.Match[str]) -> tuple[Part, ...]:
    weekday = (_WEEKDAYS.index(found["day"].replace("天", "日")) - 1) % 7
    return (OnceDay(weekday=weekday, week=found["which"].count("下")),)


def _later(found: re.Match[str]) -> tuple[Part, ...]:
    if found["after"]:
        return (OnceDay(ahead=3),)
    week = found["week"] or found["week2"]
    days = _number(found["n"] or found["n2"]) * (7 if week else 1)
    return (After(days * 86_400.0, days),) if days > 0 else ()


DATES: tuple[tuple[re.Pattern[str], Callable[[re.Match[str]], tuple[Part, ...]]], ...] = (
    (_DATE, _read_date),
    (_ISO, _read_date),
    (_OF_MONTH, _of_month),
    (_NUMBER, _read_day_number),
    (_FEAST, _feast),
    (_WEEKDAY, _weekday),
    (_LATER, _later),
)
