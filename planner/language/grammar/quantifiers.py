"""Own the words that mean more than one thing: "all the cups", "two chairs", 所有的杯子, 每把椅子.

A search ends with the first that it finds, and a drive ends before one thing: neither is done with
several. That is said, and a count is offered in its stead. "Some cups" and "cups" are content with
what is found.
"""

from __future__ import annotations

import re

from planner.language.catalogue import say

ONE_AT_A_TIME = say("grammar.one_at_a_time")
_NUMBER = r"(?:two|three|four|five|six|seven|eight|nine|ten|\d+)"
_MANY = r"(?:[a-z0-9'-]+s|people|men|women|children|sheep|mice)"
_EN = re.compile(
    r"(?:all|every|each|both|several|many|a few|a couple of)\b(?! one\b)(?: of)?"
    r"(?: (?:the|my|our))? "
    rf"(?P<all>.+)|(?:the |my |our )?{_NUMBER} (?P<some>(?:[^ ]+ )*?{_MANY}\b.*)"
)
_UNIT = r"[个只张位把本台瓶杯名条件辆盒罐双支口盏颗种]"
_ZH = re.compile(
    rf"(?:(?:所有|全部)的?|每一?{_UNIT}?|各{_UNIT}|[这那]?(?:[两二三四五六七八九十几]|\d+){_UNIT})"
    r"(?P<all>.+)|(?P<some>.+)都"
)
_PEOPLE = re.compile(r"every(?:one|body)(?P<rest>.*)|(?:大家|所有人|每个人)")
_ONE = re.compile(r"(?:every|each)\b(?! of)")


def several(words: str) -> str | None:
    """Return what is meant by words for several, without their number; None where one will do."""
    people = _PEOPLE.fullmatch(words)
    if people is not None:
        return f"people{people['rest']}" if words.isascii() else "人"
    found = _EN.fullmatch(words) or _ZH.fullmatch(words)
    if found is None:
        return None
    what = found["all"] or found["some"]
    plain = _ONE.match(words) and " " not in what and not what.endswith("s")
    return f"{what}s" if plain else what
