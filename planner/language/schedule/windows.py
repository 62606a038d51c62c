"""Read the hours in which an order upon an event counts: "only after four", 晚上十点以后就别说了.

Pure, both languages, whole sentences only. Law: words that are no time of day make no window.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.command import KeepHalf, KeepToHours
from planner.language.schedule.parts import HOURS_OF, DayPart, TimeOfDay, hour_in

if TYPE_CHECKING:
    from planner.language.schedule.parts import ReadsWhole


_NO = r"(?:(?:no|but|and|actually|oh|well|please)[ ,.!]+)*"
_DO = (
    r"(?:(?:do|say|tell (?:me|us|them)|bother|greet) (?:that|it|so|this|them|anything|hello)?,? ?)"
)
_EN = (
    ("after", re.compile(
        rf"{_NO}(?:{_DO})?(?:only|just) (?:from|after|past) (?P<t>.+?)(?: on(?:wards)?)?"
        rf"|{_NO}(?:{_DO})?(?:not|don't (?:do|say) (?:it|that)) (?:before|until|till) (?P<t2>.+)")),
    ("before", re.compile(
        rf"{_NO}(?:{_DO})?(?:only|just) (?:before|until|till|up to) (?P<t>.+)"
        rf"|{_NO}(?:not|(?:don't|do not|no more) {_DO})[ ,]*(?:after|past|from) (?P<t2>.+?)(?: on(?:wards)?)?")),
    ("within", re.compile(
        rf"{_NO}(?:{_DO})?(?:only|just) (?:between|from) (?P<t>.+?) (?:and|to|till|until) (?P<u>.+)")),
    ("part", re.compile(
        rf"{_NO}(?:{_DO})?(?:only|just) (?:(?:in|during) the |at )?(?P<t>mornings?|afternoons?|evenings?|nights?|noon)")),
)  # fmt: skip
_NOT_ZH = (
    r"(?:就|都|也|你)*(?:别|不要|不用|不准|不许|甭)(?:再)?"
    r"(?:[说讲叫喊问吵念播]|打招呼|提醒|出声|告诉).{0,6}?"
)
_ZH = (
    ("within", re.compile(r"(?:但是?|不过)?(?:只|仅)(?:在|要|能|限)?(?P<t>.+?)(?:到|至)(?P<u>.+?)(?:之间|中间)?(?:才?[^,，点]{0,6})?")),
    ("after", re.compile(
        r"(?:但是?|不过)?(?:要|得|只|仅|只有|必须)?(?:在)?(?P<t>.+?)(?:以后|之后|过后|后)(?:才|再)[^,，]{0,8}"
        r"|(?:但是?|不过)?(?:只|仅)(?:在|要|能|限)?(?P<t3>.+?)(?:以后|之后|过后|后)[^,，]{0,6}"
        rf"|(?:但是?|不过)?(?P<t2>.+?)(?:以前|之前|前){_NOT_ZH}")),
    ("before", re.compile(
        rf"(?:但是?|不过)?(?P<t>.+?)(?:以后|之后|过后|后){_NOT_ZH}"
        r"|(?:但是?|不过)?(?:只|仅)(?:在|要|能|限)?(?P<t2>.+?)(?:以前|之前|前)[^,，]{0,6}")),
    ("part", re.compile(r"(?:但是?|不过)?(?:只|仅)(?:在|要|限)?(?P<t>早上|上午|中午|下午|傍晚|晚上|夜里|半夜)(?:才?(?:要|说|讲|做|叫|告诉|提醒)?(?:就行|就好)?)?")),
)  # fmt: skip
_DAY_BEGINS, _DAY_ENDS = 6 * 60, 0
"""Before them people are not meant, and midnight."""


def read_window(folded: str, reads: ReadsWhole, *, chinese: bool) -> KeepToHours | None:
    """Return the hours that a sentence keeps an order to; None where it names none."""
    for kind, pattern in _ZH if chinese else _EN:
        found = pattern.fullmatch(folded)
        if found is None:
            continue
        words = next((text for name, text in found.groupdict().items() if name[0] == "t" and text))
        if kind == "part":
            parts = reads(words if chinese else f"in the {words.rstrip('s')}", in_chinese=chinese)
            parts = parts or reads(f"at {words.rstrip('s')}", in_chinese=chinese)
            if len(parts) == 1 and isinstance(parts[0], DayPart):
                return KeepToHours(HOURS_OF[parts[0]])
            continue
        at = _minute_of(
            words, reads, chinese=chinese, early=kind == "before" and "not" not in folded
        )
        until = _minute_of(found["u"], reads, chinese=chinese) if kind == "within" else None
        if at is None or (kind == "within" and until is None):
            continue
        if kind == "after":
            return KeepToHours(_span(at, _DAY_ENDS)) if at != _DAY_ENDS else None
        if kind == "within" and until is not None:
            return KeepToHours(_span(at, until)) if at != until else None
        return KeepToHours(_span(_DAY_BEGINS if at > _DAY_BEGINS else 0, at)) if at else None
    return None


_PART = r"(?P<part>morning|afternoon|evening)"
_HALF = re.compile(
    rf"(?:oh |no,? |the |in |i meant? )+{_PART}(?: one)?(?:,? (?:of course|obviously|naturally|please|i meant?))?"
    rf"|{_PART.replace('part', 'p2')},? (?:of course|obviously|naturally|i meant?)"
)
_HALF_ZH = re.compile(
    r"(?:当然|肯定|是|我说的?是|我是说|就)+(?P<part>早上|上午|下午|晚上)(?:的)?|(?P<p2>早上|上午|下午|晚上)(?:的)?,?(?:当然|当然了|肯定)"
)
_PARTS_ZH = {"早上": "morning", "上午": "morning", "下午": "afternoon", "晚上": "evening"}


def read_half(folded: str, *, chinese: bool) -> KeepHalf | None:
    """Return the part of the day that a sentence says an order's hour is in: "afternoon, of course"."""
    found = (_HALF_ZH if chinese else _HALF).fullmatch(folded)
    if found is None:
        return None
    word = found["part"] or found["p2"]
    return KeepHalf(DayPart(_PARTS_ZH.get(word, word)))


def _span(first: int, last: int) -> str:
    return f"{first // 60:02}:{first % 60:02}-{last // 60:02}:{last % 60:02}"


def _minute_of(words: str, reads: ReadsWhole, *, chinese: bool, early: bool = False) -> int | None:
    """Return the minute of the day of a time; an hour of a dial is one by day, or of the evening."""
    leads = ("",) if chinese else ("", "at ")
    parts = next((p for lead in leads if (p := reads(lead + words, in_chinese=chinese))), ())
    clock = next((part for part in parts if isinstance(part, TimeOfDay)), None)
    daypart = next((part for part in parts if isinstance(part, DayPart)), None)
    if clock is None or len(parts) > 1 + (daypart is not None):
        return None
    hour = clock.hour
    if not clock.sure and daypart is not None:
        hour = hour_in(hour, daypart)
    elif not clock.sure and 1 <= hour <= 11 and not (early and hour >= _DAY_BEGINS // 60):
        hour += 12
    return (hour % 24) * 60 + clock.minute
