"""Read Chinese words about the standing orders that are kept: 有哪些提醒, 改成九点, 今晚的检查跳过, 取消提醒.

Pure, on folded text, whole sentences only; as ``english_about`` for the other language.
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
    ListOrders,
    RemindAgain,
    Retime,
    ask_days,
)
from planner.language.schedule.parts import (
    EVERY_DAY,
    After,
    DayPart,
    MonthDay,
    OnceDay,
    TimeOfDay,
    WeekDays,
    end_of_pause,
)
from planner.language.schedule.time_finder import reads_timing, whole_parts

if TYPE_CHECKING:
    from planner.language.schedule.command import Act, FoundChange
    from planner.language.schedule.parts import Part


KINDS = r"(?:提醒|定时任务|定时命令|定时|常规任务|日程安排|日程|闹钟)"
ALL = r"(?:所有|全部|一切)?的?(?:我的|你的|现有的|这些)?"
_WHAT = r"(?:什么|啥|些什么|哪些)(?:事情?|安排|计划|任务|提醒|活动)?"
_LIST = re.compile(
    rf"(?:现在|目前|一共|我|都|还|看看)*(?:有|(?:设置?|定|安排)了)(?:没有)?(?:哪些|什么|啥|几个)?{KINDS}"
    r"(?:在跑|没响)?(?:的)?(?:吗|啊)?"
    rf"|(?:列出|列一下|显示|看看|看一下|告诉我|说说|查看|查一下|念一下){ALL}(?:有(?:哪些|什么))?{KINDS}"
    rf"|把{ALL}{KINDS}(?:都)?(?:列出来|说一下|告诉我|念一下|念一遍)"
    r"|我(?:都)?(?:让|叫|要|请)你(?:定时)?(?:做|干)(?:了)?(?:什么|啥|哪些事情?)"
    rf"|{ALL}{KINDS}(?:都)?(?:有|是)(?:哪些|什么|啥|几个)"
)
_AT_TIME = re.compile(
    rf"(?:我)?(?:让|叫|要|请)?(?:你)?(?P<a>.+?)(?:我)?(?:都|会|要|打算|准备|还)*(?:让|叫|请)?你?"
    rf"(?:都|会|要)*(?:做|干|安排了?){_WHAT}(?:来着)?"
    rf"|(?P<b>.+?)(?:我|你|都|还|会)*(?:有没有|有)(?:{_WHAT}|安排|计划|事|任务|提醒)(?:吗|没有|要做)?"
    r"|(?P<c>.+?)的(?:安排|计划|日程|任务)(?:是(?:什么|啥))?"
)
_LONG = r"(?:多久|多少时间|多长时间|几分钟|多少分钟)(?:了)?"
_LEFT = re.compile(
    rf"(?:我)?还(?:有|剩|剩下){_LONG}|(?:离|距离?)?(?P<a>.*?{KINDS})(?:还有|还剩|还要){_LONG}"
)
_AT = r"(?:几点钟?|什么时候|什么时间|何时)"
_NEXT = re.compile(
    rf"{ALL}(?P<of>.*?)的?(?P<kind>{KINDS})(?:是|在|定在|设在)*{_AT}(?:啊|来着)?"
    rf"|(?:你)?(?:会|要|将)?(?:在)?{_AT}(?:会|要)?(?:提醒|叫)我(?P<of2>.*)"
)
_OFTEN = re.compile(r"每(?:天|日|晚|早|周|星期|个?工作日|个?小时|隔|半|次)|天天|周末|晚上的|早上的")
_ACTS: tuple[tuple[Act, str, str], ...] = (
    ("remove", r"取消|删除|删掉|去掉|清除|停止|停掉|关掉|结束|撤销", r"取消|删除|删掉|删了|去掉|关掉|停掉|停了|撤销"),
    ("pause", r"暂停|先停掉", r"暂停|停一停"),
    ("resume", r"恢复|继续|重新开始|启用|重新启用|开始", r"恢复|打开|启用"),
)  # fmt: skip
_NOT = r"(?:不要|不用|不必|不需要|别|甭|停止|不)(?:再)?"
_REMIND = re.compile(rf"(?:以后)?{_NOT}提醒(?:我)?(?P<of>.*?)(?:了)?")
_LASTS = r"[半一二三四五六七八九十两\d]{1,3}个?(?:分钟|小时|钟头|天|周|星期|礼拜)"
_PAUSED = re.compile(
    rf"(?:把)?(?P<a>.+?)(?:暂停|停)(?:到(?P<t>.+?)(?:为止)?|(?P<for>{_LASTS}))"
    rf"|暂停(?P<b>.+?)(?:(?:直到|到)(?P<t2>.+?)(?:为止)?|(?P<for2>{_LASTS}))"
)
_DAY = r"(?P<day>今晚|今天|今早|明天|明晚|明早|后天|(?:这个?|下个?)?(?:周|星期|礼拜)[一二三四五六日天])"
_SKIPS = re.compile(
    rf"(?:把)?{_DAY}的?(?P<a>.{{1,20}}?)(?:跳过|免了)(?:一次)?|跳过{_DAY.replace('day', 'day2')}的?(?P<b>.{{1,20}})"
    rf"|{_DAY.replace('day', 'day3')}(?:就|先)?(?:不用|不要|不必|别)再?(?P<r>提醒我?)?(?P<c>.{{0,20}}?)了?"
)
_ANYTHING = re.compile(r"(?:说|做|弄|去|来|动|跑|走|吵|闹|出声|说话|乱跑|到处跑|乱动)")
_CALLS = re.compile(r"(?:提醒|叫|喊|做|去|来|说|弄)(?:我们?)?")
"""What no order is called by: 晚上就别说了 is about talk, not about an order of the evening."""
_NO = r"(?:(?:不对|不是|不|错了|说错了|等等|等一下|抱歉|哦|噢)[,。!]+)*"
_CHANGE = r"(?:改成|改到|改为|改在|换成|换到|调到|调成|挪到|移到|推迟到|提前到)"
_RETIME = (
    re.compile(rf"{_NO}(?:还是)?(?:把?它|时间)?{_CHANGE}(?P<t>.+)"),
    re.compile(rf"{_NO}不是(?P<o>.+?),?(?:而)?是(?P<t>.+)"),
    re.compile(rf"{_NO}(?:我说的是|我是说|应该是|是)?(?P<t>.+?),(?:而)?不是(?P<o>.+)"),
    re.compile(rf"{_NO}(?:我说的是|我是说|应该是|还是)(?P<t>.+)"),
)
_RENAMED = re.compile(rf"(?:把|将)?(?P<w>.+?)(?:的)?(?:时间)?{_CHANGE}(?P<t>.+)")
_NONE = r"(?:(?:就|都|也|先)*(?:不用|不要|不必|不需要|别|免了?|除外|算了)(?:了|做|去|叫|喊|提醒|来|再|我们?(?!的))*)"
_LEAVES_OUT = re.compile(rf"{_NO}(?:但|但是)?(?:除了?)?(?P<d>.+?){_NONE}")
_KEEPS_TO = re.compile(
    rf"{_NO}(?:但|但是)?(?:只要?|仅|就)(?:在|限)?(?P<d>.+?)(?:就行|就好|就可以|才要|做|去|叫|提醒)?"
)
_LATER = re.compile(
    rf"{_NO}(?:(?:把|将)?(?P<w>.+?))??(?:给我)?(?P<way>(?:往后)?(?:推迟|延后|延迟|推)|晚|(?:往前)?提前|早|往[后前][挪推移调延])(?P<n>[^提推延挪]+?)"
)
_AGAIN = re.compile(
    r"(?:再|等|过|再过|再等)(?P<a>.+?)(?:之后|以后|后)?(?:再|就)?(?:叫|提醒|喊)我(?:一下|一次|一声)?"
    r"|(?P<c>.+?)(?:之后|以后|后)再(?:叫|提醒|喊)我(?:一下|一次|一声)?"
    r"|再(?:给我|睡|来|多)(?P<b>.+)|(?:等会儿?|待会儿?|一会儿?|过会儿?|稍后|晚点儿?)(?:再)?(?:叫|提醒|喊)我|贪睡"
)
_THAT = re.compile(r"的?[那这]一?[个条项]$")


def read_asked(folded: str) -> ListOrders | None:
    """Return what a sentence asks about standing orders; None where it asks nothing of them."""
    if _LIST.fullmatch(folded) is not None:
        return ListOrders()
    at_time = _AT_TIME.fullmatch(folded)
    if at_time is not None:
        words = next(text for text in at_time.groupdict().values() if text)
        return ask_days(_parts(words), words)
    left = _LEFT.fullmatch(folded)
    if left is not None:
        named = left["a"] or ""
        which = re.sub(r"^(?:我|你)的?", "", re.sub(rf"的?{KINDS}", "", named)).strip("的")
        return ListOrders(which, reminders="提醒" in named, next_runs=True, is_sure=bool(named))
    asked = _NEXT.fullmatch(folded)
    if asked is None:
        return None
    which = re.sub(r"^下一?个?的?", "", asked["of2"] or asked["of"] or "")
    reminds = asked["kind"] in (None, "提醒")
    return ListOrders(which.strip("的了"), reminders=reminds, next_runs=True)


def read_change(folded: str) -> ChangeOrders | None:
    """Return which orders are removed, paused, resumed or left out on a day; None: none are."""
    reminding = _REMIND.fullmatch(folded)
    if reminding is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    special = _read_skip(folded) or _read_paused(folded)
    if special is not None:
        return special
    for act, before, behind in _ACTS:
        found = re.fullmatch(
            rf"(?:{before})(?P<a>.+)|把(?P<b>.+?)(?:都)?(?:{behind})(?:了|吧)?", folded
        )
        named = _read_named(act, found["a"] or found["b"]) if found is not None else None
        if named is not None:
            return named
    unwanted = re.fullmatch(
        r"(?P<of>.{1,20}?)的?(?:那|这)一?[个条项](?:就)?(?:不要|不用|不需要|取消|删掉|去掉)了?",
        folded,
    )
    if unwanted is not None:
        return ChangeOrders("remove", unwanted["of"], is_sure=_is_timing(unwanted["of"]))
    denied = re.fullmatch(rf"{_NOT}(?P<what>.+?)了", folded)
    if denied is not None and _is_timing(denied["what"]):
        return ChangeOrders("remove", denied["what"])
    return _read_denied(folded)


def _read_denied(folded: str) -> ChangeOrders | None:
    """Read 晚上别再检查门了: not "tonight", which is one day's."""
    found = re.fullmatch(
        rf"(?:以后|今后)?(?P<t>.+?)(?:都|就)?{_NOT}(?P<what>[^别不了用要必需].*?)了?", folded
    )
    if found is None or not re.search(r"再|以后|今后|了$", folded):
        return None
    parts = _parts(found["t"])
    if not parts or any(isinstance(part, (OnceDay, MonthDay)) for part in parts):
        return None
    days = all(isinstance(part, WeekDays) and part.days != EVERY_DAY for part in parts)
    if days and _CALLS.fullmatch(found["what"]):
        return None  # 周末就别提醒了: days that the order of a moment ago leaves out
    if _ANYTHING.fullmatch(found["what"]) and all(isinstance(part, DayPart) for part in parts):
        return None
    again = not all(isinstance(part, (DayPart, TimeOfDay)) for part in parts)
    return ChangeOrders("remove", f"{found['t']}{found['what']}", is_sure=again)


def _read_skip(folded: str) -> ChangeOrders | None:
    """Read 今晚的检查跳过, 明天不用提醒我吃药, 今晚别去厨房了."""
    found = _SKIPS.fullmatch(folded)
    if found is None:
        return None
    words = found["day"] or found["day2"] or found["day3"]
    days = [part for part in _parts(words) if isinstance(part, OnceDay)]
    which = found["a"] or found["b"] or found["c"] or ""
    if len(days) != 1 or re.search(r"[,，吗呢?]|如果|但", which) or not (which or found["r"]):
        return None
    return ChangeOrders(
        "skip", _THAT.sub("", which), reminders=found["r"] is not None, day=days[0],
        is_single=not which, until_words=words, is_sure=False,
    )  # fmt: skip


def _read_paused(folded: str) -> ChangeOrders | None:
    """Read 把每晚的检查暂停到周一, 暂停提醒一周."""
    found = _PAUSED.fullmatch(folded)
    if found is None:
        return None
    until, lasts = found["t"] or found["t2"], found["for"] or found["for2"]
    end = end_of_pause(_parts(until if until is not None else f"{lasts}后"))
    named = _read_named("pause", found["a"] or found["b"])
    if named is None or end is None:
        return None
    return replace(named, until=end, until_words=f"到{until}" if until is not None else lasts)


def _read_named(act: Act, words: str) -> ChangeOrders | None:
    kind = re.fullmatch(rf"{ALL}(?P<of>.*?)的?(?P<kind>{KINDS})", words)
    if kind is not None:
        which, every = kind["of"].strip("的"), re.match(r"所有|全部|一切|这些", words) is not None
        return ChangeOrders(act, which, reminders=kind["kind"] == "提醒", is_every=every,
                            is_single=act == "remove" and not which and not every)  # fmt: skip
    by_id = re.fullmatch(r"(?:任务|提醒)?(o\d{1,6})", words)
    if by_id is not None:
        return ChangeOrders(act, by_id[1])
    if _OFTEN.match(words) is not None or _is_timing(words):
        return ChangeOrders(act, words)
    called = _THAT.sub("", words)
    return ChangeOrders(act, called, is_sure=False) if called != words and called else None


def read_correction(folded: str) -> CorrectOrder | ChangeOrders | None:
    """Return how a sentence moves an order, or which days it leaves out of it; None: it does not."""
    found = _read_again(folded) or _read_later(folded) or _read_days(folded) or _read_time(folded)
    if found is None or isinstance(found, ChangeOrders):
        return found
    change, which, words = found
    sure = re.search(r"提醒|闹钟|定时|[叫喊]我", which) is not None
    return CorrectOrder(change, words or folded, which, is_sure=sure)


def _read_again(said: str) -> FoundChange | None:
    found = _AGAIN.fullmatch(said)
    if found is None:
        return None
    lasts = found["a"] or found["b"] or found["c"]
    if lasts is None or lasts in ("一会儿", "一会", "会儿", "会"):
        return RemindAgain(), "", ""
    seconds = _lasts(lasts)
    return None if seconds is None else (RemindAgain(seconds), "", "")


def _read_later(said: str) -> FoundChange | None:
    found = _LATER.fullmatch(said)
    seconds = _lasts(found["n"]) if found is not None else None
    if found is None or seconds is None:
        return None
    early = re.search("前|早", found["way"]) is not None
    words = f"{'提前' if early else '推迟'}{found['n']}"
    return Delay(-seconds if early else seconds), _THAT.sub("", found["w"] or ""), words


def _read_days(said: str) -> FoundChange | ChangeOrders | None:
    """Read 周日不用, 只在工作日; 下周日不用 is that one day."""
    for pattern, keeps in ((_LEAVES_OUT, False), (_KEEPS_TO, True)):
        found = pattern.fullmatch(said)
        if found is None:
            continue
        part = _day_of(found["d"])
        if isinstance(part, WeekDays):
            return LeaveOutDays(part.days, keeps), "", ""
        if isinstance(part, OnceDay) and not keeps:
            return ChangeOrders("skip", "", day=part, until_words=found["d"], is_spoken=True,
                                is_sure=False)  # fmt: skip
    return None


def _day_of(words: str) -> Part | None:
    """Return the days that words name; a bare weekday is each of them."""
    bare = re.fullmatch(r"(?:周|星期|礼拜)[一二三四五六日天]", words) is not None
    parts = _parts(f"每{words}") if bare else _parts(words)
    return parts[0] if len(parts) == 1 else None


def _read_time(said: str) -> FoundChange | None:
    for pattern in _RETIME:
        found = pattern.fullmatch(said)
        if found is None:
            continue
        old = found.groupdict().get("o")
        parts, before = _parts(found["t"]), _parts(old) if old else ()
        if parts and (before or not old):
            return Retime(parts, before), "", ""
    found = _RENAMED.fullmatch(said)
    parts = _parts(found["t"]) if found is not None else ()
    if found is None or not parts:
        return None
    return Retime(parts), _THAT.sub("", found["w"]), f"改成{found['t']}"


def _parts(words: str) -> tuple[Part, ...]:
    return whole_parts(words, in_chinese=True)


def _is_timing(words: str) -> bool:
    return reads_timing(words, in_chinese=True)


def _lasts(words: str) -> float | None:
    parts = _parts(f"{words}后")
    return parts[0].seconds if len(parts) == 1 and isinstance(parts[0], After) else None
