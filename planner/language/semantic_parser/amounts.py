"""Read amounts in words or digits: how long, how far, how much of a turn, how often.

Works on folded text and gives the value in one unit a kind: seconds, metres, degrees, times.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

from planner.language.numbers import chinese_number
from planner.language.semantic_parser.plan_grammar import SlotKind

if TYPE_CHECKING:
    from collections.abc import Iterator

_ONES = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen"),
    "nineteen",
)
_TENS = ("twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")
_NUMBERS = {word: float(value) for value, word in enumerate(_ONES)} | {
    word: 10.0 * value for value, word in enumerate(_TENS, start=2)
}
_FRACTIONS = {"half a": 0.5, "half an": 0.5, "half": 0.5, "a": 1.0, "an": 1.0, "a couple of": 2.0}
_QUARTER = {"quarter of an": 0.25, "a quarter of an": 0.25, "three quarters of an": 0.75}
_UNITS: dict[str, tuple[SlotKind, float]] = {
    r"sec(?:ond)?s?|s": (SlotKind.DURATION, 1.0),
    r"min(?:ute)?s?": (SlotKind.DURATION, 60.0),
    r"h(?:ou)?rs?|h": (SlotKind.DURATION, 3600.0),
    r"met(?:re|er)s?|m": (SlotKind.LENGTH, 1.0),
    r"centimet(?:re|er)s?|cms?": (SlotKind.LENGTH, 0.01),
    r"feet|foot|ft": (SlotKind.LENGTH, 0.3048),
    r"inch(?:es)?|in": (SlotKind.LENGTH, 0.0254),
    r"yards?|yds?": (SlotKind.LENGTH, 0.9144),
    r"degrees?|deg|°": (SlotKind.ANGLE, 1.0),
    r"rad(?:ian)?s?": (SlotKind.ANGLE, 180.0 / pi),
    r"(?:more )?times?|x": (SlotKind.TIMES, 1.0),
}
_UNITS_ZH: dict[str, tuple[SlotKind, float]] = {
    r"秒钟?": (SlotKind.DURATION, 1.0),
    r"分钟?": (SlotKind.DURATION, 60.0),
    r"刻钟": (SlotKind.DURATION, 900.0),
    r"小时|钟头|钟": (SlotKind.DURATION, 3600.0),
    r"米|m": (SlotKind.LENGTH, 1.0),
    r"厘米|公分|cm": (SlotKind.LENGTH, 0.01),
    r"英尺|尺|呎": (SlotKind.LENGTH, 0.3048),
    r"英寸|寸|吋": (SlotKind.LENGTH, 0.0254),
    r"度|°": (SlotKind.ANGLE, 1.0),
    r"次|遍|回|趟|圈|道|轮|下": (SlotKind.TIMES, 1.0),
}
_OFTEN = {"once": 1.0, "twice": 2.0, "thrice": 3.0}
_SECONDS, _METRES = {"s": 1.0, "min": 60.0, "h": 3600.0}, {"m": 1.0, "cm": 0.01}
_NOTATION = _SECONDS | _METRES | {"ft": 0.3048, "in": 0.0254, "deg": 1.0, "times": 1.0}


def _alternatives(words: dict[str, float]) -> str:
    return "|".join(sorted(words, key=len, reverse=True))


_DIGITS = r"\d{1,4}(?:\.\d{1,3})?"
_EN_WORD = rf"(?:{'|'.join(_TENS)})(?:[ -](?:{'|'.join(_ONES[1:10])}))?|{_alternatives(_NUMBERS)}"
_EN = re.compile(
    rf"(?<![a-z0-9])(?P<number>(?:a |one )?hundred(?: and)? (?:{_EN_WORD})|{_DIGITS}|{_EN_WORD}"
    rf"|{_alternatives(_QUARTER)}|{_alternatives(_FRACTIONS)})(?P<half> and a half)? ?-?"
    rf"(?P<unit>{'|'.join(_UNITS)})(?![a-z0-9])(?P<after> and a half(?! an?\b))?"
    rf"|(?<![a-z])(?P<often>{_alternatives(_OFTEN)})(?![a-z])"
)
_ZH_NUMBER = rf"{_DIGITS}|[零一二三四五六七八九十两半百]{{1,5}}"
_AFTER_NUMBER = "|".join(("个", *_UNITS_ZH))
_ZH = re.compile(
    rf"(?P<number>{_ZH_NUMBER}) ?(?P<and>个半)?个? ?(?P<unit>{'|'.join(_UNITS_ZH)})(?P<half>半)?"
    rf"(?:(?<=米)(?P<tenths>[一二三四五六七八九])十?(?![零一二三四五六七八九十百点]|{_AFTER_NUMBER}))?"
)


@dataclass(frozen=True, slots=True)
class FoundAmount:
    """Hold an amount, and where it stands in the text."""

    kind: SlotKind
    value: float
    start: int
    end: int


def find_amounts(folded: str) -> Iterator[FoundAmount]:
    """Yield the amounts of a folded text from left to right."""
    for pattern, read in ((_EN, _read_english), (_ZH, _read_chinese)):
        for found in pattern.finditer(folded):
            amount = read(found)
            if amount is not None:
                yield FoundAmount(*amount, found.start(), found.end())


def _unit_of(word: str, units: dict[str, tuple[SlotKind, float]]) -> tuple[SlotKind, float]:
    return next(unit for pattern, unit in units.items() if re.fullmatch(pattern, word))


def _read_english(found: re.Match[str]) -> tuple[SlotKind, float] | None:
    if found["often"]:
        return SlotKind.TIMES, _OFTEN[found["often"]]
    value = _english_number(found["number"])
    kind, factor = _unit_of(found["unit"], _UNITS)
    if kind is SlotKind.TIMES and found["number"] in _FRACTIONS:
        return None
    half = 0.5 if found["half"] or found["after"] else 0.0
    return kind, (value + half) * factor


def _english_number(number: str) -> float:
    known = {**_NUMBERS, **_FRACTIONS, **_QUARTER}
    if number in known:
        return known[number]
    if number[0].isdigit():
        return float(number)
    hundred = re.match(r"(?:a |one )?hundred(?: and)? ", number)
    rest = number[hundred.end() :] if hundred else number
    return (100.0 if hundred else 0.0) + sum(
        known.get(word, 0.0) for word in re.split("[ -]", rest)
    )


def _read_chinese(found: re.Match[str]) -> tuple[SlotKind, float] | None:
    number = found["number"]
    value = float(number) if number[0].isdigit() else chinese_number(number)
    if value is None:
        return None
    kind, factor = _unit_of(found["unit"], _UNITS_ZH)
    half = 0.5 if found["half"] or found["and"] else 0.0
    tenths = (chinese_number(found["tenths"]) or 0.0) / 10.0 if found["tenths"] else 0.0
    return kind, (value + half + tenths) * factor


def amount_value(text: str) -> float:
    """Return the value of an amount of the notation (``5 min``) in its kind's one unit."""
    number, unit = text.split()
    return float(number) * _NOTATION[unit]


def write_amount(kind: SlotKind, value: float) -> str:
    """Return an amount in the notation, in the unit that people would use."""
    unit = {SlotKind.LENGTH: "m", SlotKind.ANGLE: "deg", SlotKind.TIMES: "times"}.get(kind, "s")
    if kind is SlotKind.DURATION and value >= 60.0 and (value / 30.0).is_integer():
        unit = "min"
    return f"{round(value / _NOTATION[unit], 2):g} {unit}"
