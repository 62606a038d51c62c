"""Read that an order is left out on one day: "don't wake me tomorrow", "no patrol on Saturday".

Pure, on folded English text, whole sentences only. Law: one day drops nothing for good, and a
denial with a condition, a limit or an hour besides is none of these.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.command import ChangeOrders
from planner.language.schedule.parts import DayPart, OnceDay

if TYPE_CHECKING:
    from planner.language.schedule.parts import ReadsWhole

_OPENS = r"(?:(?:actually|oh|ah|well|no|you know what|please|just)[ ,]+)*"
_DENIES = (
    r"(?:don't|do not|never|(?:you |we )?(?:needn't|need not|(?:don't|do not) (?:have|need) to)"
    r"|(?:there(?:'s| is) )?no need(?: for you)? to|(?:i|we) (?:don't|do not|won't) (?:need|want) (?:you to|to be)?)"
    r" (?!forget\b|let me forget\b|fail\b|miss\b)"
)
_SKIPS = r"(?:skip|leave out|miss(?: out)?|omit)"
_DROPS = r"(?:skip|leave out|miss(?: out)?|cancel|drop|scrap|call off|forget(?: about)?|no need for|we don't need|i don't need)"
_THE = r"(?:the |my |your |our )?"
_SAID = (
    re.compile(rf"{_OPENS}{_DENIES}(?P<what>.+)"),
    re.compile(rf"{_OPENS}{_SKIPS} {_THE}(?P<what>.+)"),
    re.compile(rf"{_OPENS}leave {_THE}(?P<what>.+?) out(?= )(?P<tail>.+)"),
    re.compile(rf"{_OPENS}no (?!more\b){_THE}(?P<what>.+)"),
    re.compile(rf"{_OPENS}(?P<sleeps>(?:let me|(?:i|we) (?:want|would like|need) to|i'd like to|i can|i'm going to)"
               r" (?:sleep (?:in|late|longer)|have a (?:long )?lie[- ]in|lie in|stay in bed))(?P<what> .+)"),
)  # fmt: skip
_OF_DAY = re.compile(
    rf"{_OPENS}(?:{_DROPS} )(?P<day>today|tonight|tomorrow(?: (?:morning|evening))?|(?:this )?(?:mon|tues|wednes|thurs|fri|satur|sun)day)'s (?P<what>.+)"
)
_REMIND = re.compile(r"(?:be )?remind(?:ed)?(?: me| us)?(?: (?:to|about|of|that))?(?: (?P<of>.+))?")
_SEVERAL = re.compile(
    r"\b(?:if|unless|until|till|before|after|when|or|but|instead|except|only|then|every|each|at (?:\d|noon))\b"
)
_ID = re.compile(r"(?:order|reminder) (o\d{1,6})")
_CLAUSE = re.compile(r"[,;.:!?]")


def read_skip(folded: str, whole: ReadsWhole) -> ChangeOrders | None:
    """Return which orders are left out on one day; None where the sentence says no such thing."""
    if _SEVERAL.search(folded) is not None:
        return None
    of_day = _OF_DAY.fullmatch(folded)
    if of_day is not None:
        return _skip(of_day["what"], of_day["day"], whole)
    for pattern in _SAID:
        found = pattern.fullmatch(folded)
        if found is None:
            continue
        group = found.groupdict()
        said = f"{found['what']}{group.get('tail') or ''}"
        for cut in re.finditer(r" ", said):
            words = "wake me" if group.get("sleeps") else said[: cut.start()].strip()
            skip = _skip(words, said[cut.end() :], whole) if words else None
            if skip is not None:
                return skip
    return None


def _skip(words: str, day_words: str, whole: ReadsWhole) -> ChangeOrders | None:
    parts = whole(day_words, in_chinese=False)
    days = [part for part in parts if isinstance(part, OnceDay)]
    parts_of_day = [part for part in parts if isinstance(part, DayPart)]
    if len(days) != 1 or len(days) + len(parts_of_day) != len(parts):
        return None
    if _CLAUSE.search(words) is not None:
        return None  # what is said besides is left out elsewhere, or is a second order
    by_id = _ID.fullmatch(words)
    remind = _REMIND.fullmatch(words)
    which = by_id[1] if by_id is not None else words
    if remind is not None:
        which = remind["of"] or ""
    kind = re.fullmatch(r"(?P<of>.*?) ?\b(?:reminders?|alarms?)", which)
    reminds = remind is not None or kind is not None
    which = kind["of"] if kind is not None else which
    if parts_of_day and "tonight" not in day_words:  # of two a day the one is meant
        which = f"{which} in the {parts_of_day[0].value}".strip()
    if days[0] == OnceDay(ahead=0):
        day_words = "today"
    single = kind is not None and not which and words.endswith(("reminder", "alarm"))
    return ChangeOrders(
        "skip", which, reminders=reminds, day=days[0], until_words=day_words, is_single=single,
        is_sure=False,
    )  # fmt: skip
