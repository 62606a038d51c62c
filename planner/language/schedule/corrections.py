"""Read how a sentence moves a kept standing order, or which days it leaves out: "make it nine".

Pure, on folded text, whole sentences only; English and Chinese side by side. Law: what is no whole
time, no days and no length corrects nothing ("make it quick").
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.schedule.command import (
    ChangeOrders,
    CorrectOrder,
    Delay,
    LeaveOutDays,
    RemindAgain,
    Retime,
)
from planner.language.schedule.kept_orders import KIND, KIND_ZH, skip_day
from planner.language.schedule.parts import OnceDay, WeekDays
from planner.language.schedule.time_finder import form_pair, seconds_of, time_of

if TYPE_CHECKING:
    from planner.language.schedule.command import FoundChange
    from planner.language.schedule.parts import Part


_BY_ID = re.compile(r"(?:change order|更改任务) ?(?P<id>o\d{1,6}) ?: ?(?P<rest>.+)")
"""How an offered sentence names its order: "change order o3: make it nine"."""
_NO = form_pair(
    r"(?:(?:no|nope|sorry|oops|wait|actually|i mean)[ ,.!]+)+",
    r"(?:(?:不对|不是|不|错了|抱歉|哦)[,。!]+)+",
)
_IT = r"(?:let's )?(?:make|set|put|change|move|shift|push) (?:it|that)"
_TO = r"(?:to|at|for|until|till)"
_CHANGE_ZH = r"(?:[改换调挪](?:成|到|为)|推迟到|提前到)"
_SAID = form_pair(
    rf"(?:{_IT}|(?:let's )?do|i (?:meant?|said)|(?:it|that) (?:should|must) be)(?: {_TO})? ",
    rf"(?:还是|时间|把?它)*{_CHANGE_ZH}|我说的是|应该是",
)
_INSTEAD = re.compile(r" (?:instead|rather)$")
_NOT_THEN = form_pair(
    r"(?P<t>.+?)(?:,? not| instead of| is better than) (?P<o>.+)|not (?P<o2>.+?)(?:,| but|, but) (?P<t2>.+)",
    r"(?P<t>.+?),?而?不是(?P<o>.+)|不是(?P<o2>.+?),?而?是(?P<t2>.+)",
)
_MOVED = form_pair(
    r"(?:make|put|change|move|shift|push) (?:the|my|that|your) (?P<w>[a-z0-9' -]+)",
    r"[把将](?P<w>.+?)的?(?:时间)?",
)
_CUT = form_pair(rf" (?:{_TO} |(?=every |daily|hourly))", _CHANGE_ZH)
_DAYS = form_pair(
    r"(?:but |and )?(?:(?P<no>not|never|except)|only|just)(?: (?:on|for|at))?(?: the)? (?P<d>[a-z, ]+)",
    r"(?:但是?)?(?:(?:只要?|就)在?(?P<d>.+?)(?:就行|就好)?|除?了?(?P<no>.+?)(?:(?:就|都|先)?(?:不用|不要|别|免了?|除外)[了叫来做]*))",
)
_LATER = form_pair(
    r"(?P<n>.+?) (?P<way>later|earlier)|(?:push|postpone|delay|move|put|bring) (?:it|the (?P<w>.+?)|my (?P<w2>.+?))"
    r"(?: (?P<dir>back|forward))? (?:by )?(?P<n2>(?:\d|an? |half |[a-z]+ (?:minute|hour)).*)",
    r"(?:[把将](?P<w>.+?))??(?P<way>(?:往后)?推迟?|延后|晚|提前|往[后前][推挪移])(?P<n>[^提推挪到]+)(?P<w2>)(?P<dir>)(?P<n2>)",
)
_EARLY = frozenset({"earlier", "forward", "提前", "往前推", "往前挪", "往前移"})
_AGAIN = form_pair(
    r"snooze(?: (?:it|that))?(?: for (?P<a>.+))?|(?:remind|wake) me (?:up )?(?:again (?:in (?P<b>.+)|later)|later)"
    r"|not (?:now|yet),? remind me in (?P<c>.+)|(?:give me |just )?(?:another (?P<d>.+?)|(?P<n>[a-z0-9 ]+?) more (?P<unit>[a-z]+))",
    r"再?[再等过](?P<a>.+?)(?:之后|以后|后)?[再就]?(?:叫|提醒)我(?:一下|一次)?|(?P<b>.+?)(?:之后|以后|后)再(?:叫|提醒)我(?:一下|一次)?"
    r"|再(?:给我|睡|来)(?P<c>.+)|(?:待会儿?|一会儿?|晚点儿?)再?(?:叫|提醒)我|贪睡(?P<d>)(?P<n>)(?P<unit>)",
)


def read_correction(folded: str, *, chinese: bool) -> CorrectOrder | ChangeOrders | None:
    """Return how a sentence moves an order, or which days it leaves out of it; None: it does not."""
    by_id = _BY_ID.fullmatch(folded)
    words = folded if by_id is None else by_id["rest"]
    said, denials = (
        _NO[chinese].subn("", words, count=1) if _NO[chinese].match(words) else (words, 0)
    )
    if (once := _read_one_day(said, chinese)) is not None:
        return replace(once, which=by_id["id"], is_sure=True, is_spoken=False) if by_id else once
    found = (
        _read_again(said, chinese)
        or _read_later(said, chinese)
        or _read_days(said, chinese)
        or _read_time(said, chinese, denied=denials > 0)
    )
    if found is None:
        return None
    change, which, told = found
    kind = re.search(rf"\b{KIND}\b|{KIND_ZH}", which) is not None
    which = by_id["id"] if by_id is not None else which
    return CorrectOrder(change, told or words, which, is_sure=kind or by_id is not None)


def _read_again(said: str, chinese: bool) -> FoundChange | None:
    found = _AGAIN[chinese].fullmatch(said)
    if found is None:
        return None
    lasts = f"{found['n']} {found['unit']}" if found["n"] else ""
    lasts = lasts or next((found[name] for name in "abcd" if found[name]), "")
    if lasts in ("", "一会儿", "会儿"):
        return RemindAgain(), "", ""
    seconds = seconds_of(lasts, chinese)
    return None if seconds is None else (RemindAgain(seconds), "", "")


def _read_later(said: str, chinese: bool) -> FoundChange | None:
    found = _LATER[chinese].fullmatch(_SAID[chinese].sub("", said, count=1))
    lasts = (found["n"] or found["n2"]) if found is not None else ""
    seconds = seconds_of(lasts, chinese) if lasts else None
    if found is None or seconds is None:
        return None
    early = (found["way"] or found["dir"]) in _EARLY
    form = ("make it {} earlier", "提前{}") if early else ("make it {} later", "推迟{}")
    which = _without_that(found["w"] or found["w2"] or "")
    return Delay(-seconds if early else seconds), which, form[chinese].format(lasts)


def _read_days(said: str, chinese: bool) -> FoundChange | None:
    found = _DAYS[chinese].fullmatch(said)
    parts = _days(found, chinese) if found is not None else ()
    if found is None or len(parts) != 1 or not isinstance(parts[0], WeekDays):
        return None
    return LeaveOutDays(parts[0].days, keeps=not found["no"]), "", ""


def _read_one_day(said: str, chinese: bool) -> ChangeOrders | None:
    """Read "not on Sunday", "not tomorrow", 这周日不用: of the order that was spoken of last."""
    found = _DAYS[chinese].fullmatch(said)
    parts = _days(found, chinese) if found is not None and found["no"] else ()
    if found is None or len(parts) != 1 or not isinstance(parts[0], OnceDay):
        return None
    words = found["no"] if chinese else found["d"]
    return replace(skip_day("", parts[0], words, reminds=False), is_spoken=True, is_single=False)


def _days(found: re.Match[str], chinese: bool) -> tuple[Part, ...]:
    """Return the days that words name; a bare Chinese weekday is each of them."""
    words = (found["d"] or found["no"]) if chinese else found["d"]
    forms = ("每{}", "{}") if chinese else ("on {}", "every {}", "at {}", "{}")
    return time_of(words, chinese, *forms)


def _read_time(said: str, chinese: bool, *, denied: bool) -> FoundChange | None:
    """Read a sentence that is a whole time but for words such as "instead" and "I meant"."""
    bare, marks = _SAID[chinese].subn("", said, count=1)
    bare, ends = _INSTEAD.subn("", bare)
    if (pair := _NOT_THEN[chinese].fullmatch(bare)) is not None:
        parts, before = (time_of(pair[n] or pair[f"{n}2"], chinese) for n in ("t", "o"))
        if parts and before:
            return Retime(parts, before), "", ""
    sure = denied and bool(time_of(bare, chinese, "{}"))
    if (marks or ends or sure) and (parts := time_of(bare, chinese)):
        return Retime(parts), "", ""
    for cut in _CUT[chinese].finditer(said):
        named, time = _MOVED[chinese].fullmatch(said[: cut.start()]), said[cut.end() :]
        if named is not None and (parts := time_of(time, chinese)):
            told = f"改成{time}" if chinese else f"make it {time}"
            return Retime(parts), _without_that(named["w"]), told
    return None


def _without_that(words: str) -> str:
    return re.sub(r"的?那[个条项]$", "", words)
