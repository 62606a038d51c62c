"""Read English corrections that wish or compare: "five would be better", "the pills should be at ten".

Pure, on folded text, whole sentences only. Law: words that are no time and no length are none.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.command import Delay, Retime
from planner.language.schedule.parts import After, TimeOfDay, WeekDays

if TYPE_CHECKING:
    from planner.language.schedule.parts import Part, ReadsWhole

_MAY = re.compile(
    r"^(?:can|could|may|shall) (?:we|i) (?=(?:move|make|change|shift|put|have|do|push|set|switch)\b)"
)
_OPENS = r"(?:(?:no|actually|oh|hm+|well|on second thoughts?|come to think of it|i've changed my mind|thinking about it)[ ,.!]+)*"
_W = r"(?:the|my|that|this|your|our) (?P<w>[a-z0-9' -]{2,60}?)"
_TO = r"(?:at|for|on|to)"
_WISHES = (
    re.compile(rf"{_OPENS}(?P<t>.+?) (?:would be|is|sounds|suits me) (?:much |a bit )?(?:better|nicer)(?: than (?P<o>.+))?"),
    re.compile(rf"{_OPENS}{_W} (?:should|has to|must|ought to|needs? to) (?:really )?(?:be|come) (?:{_TO} )?(?P<t>.+?)(?: instead)?"),
    re.compile(rf"{_OPENS}(?:i'd rather|i would rather|i'd prefer to|i want to|i'd like to) have {_W} {_TO} (?P<t>.+?)(?: instead)?"),
    re.compile(rf"{_OPENS}(?:(?:do|have|run|put) )?{_W} {_TO} (?P<t>.+?) (?:instead|rather|from now on)"),
    re.compile(r"(?:on second thoughts?|come to think of it|i've changed my mind|thinking about it)[ ,.!]+"
               r"(?:(?:make|let's make) (?:it|that) |rather )?(?P<t>.+)"),
)  # fmt: skip
_ON_DAYS = re.compile(
    r"(?P<d>(?:on|at) [a-z, ]+?),? (?:make|do|have|set) (?:it|that) (?:at |to )?(?P<t>[a-z0-9:. ]+?)(?: instead)?"
)
_LATER = re.compile(
    rf"{_OPENS}(?:(?:do|have|run|set|make|move) (?:(?:it|that)|{_W}) )?(?P<n>(?:an?|half|one|two|three|five|ten|fifteen|twenty|thirty|quarter|\d+)\b.*?)"
    r" (?P<way>later|earlier|sooner)(?: (?:would|might) be (?:better|nicer))?"
)
_Found = tuple[Retime | Delay, str, str]


def read_wish(folded: str, reads: ReadsWhole) -> _Found | None:
    """Return a change, the words that name its order, and the change in words; None of others."""
    folded = _MAY.sub("", folded)
    later = _LATER.fullmatch(folded)
    if later is not None:
        parts = reads(f"in {later['n']}", in_chinese=False)
        after = parts[0] if len(parts) == 1 else None
        if isinstance(after, After):
            sign = 1.0 if later["way"] == "later" else -1.0
            way = "later" if sign > 0.0 else "earlier"
            return Delay(sign * after.seconds), later["w"] or "", f"make it {later['n']} {way}"
    on_days = _ON_DAYS.fullmatch(folded)
    if on_days is not None:
        days, clock = reads(on_days["d"], in_chinese=False), _time(on_days["t"], reads)
        if _is_only(days, WeekDays) and _is_only(clock, TimeOfDay):
            return Retime((*clock, *days)), "", f"make it {on_days['t']} {on_days['d']}"
    for pattern in _WISHES:
        found = pattern.fullmatch(folded)
        if found is None:
            continue
        group = found.groupdict()
        parts, before = _time(found["t"], reads), _time(group.get("o") or "", reads)
        if parts and (before or not group.get("o")):
            return Retime(parts, before), group.get("w") or "", f"make it {found['t']}"
    return None


def may_change(folded: str) -> str:
    """Return "move the pills to ten" for "could we move the pills to ten"."""
    return _MAY.sub("", folded)


def _is_only(parts: tuple[Part, ...], kind: type[Part]) -> bool:
    return len(parts) == 1 and isinstance(parts[0], kind)


def _time(words: str, reads: ReadsWhole) -> tuple[Part, ...]:
    leads = ("", "at ", "on ") if words else ()
    return next((parts for lead in leads if (parts := reads(lead + words, in_chinese=False))), ())
