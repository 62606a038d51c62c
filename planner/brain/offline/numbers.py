"""Read numbers and durations in both languages. Units: seconds."""

from __future__ import annotations

import re

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
}
_ZH_DIGITS = {digit: value for value, digit in enumerate("零一二三四五六七八九")} | {"两": 2}
_UNITS_S = {"s": 1.0, "m": 60.0, "h": 3600.0, "秒": 1.0, "分": 60.0, "小": 3600.0}

_EN_NUMBER = "|".join(sorted(_EN_VALUES, key=len, reverse=True))
EN_DURATION = (
    rf"(?P<number>\d{{1,5}}(?:\.\d{{1,3}})?|{_EN_NUMBER}) ?"
    r"(?P<unit>seconds?|secs?|s|minutes?|mins?|hours?)"
)
ZH_DURATION = (
    r"(?P<number>\d{1,5}(?:\.\d{1,3})?|[零一二三四五六七八九十两半]{1,4})个?(?P<unit>秒|分|小时)钟?"
)


def seconds(number: str, unit: str) -> float | None:
    """Return a duration [s], or None where the number is no number ("一二三")."""
    value = _value(number)
    return None if value is None else value * _UNITS_S[unit[0]]


def _value(number: str) -> float | None:
    if re.fullmatch(r"\d+(?:\.\d+)?", number):
        return float(number)
    return _EN_VALUES[number] if number in _EN_VALUES else _chinese(number)


def _chinese(number: str) -> float | None:
    """Read 半, 0 to 99 written with 十, or one digit."""
    if number == "半":
        return 0.5
    found = re.fullmatch(r"([一二三四五六七八九]?)(十?)([一二三四五六七八九两]?)", number)
    if found is None or (found[1] and found[3] and not found[2]):
        return 0.0 if number == "零" else None
    tens, ten, ones = found.groups()
    if not ten:
        return float(_ZH_DIGITS[tens or ones]) if tens or ones else None
    return 10.0 * _ZH_DIGITS.get(tens, 1) + _ZH_DIGITS.get(ones, 0)
