"""Read Chinese corrections of a standing order: 改成九点, 周日不用, 推迟十分钟, 八点太早了，九点吧.

Part of ``corrections``: whole sentences, folded, without courtesies.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.command import Delay, LeaveOutDays, RemindAgain, Retime
from planner.language.schedule.parts import After, OnceDay, WeekDays

if TYPE_CHECKING:
    from planner.language.schedule.command import OrderChange
    from planner.language.schedule.parts import Part, ReadsWhole

_ZH_NO = r"(?:(?:不对|不是|不|错了|说错了|等等|等一下|抱歉|哦|噢)[,。!]+)*"
_ZH_CHANGE = r"(?:改成|改到|改为|改在|换成|换到|调到|调成|挪到|移到|推迟到|提前到|推到)"
_ZH_BETTER = r"(?:就够了|够了|就行|就好|就可以|更好|比较好|好一点|好些|正好|差不多|(?:再|来|就)*(?:叫|提醒|喊)我?(?:起床|一声|一下)?(?:就行|就好)?)?"
_ZH_RETIME = (
    re.compile(rf"{_ZH_NO}(?:还是)?(?:把?它|时间)?{_ZH_CHANGE}(?P<t>.+)"),
    re.compile(rf"{_ZH_NO}不是(?P<o>.+?),?(?:而)?是(?P<t>.+)"),
    re.compile(rf"{_ZH_NO}(?:我说的是|我是说|应该是|是)?(?P<t>.+?),(?:而)?不是(?P<o>.+)"),
    re.compile(r"(?:(?:不对|错了|说错了|不)[,。!]+)+(?:我说的是|我是说|应该是|是)(?P<t>.+)"),
    re.compile(r"(?:我说的是|我是说|应该是)(?P<t>.+)"),
    re.compile(rf"(?:那|要不|不如)?还是(?:{_ZH_CHANGE})?(?P<t>.+?){_ZH_BETTER}"),
    re.compile(
        rf"(?:把)?(?:它的?)?时间(?:给我)?(?:改|换|调)(?:一下|下|个)?,(?:{_ZH_CHANGE})?(?P<t>.+)"
    ),
)
_ZH_TOO = re.compile(
    r"(?P<o>.+?)(?:实在|还是|也)?(?:太|有点儿?|有些)(?:早|晚|迟|长|短|久)(?:了点儿?|了|点儿?)?,"
    rf"(?:{_ZH_CHANGE}|还是|那就|要不|换|改|就)*(?P<t>.+?){_ZH_BETTER}"
)
"""八点太早了，九点吧; 一个钟头太长了，四十分钟就够了."""
_ZH_RENAMED = re.compile(rf"(?:把|将)?(?P<w>.+?)(?:的)?(?:时间)?{_ZH_CHANGE}(?P<t>.+)")
_ZH_NONE = r"(?:(?:就|都|也|先)*(?:不用|不要|不必|不需要|别|免了?|除外|算了)(?:了|做|去|叫|喊|催|吵|说|念|提醒|来|再|我们?(?!的))*)"
_ZH_LEAVE_OUT = re.compile(
    rf"{_ZH_NO}(?:但|但是)?(?:除了?)?(?P<d>.+?){_ZH_NONE}|{_ZH_NO}除了(?P<d2>.+?)(?:以外|之外|外)?"
)
_ZH_KEEP_TO = re.compile(
    rf"{_ZH_NO}(?:但|但是)?(?:(?:不用|不必|不要|别|不需要)每天(?:都)?(?:叫|喊|说|做|去|来|提醒)?我?,)?(?:只要?|仅|就)(?:在|限)?(?P<d>.+?)(?:就行|就好|就可以|才要|做|去|叫|提醒)?"
    r"|(?:不用|不必|不要|别|不需要)每天(?:都)?(?:叫|喊|说|做|去|来|提醒)?我?,(?P<d3>.+?)(?:就行|就好|就可以|就够了)"
    r"|(?P<d2>.+?)才(?:要|做|去|叫|提醒)?"
)
_ZH_DAYS_NAMED = re.compile(
    rf"(?P<w>.+?)(?P<d>(?:每个?)?(?:周|星期|礼拜).{{1,6}}?){_ZH_NONE}"
    r"|(?P<w2>.+?)只(?:要|在)?(?P<d2>.+?)(?:就行|就好|做|去)?"
)
_ZH_LATER = re.compile(
    rf"{_ZH_NO}(?:(?:把|将)?(?P<w>.+?))??(?:(?:给我|再)*(?:往后)?(?P<way>推迟|延后|延迟|晚|推|提前|早|往后[挪推移调延]|往前[挪提移调])|再?(?P<way2>[挪推移调](?:后|前)))(?:上|个)?(?P<n>[^提推延挪]+?)(?:再?(?:叫|提醒|喊)我(?:起床|一声|一下)?)?"
)
_ZH_AGAIN = re.compile(
    r"(?:再|等|过|再过|再等)(?P<a>.+?)(?:之后|以后|后)?(?:再|就)?(?:叫|提醒|喊)我(?:一下|一次|一声)?"
    r"|(?P<b>.+?)(?:之后|以后|后)再(?:叫|提醒|喊)我(?:一下|一次|一声)?"
    r"|再(?:给我|睡|来|多)(?P<c>.+)|(?:等会儿?|待会儿?|一会儿?|过会儿?|稍后|晚点儿?|晚一点儿?)(?:再)?(?:叫|提醒|喊)我"
    r"|贪睡|再睡(?:一会儿?|会儿?)"
)
_Found = tuple["OrderChange", str, str]
"""The change, the words that name an order, and the change in words where others stand with it."""


def _day_words(found: re.Match[str]) -> str:
    return next((text for name, text in found.groupdict().items() if name[0] == "d" and text), "")


def _name(words: str) -> str:
    """Return what names an order, without 那个; 明天那个 may be meant for that day alone."""
    if re.match(r"[今明]|后天|这次|下次|这个?(?:周|星期|礼拜)", words):
        return words
    return re.sub(r"的?[那这]一?[个条项]$", "", words) or words


class ChineseCorrections:
    """Read Chinese corrections."""

    def __init__(self, reads: ReadsWhole) -> None:
        self._reads = reads

    def read(self, said: str) -> _Found | None:
        """Return the change and the order's name."""
        return self._read_again(said) or self._later(said) or self._days(said) or self._retime(said)

    def _read_again(self, said: str) -> _Found | None:
        found = _ZH_AGAIN.fullmatch(said)
        if found is None:
            return None
        lasts = found["a"] or found["b"] or found["c"]
        if lasts is None or lasts in ("一会儿", "一会", "会儿", "会"):
            return RemindAgain(), "", ""
        seconds = self._lasts(lasts)
        return None if seconds is None else (RemindAgain(seconds), "", "")

    def _later(self, said: str) -> _Found | None:
        found = _ZH_LATER.fullmatch(said)
        seconds = self._lasts(found["n"]) if found is not None else None
        if found is None or seconds is None:
            return None
        earlier = re.search("提前|早|前", found["way"] or found["way2"]) is not None
        words = f"{'提前' if earlier else '推迟'}{found['n']}"
        return Delay(-seconds if earlier else seconds), _name(found["w"] or ""), words

    def _days(self, said: str) -> _Found | None:
        for pattern, keeps in ((_ZH_LEAVE_OUT, False), (_ZH_KEEP_TO, True)):
            found = pattern.fullmatch(said)
            days = None if found is None else self._weekdays(_day_words(found), keeps=keeps)
            if days is not None:
                return days, "", ""
        found = _ZH_DAYS_NAMED.fullmatch(said)
        if found is None:
            return None
        keeps = found["d"] is None
        words = found["d"] or found["d2"]
        days = self._weekdays(words, keeps=keeps)
        change = f"只在{words}" if keeps else f"{words}不用"
        return None if days is None else (days, _name(found["w"] or found["w2"]), change)

    def _weekdays(self, words: str, *, keeps: bool) -> LeaveOutDays | None:
        parts = self._reads(words, in_chinese=True)
        if len(parts) != 1 and re.match(r"周|星期|礼拜", words):
            parts = self._reads(f"每{words}", in_chinese=True)
        part = parts[0] if len(parts) == 1 else None
        if isinstance(part, WeekDays):
            return LeaveOutDays(part.days, keeps)
        if isinstance(part, OnceDay) and part.weekday is not None:
            day = frozenset({(part.weekday + 1) % 7})
            return LeaveOutDays(day, keeps, is_one=part.week is not None and not keeps)
        return None

    def _retime(self, said: str) -> _Found | None:
        for pattern in _ZH_RETIME:
            found = pattern.fullmatch(said)
            if found is None:
                continue
            old = found.groupdict().get("o")
            parts, before = self._time(found["t"]), self._time(old) if old else ()
            if parts and (before or not old):
                return Retime(parts, before), "", ""
        found = _ZH_TOO.fullmatch(said)
        if found is not None:
            parts, before = self._time(found["t"]), self._time(found["o"])
            if parts and before:
                return Retime(parts, before), "", ""
            lasts, lasted = self._lasts(found["t"]), self._lasts(found["o"])
            if lasts is not None and lasted is not None:
                return Retime((After(lasts),)), "", ""
        found = _ZH_RENAMED.fullmatch(said)
        parts = self._time(found["t"]) if found is not None else ()
        return (Retime(parts), _name(found["w"]), f"改成{found['t']}") if found and parts else None

    def _time(self, words: str) -> tuple[Part, ...]:
        return self._reads(words, in_chinese=True)

    def _lasts(self, words: str) -> float | None:
        parts = self._reads(f"{words}后", in_chinese=True)
        after = parts[0] if len(parts) == 1 else None
        return after.seconds if isinstance(after, After) else None
