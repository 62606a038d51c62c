"""Read a correction of a standing order: "make it nine", "not on Sundays", 改成九点, 周日不用.

Pure, both languages, whole sentences only. Which order is meant is for the keeper's desk to find;
law: words that are no time, no day and no length are no correction ("make it quick").
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.chinese_corrections import ChineseCorrections
from planner.language.schedule.command import (
    CorrectOrder,
    Delay,
    LeaveOutDays,
    RemindAgain,
    Retime,
)
from planner.language.schedule.parts import After, OnceDay, WeekDays
from planner.language.schedule.windows import read_half, read_window
from planner.language.schedule.wished_changes import may_change, read_wish

if TYPE_CHECKING:
    from planner.language.schedule.command import OrderChange
    from planner.language.schedule.parts import Part, ReadsWhole


BY_ID = re.compile(r"(?:change order|更改任务) ?(?P<id>o\d{1,6}) ?: ?(?P<rest>.+)")
"""How an offered sentence names its order: "change order o3: make it nine"."""
_NO = r"(?:(?:no|nope|sorry|oops|wait|actually|ah|oh|i mean|rather)[ ,.!]+)*"
_IT = r"(?:it|that|this|them)"
_W = r"(?:the|my|that|this|your|our) (?P<w>[a-z0-9' -]{2,60}?)"
_TO = r"(?:to|at|for|on|into|until|till)"
_INSTEAD = r"(?: (?:instead|rather|then|from now on))?"
_RETIME = (
    re.compile(
        rf"{_NO}(?:let's |i'd rather )?(?:make|set|put|change|move|shift|switch|reschedule|push|postpone)"
        rf" {_IT} (?:back |forward )?(?:{_TO} )?(?P<t>.+?){_INSTEAD}"
        r"(?:,? (?:and )?not (?P<o>.+?)| instead of (?P<o2>.+?))?"
    ),
    re.compile(rf"{_NO}(?P<t>.+?),? (?:and )?not (?P<o>.+?)"),
    re.compile(rf"{_NO}(?P<t>.+?) instead of (?P<o>.+?)"),
    re.compile(rf"{_NO}not (?P<o>.+?)(?:,| but|, but) (?:rather )?(?P<t>.+?)"),
    re.compile(rf"{_NO}(?:let's (?:do|say|have) )?(?P<t>.+?) (?:instead|rather)"),
    re.compile(
        rf"{_NO}(?:i (?:meant?|said)|it (?:should|has to|must) be|that (?:should|has to) be)"
        rf"(?: {_TO})? (?P<t>.+?)(?:,? (?:and )?not (?P<o>.+?))?"
    ),
    re.compile(
        r"(?:(?:no|nope|sorry|oops|wait|actually|rather)[ ,.!]+)+(?P<sure>(?:at|every|on|in) .+?)"
    ),
)
_RENAMED = re.compile(
    rf"(?:change|move|shift|switch|set|push|postpone|reschedule|put|make) {_W}"
    rf" (?:back |forward )?(?:{_TO} )?(?P<t>(?:at |on |in )?(?:\d|[a-z]).*?){_INSTEAD}"
)
_LEAVE_OUT = re.compile(
    rf"{_NO}(?:(?:but|and|just|only) )?(?:not|never|except|no|skip|leave out|without)"
    r"(?: (?:on|for|at))?(?: the)? (?P<d>[a-z, ]+?)(?: please)?"
)
_KEEP_TO = re.compile(
    rf"{_NO}(?:(?:make|do) it )?(?:but )?(?:only|just)(?: (?:on|at|for))?(?: the)? (?P<d>[a-z, ]+?)"
    rf"|{_NO}(?:(?:make|do) it )?(?:on |at )?(?P<d2>[a-z, ]+?) only"
)
_DAYS_NAMED = re.compile(
    rf"(?:(?:do|run) )?{_W}(?:,|,? but)? (?:(?P<not>not|never|except)|only|just)(?: on| at)?(?: the)?"
    r" (?P<d>[a-z, ]+)"
    rf"|(?P<skip>skip|leave out|drop|don't do|do not do) {_W.replace('<w>', '<w2>')}"
    r" (?:on|at) (?P<d2>[a-z, ]+)"
)
_SHIFTS = "push|postpone|delay|put|move|bring|shift"
_WAYS = "back|off|out|forward|up"
_LATER = re.compile(
    rf"{_NO}(?:(?:make|do|set) {_IT} )?(?P<n>.+?) (?P<way>later|earlier|sooner)"
    rf"|{_NO}(?P<act>{_SHIFTS}) (?:{_IT}|{_W})(?: (?P<dir>{_WAYS}))? by (?P<n2>.+)"
    rf"|{_NO}(?P<act2>{_SHIFTS}) (?:{_IT}|{_W.replace('<w>', '<w2>')}(?= {_WAYS}))"
    rf"(?: (?P<dir2>{_WAYS}))? (?P<n3>.+)"
)
_AGAIN = re.compile(
    r"(?:hit )?snooze(?: (?:it|that|this|the (?:alarm|reminder)|my (?:alarm|reminder)|again))?"
    r"(?: (?:for|by) (?:another )?(?P<a>.+))?"
    r"|(?:remind|wake) me (?:up )?(?:about (?:it|that) )?(?:again )?(?:a (?:bit|little) )?later(?: on)?"
    r"|(?:remind|wake) me (?:up )?(?:about (?:it|that) )?again in (?P<b>.+?)"
    r"|not (?:now|yet)[, ]+(?:but )?remind me (?:again )?in (?P<f>.+)"
    r"|(?:give me|i need|can i have|let me have|just) (?P<c>.+?)(?: longer)?"
    r"|(?:give me )?another (?P<d>.+?)|(?:give me |just |i need )?(?P<e>[a-z0-9 ]+?) more (?P<u>[a-z]+)"
)
_GIVE_ALONE = re.compile(
    r"(?:give me|i need|can i have|let me have|just) (?!another)(?!.*\b(?:more|longer)\b).+"
)


def read_correction(
    folded: str, reads: ReadsWhole, *, chinese: bool, named: str = ""
) -> CorrectOrder | None:
    """Return the correction that a sentence is; None where it is none.

    Args:
        folded: the sentence, folded, without courtesies.
        reads: reads a time.
        chinese: its language.
        named: the id of the order that it is about, where the sentence is one that was offered.
    """
    by_id = BY_ID.fullmatch(folded)
    if by_id is not None and not named:
        return read_correction(by_id["rest"], reads, chinese=chinese, named=by_id["id"])
    folded = folded if chinese else may_change(folded)
    found = (ChineseCorrections if chinese else _English)(reads).read(folded)
    if found is None and not chinese:
        found = read_wish(folded, reads)
    if found is None:
        hours = read_window(folded, reads, chinese=chinese) or read_half(folded, chinese=chinese)
        return CorrectOrder(hours, folded, named) if hours is not None else None
    change, which, words = found
    sure = bool(named or (which and _KIND.search(which)))
    return CorrectOrder(change, words or folded, named or which, is_sure=sure)


_KIND = re.compile(r"\b(?:reminder|alarm|timer|standing order|routine)s?\b|提醒|闹钟|定时|[叫喊]我")
_Found = tuple["OrderChange", str, str]
"""The change, the words that name an order, and the change in words where others stand with it."""


class _English:
    """Read English corrections."""

    def __init__(self, reads: ReadsWhole) -> None:
        self._reads = reads

    def read(self, said: str) -> _Found | None:
        """Return the change and the order's name."""
        return self._read_again(said) or self._later(said) or self._days(said) or self._retime(said)

    def _read_again(self, said: str) -> _Found | None:
        found = _AGAIN.fullmatch(said)
        if found is None or _GIVE_ALONE.fullmatch(said):
            return None
        lasts = found["a"] or found["b"] or found["c"] or found["d"] or found["f"]
        if found["e"]:
            lasts = f"{found['e']} {found['u']}"
        if lasts is None:
            return RemindAgain(), "", ""
        bare = re.sub(r"^another |(?<=\w) more(?= )| longer$", "", lasts)
        seconds = self._lasts(re.sub(r"^(?=(?:hour|minute)s?$)", "one ", bare))
        return None if seconds is None else (RemindAgain(seconds), "", "")

    def _later(self, said: str) -> _Found | None:
        found = _LATER.fullmatch(said)
        if found is None:
            return None
        lasts = found["n"] or found["n2"] or found["n3"]
        seconds = self._lasts(lasts)
        if seconds is None:
            return None
        act, way = found["act"] or found["act2"], found["dir"] or found["dir2"]
        earlier = (
            found["way"] in ("earlier", "sooner") or act == "bring" or way in ("forward", "up")
        )
        words = f"make it {lasts} {'earlier' if earlier else 'later'}"
        return Delay(-seconds if earlier else seconds), found["w"] or found["w2"] or "", words

    def _days(self, said: str) -> _Found | None:
        for pattern, keeps in ((_LEAVE_OUT, False), (_KEEP_TO, True)):
            found = pattern.fullmatch(said)
            if found is None:
                continue
            words = found["d"] or (found["d2"] if keeps else "")
            days = self._weekdays(words, keeps=keeps)
            if days is not None:
                return days, "", ""
        found = _DAYS_NAMED.fullmatch(said)
        if found is None:
            return None
        keeps = not (found["not"] or found["skip"])
        days = self._weekdays(found["d"] or found["d2"], keeps=keeps)
        words = f"{'only' if keeps else 'not'} on {found['d'] or found['d2']}"
        return None if days is None else (days, found["w"] or found["w2"], words)

    def _weekdays(self, words: str, *, keeps: bool) -> LeaveOutDays | None:
        for lead in ("on ", "every ", "at "):
            parts = self._reads(lead + words, in_chinese=False)
            if len(parts) == 1 and isinstance(parts[0], WeekDays):
                return LeaveOutDays(parts[0].days, keeps)
            if len(parts) == 1 and isinstance(parts[0], OnceDay) and parts[0].weekday is not None:
                day = frozenset({(parts[0].weekday + 1) % 7})
                return LeaveOutDays(day, keeps, is_one=not keeps)
        return None

    def _retime(self, said: str) -> _Found | None:
        for pattern in _RETIME:
            found = pattern.fullmatch(said)
            if found is None:
                continue
            group = found.groupdict()
            old = group.get("o") or group.get("o2")
            parts = (
                self._time(group["t"])
                if group.get("t") is not None
                else self._reads(group["sure"], in_chinese=False)
            )
            before = self._time(old) if old else ()
            if parts and (before or not old):
                return Retime(parts, before), "", ""
        found = _RENAMED.fullmatch(said)
        for cut in _cuts(said) if found is not None else ():
            named, parts = _RENAMED_LEAD.fullmatch(said[: cut[0]]), self._time(said[cut[1] :])
            if named is not None and parts:
                return Retime(parts), named["w"], f"make it {said[cut[1] :]}"
        return None

    def _time(self, words: str) -> tuple[Part, ...]:
        """Return the parts of a time that may be said without its "at"."""
        bare = re.sub(rf"{_INSTEAD}$", "", words)
        for lead in ("", "at ", "on ", "in "):
            if parts := self._reads(lead + bare, in_chinese=False):
                return parts
        return ()

    def _lasts(self, words: str) -> float | None:
        parts = self._reads(f"in {words}", in_chinese=False)
        after = parts[0] if len(parts) == 1 else None
        return after.seconds if isinstance(after, After) else None


_RENAMED_LEAD = re.compile(
    rf"(?:change|move|shift|switch|set|push|postpone|reschedule|put|make) {_W}"
)


def _cuts(said: str) -> list[tuple[int, int]]:
    """Return where "to", "at" or the like parts an order's name from its new time."""
    return [found.span() for found in re.finditer(rf" (?:{_TO} |(?=every |daily|hourly))", said)]
