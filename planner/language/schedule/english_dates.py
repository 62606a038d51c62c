"""Find the days that an English sentence names by the calendar: "on 28 March", "next Friday".

Part of ``english``: same folding, same kinds of parts. A day with a number alone ("on the 5th") is
one only where no thing follows that is counted so ("on the 5th floor").
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.parts import After, DayPart, MonthDay, OnceDay, Part

if TYPE_CHECKING:
    from planner.language.schedule.parts import PartForm

DAYS = ("sunday", "monday", "tuesday", "wednesday", "thursday", "friday", "saturday")
_DAY = "|".join(DAYS)
_DAYPART = r"morning|afternoon|evening|night|noon"
_END = r"(?![\w'])"
_MONTHS = ("january", "february", "march", "april", "may", "june", "july", "august", "september",
           "october", "november", "december")  # fmt: skip
_SHORT = {name[:3]: number for number, name in enumerate(_MONTHS, 1)}
_MONTH = r"(?P<month>{}|(?:jan|feb|mar|apr|jun|jul|aug|sept?|oct|nov|dec)\b\.?)".format(
    "|".join(_MONTHS)
)
_ONES = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth")
_TEENS = ("tenth", "eleventh", "twelfth", "thirteenth", "fourteenth", "fifteenth", "sixteenth",
          "seventeenth", "eighteenth", "nineteenth", "twentieth")  # fmt: skip
_ORDINALS = {word: number for number, word in enumerate((*_ONES, *_TEENS), 1)} | {
    f"twenty{gap}{word}": 20 + number for number, word in enumerate(_ONES, 1) for gap in ("-", " ")
} | {"thirtieth": 30, "thirty-first": 31, "thirty first": 31}  # fmt: skip
_ORDINAL = "|".join(sorted(_ORDINALS, key=len, reverse=True))
_NUMBERED = r"\d{1,2}(?:st|nd|rd|th)"
_YEAR = r"(?:,? (?:(?P<year>20\d\d)(?!:)|(?P<nextyear>next year)))?"
_COUNTED = (
    r"(?! (?:floor|storey|story|shelf|level|step|stair|room|door|table|chair|bed|one|time|row|side"
    r"|try|attempt|day|landing|page|hole|line|person|cup|bottle|left|right)s?\b)"
)
_WHOSE = r"(?: (?:of (?:(?P<next>next)|this|the) month|(?:(?P<next2>next)|this) month))?"

_DAY_MONTH = re.compile(
    rf"(?:on )?(?:the )?(?P<day>\d{{1,2}}(?:st|nd|rd|th)?|{_ORDINAL}) (?:of )?{_MONTH}{_YEAR}{_END}"
)
_MONTH_DAY = re.compile(
    rf"(?P<on>on )?{_MONTH} (?:the )?(?P<day>\d{{1,2}}(?P<th>st|nd|rd|th)?|{_ORDINAL})"
    rf"(?![:.]\d){_YEAR}{_END}"
)
_ISO = re.compile(rf"(?:on )?(?P<year>20\d\d)-(?P<m>\d\d)-(?P<day>\d\d){_END}")
_NUMBER = re.compile(
    rf"on (?:the )?(?P<day>{_NUMBERED}){_WHOSE}{_END}{_COUNTED}"
    rf"|on the (?P<word>{_ORDINAL})(?:{_WHOSE.replace('?P<', '?P<w')}(?<=month){_END}"
    rf"|(?= at\b| in the (?:{_DAYPART})\b|,|[.!]?$))"
    rf"|next month,? on the (?P<after>{_NUMBERED}|{_ORDINAL}){_END}{_COUNTED}"
)
_FEASTS = {
    r"christmas eve": (12, 24), r"christmas(?: day)?": (12, 25), r"boxing day": (12, 26),
    r"new year'?s'? eve": (12, 31), r"new year'?s'?(?: day)?": (1, 1),
    r"(?:st\.? )?valentine'?s(?: day)?": (2, 14), r"hallowe'?en": (10, 31),
}  # fmt: skip
"""Those that lie on the same date each year."""
_FEAST = re.compile(
    rf"(?:on |at )({'|'.join(f'({name})' for name in _FEASTS)})(?: (?P<part>{_DAYPART}))?{_END}"
)
_NEXT_DAY = re.compile(
    rf"(?:on )?(?:next (?P<either>{_DAY})|(?:the )?(?P<day>{_DAY}) (?:of )?next week"
    rf"|next week,? (?:on )?(?P<day2>{_DAY}))(?: (?P<part>{_DAYPART}))?{_END}"
)
_FEW = {"a": 1, "one": 1, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7,
        "eight": 8, "nine": 9, "ten": 10, "a couple of": 2}  # fmt: skip
_SPAN = rf"(?P<n>\d{{1,3}}|{'|'.join(sorted(_FEW, key=len, reverse=True))}) (?P<unit>day|week)s?"
_DAYS_ON = re.compile(
    rf"(?:in|after) {_SPAN}(?: time)?{_END}"
    rf"|{_SPAN.replace('?P<', '?P<x')} (?:from (?:now|today)|later){_END}"
)


def _number(word: str) -> int:
    return _ORDINALS[word] if word in _ORDINALS else int(re.sub(r"\D", "", word))


def _read_date(found: re.Match[str]) -> tuple[Part, ...]:
    group = found.groupdict()
    if "th" in group and not (group["on"] or group["th"] or group["day"] in _ORDINALS):
        return ()  # "march 2 metres": an order to move
    month = int(group["m"]) if "m" in group else _SHORT[found["month"][:3]]
    year = int(found["year"]) if found["year"] else None
    return (
        MonthDay(
            _number(found["day"]), month, year, years_ahead=1 if group.get("nextyear") else None
        ),
    )


def _read_day_number(found: re.Match[str]) -> tuple[Part, ...]:
    word = found["day"] or found["word"] or found["after"]
    following = found["next"] or found["next2"] or found["wnext"] or found["wnext2"]
    ahead = 1 if following or found["after"] else None
    return (MonthDay(_number(word), months_ahead=ahead),)


def _feast(found: re.Match[str]) -> tuple[Part, ...]:
    name = next(name for name in _FEASTS if re.fullmatch(name, found[1]))
    month, day = _FEASTS[name]
    return (MonthDay(day, month, coming=True), *_part(found))


def _next_day(found: re.Match[str]) -> tuple[Part, ...]:
    name = found["either"] or found["day"] or found["day2"]
    weekday = (DAYS.index(name) - 1) % 7
    either = found["either"] is not None
    return (OnceDay(weekday=weekday, week=1, either_week=either), *_part(found))


def _part(found: re.Match[str]) -> tuple[Part, ...]:
    return (DayPart(found["part"]),) if found["part"] else ()


def _days_on(found: re.Match[str]) -> tuple[Part, ...]:
    word, unit = found["n"] or found["xn"], found["unit"] or found["xunit"]
    days = (int(word) if word.isdigit() else _FEW[word]) * (7 if unit == "week" else 1)
    return (After(days * 86_400.0, days),) if days else ()


DATES: tuple[PartForm, ...] = (
    (_DAY_MONTH, _read_date),
    (_MONTH_DAY, _read_date),
    (_ISO, _read_date),
    (_NUMBER, _read_day_number),
    (_FEAST, _feast),
    (_NEXT_DAY, _next_day),
    (_DAYS_ON, _days_on),
)
