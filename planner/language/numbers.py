"""Read numbers, durations [s], lengths [m] and angles [rad] in both languages."""

from __future__ import annotations

import re
from math import pi, radians

_WORDS = (
    *("zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"),
    *("eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen"),
    *("nineteen", "twenty"),
)
_EN_VALUES = {word: float(value) for value, word in enumerate(_WORDS)} | {
    "a": 1.0,
    "an": 1.0,
    "half a": 0.5,
    "thirty": 30.0,
    "forty": 40.0,
    "fifty": 50.0,
    "sixty": 60.0,
    "seventy": 70.0,
    "eighty": 80.0,
    "ninety": 90.0,
    "half": 0.5,
    "forty five": 45.0,
    "forty-five": 45.0,
    "one hundred eighty": 180.0,
    "a hundred eighty": 180.0,
    "one hundred and eighty": 180.0,
    "a couple of": 2.0,
}
_ZH_DIGITS = {digit: value for value, digit in enumerate("零一二三四五六七八九")} | {"两": 2}
_UNITS_S = {"s": 1.0, "m": 60.0, "h": 3600.0, "秒": 1.0, "分": 60.0, "小": 3600.0, "钟": 3600.0}

_EN_NUMBER = "|".join(sorted(_EN_VALUES, key=len, reverse=True))
EN_DURATION = (
    rf"(?P<number>\d{{1,5}}(?:\.\d{{1,3}})?|{_EN_NUMBER}) ?"
    r"(?P<unit>seconds?|secs?|s|minutes?|mins?|hours?)"
)
EN_OFTEN = rf"few|several|couple of|{'|'.join(_WORDS[2:])}|[2-9]|1\d|20"
"""Rounds are at most 20; the word "times" follows."""
ZH_OFTEN = r"[一二两三四五六七八九十]{1,3}|好?几|\d{1,2}"
ZH_DURATION = (
    r"(?P<number>\d{1,5}(?:\.\d{1,3})?|[零一二三四五六七八九十两半]{1,4})个?"
    r"(?P<unit>秒|分|小时|钟头)钟?"
)


_TIMES = {"once": 1, "twice": 2, "thrice": 3, "two": 2, "three": 3, "four": 4, "five": 5}
_TIMES |= {"couple": 2, "few": 3, "several": 3, "几": 3, "好几": 3}

_UNITS_M = (("c", 0.01), ("厘", 0.01), ("公", 0.01), ("f", 0.3048), ("i", 0.0254), ("y", 0.9144))


def metres(number: str, unit: str) -> float | None:
    """Return a length [m], or None where the number is no number."""
    value = _value(number)
    if value is None:
        return None
    return value * next((m for begin, m in _UNITS_M if unit.startswith(begin)), 1.0)


def angle_rad(number: str, unit: str) -> float | None:
    """Return an angle [rad], or None where the number is no number or over two turns."""
    value = _value(number)
    if value is None:
        return None
    angle = value if unit.startswith(("rad", "弧")) else radians(value)
    return angle if angle <= 4 * pi else None


def times(words: str) -> int:
    """Return how often "twice", "3 times", "a few times" and 三 are."""
    first = words.split(maxsplit=1)[0]
    return _TIMES.get(first) or round(_value(first) or 0.0)


def seconds(number: str, unit: str) -> float | None:
    """Return a duration [s], or None where the number is no number ("一二三")."""
    value = _value(number)
    return None if value is None else value * _UNITS_S[unit[0]]


def _value(number: str) -> float | None:
    if re.fullmatch(r"\d+(?:\.\d+)?", number):
        return float(number)
    return _EN_VALUES[number] if number in _EN_VALUES else _chinese(number)


def chinese_number(number: str) -> float | None:
    """Return a number in Chinese characters: 半, 0 to 199; None where it is none."""
    return _chinese(number)


def _chinese(number: str) -> float | None:
    """Read 半, 0 to 99 written with 十, or one digit."""
    if number == "半":
        return 0.5
    hundreds = re.fullmatch(r"([一二两三]?)百(?:零?([一二三四五六七八九十]*))", number)
    if hundreds is not None:
        rest = _chinese(hundreds[2]) if hundreds[2] else 0.0
        return None if rest is None else 100.0 * _ZH_DIGITS.get(hundreds[1], 1) + rest
    found = re.fullmatch(r"([一二三四五六七八九]?)(十?)([一二三四五六七八九两]?)", number)
    if found is None or (found[1] and found[3] and not found[2]):
        return 0.0 if number == "零" else None
    tens, ten, ones = found.groups()
    if not ten:
        return float(_ZH_DIGITS[tens or ones]) if tens or ones else None
    return 10.0 * _ZH_DIGITS.get(tens, 1) + _ZH_DIGITS.get(ones, 0)
