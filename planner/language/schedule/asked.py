"""Read questions about standing orders: "when is my reminder?", "what's on for tomorrow?", 还有多久.

Pure, both languages, whole sentences only. What is kept is for the desk to tell.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Protocol

from planner.language.schedule.chinese_lists import read_list
from planner.language.schedule.command import ListOrders
from planner.language.schedule.parts import EVERY_DAY, DayPart, OnceDay, WeekDays

if TYPE_CHECKING:
    from planner.language.schedule.parts import Part


class ReadsDays(Protocol):
    """Return the parts of a time that a whole text is; none where it is anything else."""

    def __call__(self, folded: str, *, in_chinese: bool) -> tuple[Part, ...]: ...


KINDS = (
    r"(?:reminders?|standing orders?|routines?|schedules?|scheduled (?:tasks?|orders?|jobs?)"
    r"|timers?|alarms?|recurring (?:tasks?|orders?)|daily (?:tasks?|orders?))"
)
MY = (
    r"(?:(?:all(?: of)?|both(?: of)?|every(?: single| last)?|each) )?"
    r"(?:the|my|your|our|this|that|those|these)? ?"
)
_LIST = re.compile(
    r"what do you do (?:for (?:me|us) )?(?:regularly|by yourself|(?:every|each) day)"
    r"|what are you doing (?:every|each) day"
    rf"|(?:what|which) (?:are )?{MY}{KINDS}(?: (?:do (?:i|you|we) have|are (?:there|set|active)"
    rf"|have i (?:set|given)|are you keeping))?|what(?: is|'s) (?:on )?(?:the|my|your) schedule"
    rf"|(?:list|show|read|tell)(?: me)?(?: out)? {MY}{KINDS}|do i have (?:any )?{KINDS}"
    rf"|(?:are there|is there) (?:any )?{KINDS}"
    rf"|(?:what|which) {KINDS} (?:have i got|do i have|did i set|have i made|are on)"
    r"|what (?:have i|did i) (?:ask(?:ed)?|told|tell|give|given) you to do(?: regularly| so far)?"
    rf"|(?:(?:are there|do (?:i|we) have|have (?:i|we) got|did i set|is there) )?any (?:more |other )?{KINDS}"
    rf"(?: (?:set|on|left|at all|for (?:me|us)|coming up|running|still on))*"
    rf"|(?:what|which) (?:other )?(?:{KINDS}|jobs|tasks|chores|duties|things|orders) (?:have|did|do|are) (?:i|we|you|there)"
    r"(?: (?:got|have|had|set|give|given|gave|ask(?:ed)?|told|tell|made|put|keep|kept|remember))*"
    r"(?: (?:you|for (?:me|us|you)|on|down|to do|doing|coming up|still))*"
    r"(?: (?:that )?you(?:'re| are|'ve)? (?:still |now )?(?:keep|keeping|have|got|know|remember|running))?"
    r"|(?:what|which things) (?:have|did|do|am|are) (?:i|we|you) (?:(?:still )?(?:got|get|have|having|put|set|kept|supposed"
    r"|meant|asked|told|ask|tell|got down|had))(?: (?:you|down|on|for (?:me|us|you)|your list|on your list|to))*"
    r"(?: (?:do|doing|remember|remind (?:me|us)(?: (?:of|about|to do))?))?"
    r"(?: (?:every|each) day(?: at the moment| these days)| regularly| at the moment| these days)?"
    r"|what(?:'s| is| are) (?:on )?(?:your|my|the) (?:list|to-?do list|daily (?:jobs|tasks|chores|duties)|duties|chores|standing orders)"
    rf"|(?:go|run) (?:through|over) {MY}{KINDS}|read(?: me)?(?: out)? {MY}{KINDS}(?: out)?(?: to me)?"
    r"|(?:tell me|list|read(?: me)?(?: out)?) (?:all|everything|what)(?: the things)?(?: that)? (?:i|we)(?:'ve| have)?"
    r" (?:asked|told|given|got|set|want)(?: for)?(?: you)?(?: (?:to do|down|down to do))?"
)
_LIST_ALSO = re.compile(
    r"(?:what|which) (?:orders|jobs|tasks|chores|things|duties|reminders) (?:(?:are|do|have) you (?:still )?(?:keep(?:ing)?|have|got|remember(?:ing)?|doing|know(?:ing)?)"
    r"|(?:(?:have|did) (?:i|we) (?:give|given|gave|ask|asked|tell|told|set|left)(?: (?:you|for you|with you))?)(?: to do)?)"
    r"(?: (?:that|which) (?:you(?:'re|'ve| are| have)?|are)(?: still)?(?: (?:keep(?:ing)?|have|got|remember(?:ing)?|doing|on|kept|to do|active))?)?"
    r"|(?:tell me|show me|list|read (?:me )?out) what (?:you|i|we)(?:'ve| have)(?: got)? (?:planned|scheduled|lined up|on|down|to do|set up)"
    r"|what (?:have|are) you(?: got)? (?:planned|scheduled|lined up)"
    r"|what are you (?:meant|supposed|expected|told) to (?:do|be doing)"
)
_NOWADAYS = re.compile(
    r"(?: (?:at the moment|at present|right now|currently|these days|nowadays|so far|again|for me|for us|as it stands|all in all))+$"
)
_AT_TIME = re.compile(
    r"what (?:do you do(?: for (?:me|us))?|will you do|are you going to do|have you planned|do you have planned"
    r"|(?:have i|did i|have we|did we) (?:ask(?:ed)?|told|tell|want(?:ed)?) you to do"
    r"|(?:am i|are we) making you do)(?: for| on)? (?P<a>.+)"
    r"|(?:what(?:'s| is)|is there anything|anything|is anything) (?:on|planned|due|scheduled|coming up|up"
    r"|going on)(?: for| on)? (?P<b>.+)"
    r"|(?:what|which reminders) (?:do (?:i|we) have|have (?:i|we) got)(?: on| planned| coming up)?(?: for)?"
    r" (?P<c>.+)"
    r"|(?:what(?:'s| is) (?:the|my|your|our) (?:plan|schedule|agenda|programme|program)(?: for| on)? (?P<d>.+))"
    r"|(?:do (?:i|we) have anything|have (?:i|we) got anything)(?: on| planned| set| down| coming up)?(?: for)? (?P<e>.+)"
)
_LEFT = re.compile(
    r"how (?:long|much (?:time|longer)|many minutes)(?: more)?"
    r"(?: (?:have i got|do i have|have i|is there|is|are|do we have|have we got))?"
    rf"(?: (?:left|remaining|to go))+(?: (?:on|for|until|till|before) {MY}(?P<a>.+))?"
    rf"|how (?:long|much (?:time|longer)) (?:is it )?(?:until|till|before) {MY}(?P<b>.*?{KINDS}.*)"
    rf"|how much time is left(?: (?:on|for|until|till|before) {MY}(?P<c>.+))?"
)
_NEXT = re.compile(
    rf"(?:when|what time|at what time)(?: is|'s| are| do| does| will| did i set)? {MY}(?:next )?"
    rf"(?P<what>[a-z0-9' -]*? )?(?P<kind>{KINDS})"
    r"(?: (?:for|about|to|of|at|that says?) (?P<of>.+?))?"
    r"(?: (?:due|next|set for|set|go off|ring|come|fire|be))*"
    r"|(?:when|what time|at what time) (?:will|do|are) you (?:next )?(?:going to )?(?:remind(?:ing)?|(?P<wake>wak(?:e|ing))) me(?: up)?"
    r"(?: (?:of|about|to|that) (?P<of2>.+?))?(?: next)?"
    r"|(?:when|what time|at what time) (?:do|am|must|should) i (?:have to |need to |meant to |supposed to |to )?(?P<lean>[a-z' -]{3,40}?)(?: (?:again|next))?"
)

ZH_KINDS = r"(?:提醒|定时任务|定时命令|定时|常规任务|日程|日程安排|闹钟)"
ZH_ALL = r"(?:所有|全部|一切)?的?(?:我的|你的|现有的|这些)?"
_ZH_TELL = r"(?:[, ]+(?:给我|讲给我|念给我|说给我|你|都)*(?:念念|讲讲|说说|听听|念一下|说一下|讲一下|念|讲|说)?)?"
_ZH_LIST = re.compile(
    r"(?:你|现在|目前|手里|手上|手头|一共|我|都)*有(?:哪些|什么|几个)(?:定时|固定|每天)的?(?:活儿?|事情?|任务|工作)(?:要做)?"
    rf"{_ZH_TELL}|有?(?:哪些|什么)(?:事情?|活儿?|任务|工作)是你(?:每天|天天|定时|平时)(?:都)?(?:要|得)?做的{_ZH_TELL}"
    r"|(?:平时|定时)(?:都|会|要|打算|准备|还|有)*(?:做|干|安排了?)(?:什么|啥|些什么|哪些事情?)(?:事情?)?"
    rf"|(?:现在|目前|一共|我|都)*有(?:没有)?(?:哪些|什么|几个)?{ZH_KINDS}(?:吗)?"
    rf"|(?:列出|列一下|显示|看看|看一下|告诉我|说说|查看|查一下){ZH_ALL}(?:有(?:哪些|什么))?{ZH_KINDS}"
    rf"|把{ZH_ALL}{ZH_KINDS}(?:都)?(?:列出来|说一下|告诉我|念一下)"
    rf"|(?:现在|目前|我|都)*(?:设置?|定|安排)了(?:哪些|什么){ZH_KINDS}啊?"
    r"|我(?:都)?(?:让|叫|要|请)你(?:定时)?(?:做|干)(?:了)?(?:什么|啥|哪些事情?)"
    r"|我?(?:都|一共|总共|到底)*(?:给|让|叫|要|请|跟|替)?你?(?:都|一共|定时|平时)*(?:安排|布置|交代|吩咐|设置?|定|记(?:着|住|下)?|说)(?:过|了|的)*"
    r"(?:都)?(?:有|是)?(?:哪些|什么|啥|多少|几个)(?:事[情儿]?|任务|提醒|闹钟|活儿?|东西)?(?:了|来着)?"
    r"|我(?:给|让|叫|要)?你?(?:安排|布置|交代|吩咐|定|设)的(?:事情?|任务|提醒|闹钟)(?:都)?(?:有|是)(?:哪些|什么|啥)"
    rf"|{ZH_ALL}{ZH_KINDS}(?:都)?(?:有|是)(?:哪些|什么|啥|几个)"
    r"|(?:你)?(?:都)?(?:有|记着|记了)(?:哪些|什么|啥|几个)(?:任务|提醒|闹钟|定时)(?:要做)?"
    rf"|(?:念|读|说|报|数)(?:一下|一遍|一念|给我听)*{ZH_ALL}{ZH_KINDS}(?:给我听|一遍|出来)*"
    rf"|把{ZH_ALL}{ZH_KINDS}(?:都|全部?)?(?:念|读|说|讲|报|列)(?:一遍|一下|出来|给我|我?听|来听听)*"
    r"|我(?:让|叫|要|请)你提醒我(?:些|过)?(?:什么|啥|哪些事?)(?:来着)?"
)
_READ_OUT_ZH = re.compile(
    r"[, ]*(?:你)?(?:给我|帮我)?(?:念|读|说|讲|报|数|列)(?:念|说|讲|一遍|一下|出来|给我|我?听听?|来听听|看)+$"
)
"""How the answer is to be given: aloud, as any."""
_WHICH_ZH = re.compile(r"什么|啥|哪|几")
_ZH_WHAT = r"(?:什么|啥|些什么|哪些)(?:事情?|安排|计划|任务|提醒|活动)?"
_ZH_AT_TIME = re.compile(
    rf"(?:我)?(?:让|叫|要|请)?(?:你)?(?P<a>.+?)(?:我)?(?:都|会|要|打算|准备|还)*(?:让|叫|请)?你?"
    rf"(?:都|会|要)*(?:做|干|安排了?){_ZH_WHAT}(?:来着)?"
    rf"|(?P<b>.+?)(?:我|你|都|还|会)*(?:有没有|有)(?:{_ZH_WHAT}|安排|计划|事|任务|提醒)(?:吗|没有|要做)?"
    r"|(?P<c>.+?)的(?:安排|计划|日程|任务)(?:是(?:什么|啥))?"
)
_ZH_LEFT = re.compile(
    r"(?:我)?还(?:有|剩|剩下)(?:多久|多少时间|多长时间|几分钟|多少分钟)(?:了)?"
    rf"|(?:离|距离?)?(?P<a>.*?{ZH_KINDS})(?:还有|还剩|还要)(?:多久|多少时间|多长时间|几分钟|多少分钟)(?:了)?"
)
_ZH_NEXT = re.compile(
    rf"{ZH_ALL}(?P<of>.*?)的?(?P<kind>{ZH_KINDS})(?:是|在|定在|设在)*(?:几点钟?|什么时候|什么时间|何时)(?:啊|来着)?"
    r"|(?:你)?(?:会|要|将)?(?:在)?(?:几点钟?|什么时候|什么时间|何时)(?:会|要)?(?:提醒|叫)我(?P<of2>.*)"
)


def read_asked(folded: str, whole: ReadsDays, *, chinese: bool) -> ListOrders | None:
    """Return what a sentence asks about standing orders; None where it asks nothing of them."""
    folded = _READ_OUT_ZH.sub("", folded) if chinese and _WHICH_ZH.search(folded) else folded
    if not chinese:
        folded = _NOWADAYS.sub("", folded)
    if _lists(folded, chinese=chinese):
        return ListOrders()
    if chinese and (list_asked := read_list(folded, whole)) is not None:
        return list_asked
    if not chinese and (of_day := _read_listed_day(folded, whole)) is not None:
        return of_day
    at_time = (_ZH_AT_TIME if chinese else _AT_TIME).fullmatch(folded)
    if at_time is not None:
        words = next(text for text in at_time.groupdict().values() if text)
        return _read_days(words, whole, chinese=chinese)
    left = (_ZH_LEFT if chinese else _LEFT).fullmatch(folded)
    if left is not None:
        named = next((text for text in left.groupdict().values() if text), "")
        kind = re.search(ZH_KINDS if chinese else rf"\b{KINDS}\b", named)
        which = _bare(named, chinese=chinese)
        reminds = kind is not None and kind[0].startswith(("reminder", "提醒"))
        return ListOrders(which, reminders=reminds, next_runs=True, is_sure=kind is not None)
    following = (_ZH_NEXT if chinese else _NEXT).fullmatch(folded)
    return None if following is None else _read_next(following, chinese=chinese)


def _lists(folded: str, *, chinese: bool) -> bool:
    if chinese:
        return _ZH_LIST.fullmatch(folded) is not None
    return _LIST.fullmatch(folded) is not None or _LIST_ALSO.fullmatch(folded) is not None


def _read_listed_day(folded: str, whole: ReadsDays) -> ListOrders | None:
    """Read "any reminders set for tomorrow", "what have I got you down to do every day"."""
    for cut in re.finditer(r" (?:set |due |planned |coming up )?(?:for |on )?(?=\S)", folded):
        if not _lists(folded[: cut.start()], chinese=False):
            continue
        found = _read_days(folded[cut.end() :], whole, chinese=False)
        if found is not None:
            return found
    return None


def _read_next(found: re.Match[str], *, chinese: bool) -> ListOrders:
    group = found.groupdict()
    lean = group.get("lean")
    if lean is not None:  # "when do I have to feed the cat?" may be about anything
        return ListOrders(lean, next_runs=True, is_sure=False)
    which = group.get("of2") or group.get("of") or group.get("what") or ""
    which = "wake" if group.get("wake") and not which else which
    kind = group.get("kind") or ("提醒" if chinese else "reminder")
    reminds = kind.startswith(("reminder", "提醒"))
    which = re.sub(r"^(?:下一?|最近的?一?|接下来的?一?)个?(?:的)?", "", which)
    return ListOrders(which.strip(" 的了"), reminders=reminds, next_runs=True)


def _bare(named: str, *, chinese: bool) -> str:
    kinds = rf"的?{ZH_KINDS}" if chinese else rf"\b{KINDS}\b(?: (?:for|about|to|of))?"
    return re.sub(r"^(?:我|你)的?", "", re.sub(kinds, "", named)).strip(" 的")


def _read_days(words: str, whole: ReadsDays, *, chinese: bool) -> ListOrders | None:
    """Read the time that orders are asked about: one day's, those of every evening, or all."""
    leads = ("",) if chinese else ("", "on ", "every ")
    words = re.sub(r"\b(morning|afternoon|evening|night)s\b", r"\1", words)
    parts = next((p for lead in leads if (p := whole(lead + words, in_chinese=chinese))), ())
    day = next((part for part in parts if isinstance(part, OnceDay)), None)
    if day is not None:
        return ListOrders(day=day)
    again = next((part for part in parts if isinstance(part, WeekDays)), None)
    if again is not None and again.days == EVERY_DAY and len(parts) == 1:
        return ListOrders()
    timed = parts and all(isinstance(part, (WeekDays, DayPart)) for part in parts)
    return ListOrders(words) if timed else None
