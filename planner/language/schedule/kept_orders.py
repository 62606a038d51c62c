"""Read words about the standing orders that are kept: list, remove, pause, skip a day.

Pure, on folded text, whole sentences only; English and Chinese side by side. An order is called by
its number, by a word of it or by its time; which one that is, is for the desk to find. Law: words
that are no time, no day, no length and no name change nothing ("make it quick").
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from planner.language.schedule.command import ChangeOrders, ListOrders, ask_days
from planner.language.schedule.parts import (
    EVERY_DAY,
    DayPart,
    MonthDay,
    OnceDay,
    TimeOfDay,
    WeekDays,
    end_of_pause,
)
from planner.language.schedule.time_finder import form_pair, lasting, reads_timing, time_of

if TYPE_CHECKING:
    from planner.language.schedule.command import Act


KIND = r"(?:(?:standing |recurring |scheduled |daily )?(?:orders?|tasks?|reminders?)|routines?|schedules?|timers?|alarms?)"
KIND_ZH = r"(?:提醒|定时任务|定时|日程|闹钟)"
_MY = (
    r"(?:(?:all(?: of)?|both(?: of)?|every|each) )?(?:(?:the|my|your|our|this|that|these|those) )?"
)
_ALL_ZH = r"(?:所有|全部)?的?(?:我的|你的|这些)?"
_ID = r"(?:order |reminder |任务|提醒)?(?P<id>o\d{1,6})"

_LIST = form_pair(
    rf"(?:list|show|read|tell)(?: me)? {_MY}(?:(?P<of>.+?) )??{KIND}|(?:what|which)(?: are)? {_MY}{KIND}(?: (?:are (?:there|set)|do i have))?",
    rf"(?:现在|目前|我|都|还)*(?:有|(?:设|定|安排)了)(?:哪些|什么|几个)?{KIND_ZH}|[把列出]+{_ALL_ZH}(?P<of>.*?)的?{KIND_ZH}都?(?:列出来|念一遍)?",
)
_OF_TIME = form_pair(
    r"(?:what (?:do you do|are you going to do|(?:have|did) i ask(?:ed)? you to do)"
    r"|(?:what(?:'s| is)|anything|do i have anything)(?: on| planned)?|tell me what is on)(?: for| on)? (?P<t>.+)",
    r"(?:我?[让叫要]?你)?(?P<t>.+?)(?:我|你|都|会|要|[让叫]你)*(?:做(?:什么|啥|哪些)|有(?:没有)?(?:什么|啥|哪些)?(?:安排|事|任务|提醒))[吗呢]?",
)
_LEFT = form_pair(
    r"how (?:long|much (?:time|longer))(?: have i got| do i have| is there)? (?:left|to go)",
    r"我?还[有剩]多久",
)
_NEXT = form_pair(
    rf"(?:how (?:long|much (?:time|longer)) (?:is it )?(?:until|till)|(?:when|what time)(?:'s| is)) {_MY}(?:next )?(?P<of>.*?) ?"
    rf"(?P<kind>{KIND})(?: (?:for|about|to|of) (?P<of2>.+?))?(?: (?:due|next|set for|set))*"
    r"|(?:when|what time) (?:will|do) you (?:next )?remind me(?: (?:of|about|to) (?P<of3>.+))?",
    rf"{_ALL_ZH}(?:离|距)?(?P<of>.*?)的?(?P<kind>{KIND_ZH})[是在]*(?:几点|什么时候|还有多久)"
    r"|你?(?:几点|什么时候)会?(?:提醒|叫)我(?P<of2>.*)(?P<of3>)",
)


def read_asked(folded: str, *, chinese: bool) -> ListOrders | None:
    """Return what a sentence asks about standing orders; None where it asks nothing of them."""
    if (asked := _LIST[chinese].fullmatch(folded)) is not None:
        return ListOrders(asked["of"] or "")
    if (asked := _OF_TIME[chinese].fullmatch(folded)) is not None:
        words = re.sub(r"\b(morning|afternoon|evening|night)s\b", r"\1", asked["t"])
        return ask_days(time_of(words, chinese, "{}", "every {}"), words)
    if _LEFT[chinese].fullmatch(folded) is not None:
        return ListOrders(next_runs=True, is_sure=False)
    if (asked := _NEXT[chinese].fullmatch(folded)) is None:
        return None
    which = asked["of"] or asked["of2"] or asked["of3"] or ""
    reminds = (asked["kind"] or "reminder").startswith(("reminder", "提醒"))
    return ListOrders(which.strip(" 的了"), reminders=reminds, next_runs=True)


_ACTS: tuple[tuple[Act, tuple[re.Pattern[str], re.Pattern[str]]], ...] = (
    ("remove", form_pair(
        r"(?:cancel|delete|remove|drop|stop|end|forget|get rid of|i (?:don't|no longer) need|no more) (?P<a>.+)",
        r"(?:取消|删除|删掉|去掉|停止|关掉)(?P<a>.+)|把(?P<b>.+?)都?(?:取消|删除|删掉|去掉|关掉|停掉)[了吧]?"
        r"|(?P<c>.{1,20}?的?那[个条项])(?:就)?(?:不要|不用|取消|删掉)了?")),
    ("pause", form_pair(r"(?:pause|suspend|skip) (?P<a>.+)", r"暂停(?P<a>.+)|把(?P<b>.+?)暂停(?P<c>.*)")),
    ("resume", form_pair(
        r"(?:resume|continue|restart|start|turn on) (?P<a>.+)",
        r"(?:恢复|继续|重新开始)(?P<a>.+)|把(?P<b>.+?)(?:恢复|打开)(?P<c>)")),
)  # fmt: skip
_TAIL = r"(?: (?:any ?more|any longer|again|for now|from now on|now|please))*"
_OFTEN = (
    r"(?:evening|morning|afternoon|night|nightly|daily|hourly|weekly|weekday|weekend|noon|monday|tuesday|wednesday|thursday|friday"
    r"|saturday|sunday|recurring|scheduled|standing)"
)
_NAMED = form_pair(
    rf"(?:{_ID}|{_MY}(?P<kind>{KIND})(?: (?:for(?! now)|about|to|of|at|with) (?P<of>.+?))?|{_MY}(?P<what>.+?) (?P<kind2>{KIND})"
    rf"|(?:the |my |your )?(?P<often>{_OFTEN}(?: (?!again\b)[\w'-]+){{1,3}})|the ones? (?P<one>.+?)"
    rf"|(?:the|my|that|this) (?P<called>.+?) ones?){_TAIL}",
    rf"{_ID}|(?P<every>所有|全部)?的?(?:我的|你的|这些)?(?P<what>.*?)的?(?P<kind>{KIND_ZH})|(?P<called>.+?)的?那[个条项](?P<of>)(?P<kind2>)"
    r"|(?P<often>(?:每|天天|周末|晚上的|早上的).+)(?P<one>)",
)
_CHOICE = re.compile(r"\bor\b|,")
_UNTIL = form_pair(
    r"(?P<a>.+?) (?P<words>(?:until|till) (?P<t>.+)|for (?P<n>.+))",
    r"(?P<a>.+?)(?P<words>到(?P<t>.+?)|(?P<n>[半一二三四五六七八九十两\d]{1,3}个?(?:分钟|小时|天|周|星期)))",
)
_NOT_REMIND = form_pair(
    rf"(?:stop reminding me|(?:don't|do not|never) remind me)(?: (?:to|about|of|that) (?P<of>.+?))?{_TAIL}",
    r"(?:以后)?(?:不要|不用|别)(?:再)?提醒我?(?P<of>.*?)了?",
)
_NEVER_AGAIN = form_pair(
    rf"(?:(?:don't|do not|never|stop|no more) (?!let me|remind)(?P<t>)(?P<what>.+?)){_TAIL}",
    r"(?:以后|今后)?(?P<t>.*?)(?:都|就)?(?:不要|不用|别)再?(?P<what>[^别不了用要].*?)了?",
)
_IN_GENERAL = re.compile(
    r".+ (?:in the (?:morning|afternoon|evening)s?|at (?:night|noon|weekends?))"
)
_CALLS_NONE = re.compile(r"(?P<calls>提醒|叫|喊)?[说做弄去来动跑走吵]?(?:我们?)?")
"""What no order is called by: 晚上就别说了 is about talk, 周末就别叫了 of the order just given."""
_LEAVES_OUT = form_pair(
    r"(?:(?:don't|do not|you needn't|(?:you )?(?:don't|do not) (?:have|need) to|there's no need to|no) (?!more\b|forget\b|let me\b)"
    r"|(?:skip|leave out|cancel|drop) )(?P<rest>.+)",
    r"(?:把|跳过)?(?P<day>今晚|今天|今早|明天|明晚|明早|后天|[这下]?个?(?:周|星期|礼拜)[一二三四五六日天])的?"
    r"(?P<rest>(?:(?:就|先)?(?:不用|不要|不必|别)再?)?(?P<r>提醒我?)?(?P<a>.{0,20}?)(?:跳过|免了|了)?)",
)
_DENIED_ZH = re.compile(r"跳过|免了|(?<!要)不要|(?<!用)不用|不必|别")
"""要不要 and 用不用 ask."""
_SEVERAL = re.compile(
    r"[,;.:吗呢]|如果|但|\b(?:if|unless|until|till|before|after|when|or|but|only|then|every|each|at (?:\d|noon))\b"
)


def read_change(folded: str, *, chinese: bool) -> ChangeOrders | None:
    """Return which orders are removed, paused, resumed or left out on a day; None: none are."""
    if (skipped := _read_skip(folded, chinese)) is not None:
        return skipped
    if (reminding := _NOT_REMIND[chinese].fullmatch(folded)) is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    for act, form in _ACTS:
        found = form[chinese].fullmatch(folded)
        words = "".join(filter(None, found.groups())) if found is not None else ""
        named = (act == "pause" and _read_until(words, chinese)) or _read_name(act, words, chinese)
        if named:
            return named
    return _read_never_again(folded, chinese)


def _read_name(act: Act, words: str, chinese: bool) -> ChangeOrders | None:
    found = _NAMED[chinese].fullmatch(words)
    if found is None:
        again = chinese and reads_timing(words, in_chinese=True)
        return ChangeOrders(act, words) if again else None
    kind = found["kind"] or found["kind2"] or ""
    names = ("id", "of", "what", "often", "one", "called")
    which = next((found[name] for name in names if found[name]), "").strip(" 的")
    if _CHOICE.search(which) or (found["one"] and not reads_timing(which, in_chinese=False)):
        return None  # a second order, or a thing that is called one
    every = words.startswith(("all", "both", "every", "each", "所有", "全部"))
    alone = bool(kind) and not (which or every) and not kind.endswith("s")
    return ChangeOrders(
        act, which, reminders=kind.startswith(("reminder", "提醒")), is_every=every,
        is_single=alone and (act == "remove" or not chinese), is_sure=not found["called"],
    )  # fmt: skip


def _read_until(words: str, chinese: bool) -> ChangeOrders | None:
    """Read "the evening check until Monday", 每晚的检查到周一."""
    found = _UNTIL[chinese].fullmatch(words)
    named = _read_name("pause", found["a"], chinese) if found is not None else None
    if found is None or named is None:
        return None
    until = time_of(found["t"], chinese) if found["t"] else lasting(found["n"], chinese)
    end = end_of_pause(until)
    return None if end is None else replace(named, until=end, until_words=found["words"])


_NO_LONGER = ("any more", "longer")


def _read_never_again(folded: str, chinese: bool) -> ChangeOrders | None:
    """Read "don't greet people any more", 晚上别再检查门了: never "tonight", which is one day's."""
    found = _NEVER_AGAIN[chinese].fullmatch(folded)
    if found is None or _CHOICE.search(folded) is not None:
        return None
    what = found["what"]
    if not (chinese and found["t"]):
        again = reads_timing(what, in_chinese=chinese) and (not chinese or folded.endswith("了"))
        known = _IN_GENERAL.fullmatch(what) or (not chinese and folded.endswith(_NO_LONGER))
        return ChangeOrders("remove", what, is_sure=again) if again or known else None
    parts = time_of(found["t"], True)
    ever = re.search(r"再|以后|今后|了$", folded) is not None
    once = any(isinstance(part, (OnceDay, MonthDay)) for part in parts)
    days = all(isinstance(part, WeekDays) and part.days != EVERY_DAY for part in parts)
    daypart = all(isinstance(part, DayPart) for part in parts)
    bare = _CALLS_NONE.fullmatch(what)
    if not parts or not ever or once or (bare and (days or (daypart and not bare["calls"]))):
        return None
    again = not all(isinstance(part, (DayPart, TimeOfDay)) for part in parts)
    return ChangeOrders("remove", f"{found['t']}{what}", is_sure=again)


def _read_skip(folded: str, chinese: bool) -> ChangeOrders | None:
    """Read "don't wake me tomorrow", "skip the check tonight", 今晚的检查跳过, 明天不用提醒我."""
    found = _LEAVES_OUT[chinese].fullmatch(folded)
    if found is None or _SEVERAL.search(found["rest"]) is not None:
        return None
    if chinese:
        days = [part for part in time_of(found["day"], True) if isinstance(part, OnceDay)]
        denied = folded.startswith("跳过") or _DENIED_ZH.search(found["rest"]) is not None
        if not (denied and days and (found["a"] or found["r"])):
            return None
        which = re.sub(r"的?那[个条项]$", "", found["a"])
        return skip_day(which, days[0], found["day"], reminds=found["r"] is not None)
    said = found["rest"]
    for cut in re.finditer(r" ", said):
        parts = time_of(said[cut.end() :], False)
        day, part = (next((p for p in parts if isinstance(p, t)), None) for t in (OnceDay, DayPart))
        if not isinstance(day, OnceDay) or any(
            not isinstance(p, (OnceDay, DayPart)) for p in parts
        ):
            continue
        words = re.sub(r"^(?:the|my|your|our) | for$", "", said[: cut.start()])
        called = re.fullmatch(
            r"remind me(?: (?:to|about|of|that) (?P<a>.+))?|(?P<b>.*?) ?\b(?:reminders?|alarms?)",
            words,
        )
        by_id = re.fullmatch(r"(?:order |reminder )?(o\d{1,6})", words)
        which = by_id[1] if by_id else (called["a"] or called["b"] or "") if called else words
        if isinstance(part, DayPart) and day.ahead != 0:  # of two a day the one is meant
            which = f"{which} in the {part.value}".strip()
        return skip_day(which, day, said[cut.end() :], reminds=called is not None and not by_id)
    return None


def skip_day(which: str, day: OnceDay, words: str, *, reminds: bool) -> ChangeOrders:
    """Return that a day is left out of the order of these words; of one, where there are none."""
    return ChangeOrders("skip", which, reminders=reminds, day=day, until_words=words,
                        is_single=not which, is_sure=False)  # fmt: skip
