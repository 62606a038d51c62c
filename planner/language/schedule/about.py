"""Read words about the standing orders that are kept: list them, remove, pause, resume some.

Which orders are meant is for their keeper to find (``planner.orders.selection``); here their words
are cut out. Only what names a standing order, a reminder or a time that comes again is one of these
sentences: "cancel the drive" is the goal's. Pure.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Literal, Protocol

from planner.language.schedule.command import ChangeOrders, ListOrders

if TYPE_CHECKING:
    from planner.language.schedule.command import OrderCommand

    Act = Literal["remove", "pause", "resume"]


class ReadsTiming(Protocol):
    """Tell whether a text is, or ends with, a time that comes again."""

    def __call__(self, folded: str, *, in_chinese: bool) -> bool: ...


_KINDS = (
    r"(?:reminders?|standing orders?|routines?|schedules?|scheduled (?:tasks?|orders?|jobs?)"
    r"|timers?|alarms?|recurring (?:tasks?|orders?)|daily (?:tasks?|orders?))"
)
_OFTEN = (
    r"(?:evening|morning|afternoon|night|nightly|daily|hourly|weekly|weekday|weekend|noon|monday"
    r"|tuesday|wednesday|thursday|friday|saturday|sunday|recurring|scheduled|standing)"
)
_MY = r"(?:all (?:of )?)?(?:the|my|your|our|this|that|those|these)? ?"
_LIST = re.compile(
    r"what (?:do you do|will you do|are you going to do|have you planned|do you have planned)"
    rf"(?: for| on)? (?:every|each|today|tonight|tomorrow|this)\b.*|what do you do (?:regularly|by yourself)"
    rf"|(?:what|which) (?:are )?{_MY}{_KINDS}(?: (?:do (?:i|you|we) have|are (?:there|set|active)"
    rf"|have i (?:set|given)|are you keeping))?|what(?: is|'s) (?:on )?(?:the|my|your) schedule"
    rf"|(?:list|show|read|tell)(?: me)?(?: out)? {_MY}{_KINDS}|do i have (?:any )?{_KINDS}"
    rf"|(?:are there|is there) (?:any )?{_KINDS}"
    rf"|(?:what|which) {_KINDS} (?:have i got|do i have|did i set|have i made|are on)"
)
_ACTS: tuple[tuple[Act, str], ...] = (
    ("remove", r"cancel|delete|remove|drop|stop|end|forget|clear|get rid of|no more|turn off"
     r"|switch off|call off|don't do|do not do|quit|abolish"),
    ("pause", r"pause|suspend|put on hold|mute|skip"),
    ("resume", r"resume|continue|restart|unpause|re-?enable|turn on|switch on|start|carry on with"),
)  # fmt: skip
_TAIL = r"(?: (?:any ?more|any longer|again|for now|for good|from now on|now|please))*"
_NAMED = re.compile(
    rf"(?:{_MY}(?P<kind>{_KINDS})(?: (?:for(?! now)|about|to|of|at|with|that says?) (?P<of>.+?))?"
    rf"|{_MY}(?P<what>.+?) (?P<kind2>{_KINDS})"
    rf"|(?:the |my |your )?(?P<often>{_OFTEN}(?: (?!again\b)[\w'-]+){{1,3}})"
    r"|(?:standing )?(?:order|reminder|number)? ?(?P<id>o\d{1,6})"
    rf"|the one(?:s)? (?P<one>.+?)){_TAIL}"
)
_REMINDING = re.compile(
    rf"(?:(?:stop|quit|cease) reminding me|(?:don't|do not|never) remind me)"
    rf"(?: (?:to|about|of|that) (?P<of>.+?))?{_TAIL}"
)
_NOT_ANY_MORE = re.compile(
    rf"(?:don't|do not|never|stop|quit|no more) (?!let me forget)(?P<what>.+?){_TAIL}"
)

_ZH_KINDS = r"(?:提醒|定时任务|定时命令|定时|常规任务|日程|日程安排|闹钟)"
_ZH_OFTEN = r"(?:每天|每日|每晚|每早|每周|每星期|每个?工作日|每个?小时|每隔|每半|天天|周末|晚上的|早上的|每次)"
_ZH_ALL = r"(?:所有|全部|一切)?的?(?:我的|你的|现有的|这些)?"
_ZH_LIST = re.compile(
    r"(?:每天|每晚|今天|明天|今晚|平时|定时)(?:都|会|要|打算|准备|还|有)*(?:做|干|安排了?)(?:什么|啥|些什么|哪些事情?)(?:事情?)?"
    rf"|(?:现在|目前|一共|我|都)*有(?:没有)?(?:哪些|什么|几个)?{_ZH_KINDS}(?:吗)?"
    rf"|(?:列出|列一下|显示|看看|看一下|告诉我|说说|查看|查一下){_ZH_ALL}(?:有(?:哪些|什么))?{_ZH_KINDS}"
    rf"|把{_ZH_ALL}{_ZH_KINDS}(?:都)?(?:列出来|说一下|告诉我|念一下)"
    rf"|(?:现在|目前|我|都)*(?:设置?|定|安排)了(?:哪些|什么){_ZH_KINDS}啊?"
)
_ZH_NOT = r"(?:不要|不用|不必|不需要|别|甭|停止|不)(?:再)?"
_ZH_REMIND = re.compile(rf"{_ZH_NOT}提醒(?:我)?(?P<of>.*?)(?:了)?")
_ZH_ACTS: tuple[tuple[Act, str, str], ...] = (
    ("remove", r"取消|删除|删掉|去掉|清除|停止|停掉|关掉|结束|撤销", r"取消|删除|删掉|删了|去掉|关掉|停掉|停了|撤销"),
    ("pause", r"暂停|先停掉", r"暂停|停一停"),
    ("resume", r"恢复|继续|重新开始|启用|重新启用|开始", r"恢复|打开|启用"),
)  # fmt: skip


def read_about(folded: str, reads: ReadsTiming, *, chinese: bool) -> OrderCommand | None:
    """Return what a sentence says about the orders that are kept; None where it says nothing."""
    if chinese:
        return _read_chinese(folded, reads)
    if _LIST.fullmatch(folded) is not None:
        return ListOrders()
    reminding = _REMINDING.fullmatch(folded)
    if reminding is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    for act, verbs in _ACTS:
        verb = re.match(rf"(?:{verbs}) ", folded)
        if verb is not None:
            found = _read_named(act, folded[verb.end() :], reads)
            if found is not None:
                return found
    denied = _NOT_ANY_MORE.fullmatch(folded)
    if denied is not None and reads(denied["what"], in_chinese=False):
        return ChangeOrders("remove", denied["what"])
    return None


def _read_named(act: Act, rest: str, reads: ReadsTiming) -> ChangeOrders | None:
    found = _NAMED.fullmatch(rest)
    if found is None:
        return None
    kind = found["kind"] or found["kind2"] or ""
    which = found["of"] or found["what"] or found["often"] or found["id"] or found["one"] or ""
    if found["one"] and not reads(found["one"], in_chinese=False):
        return None
    return ChangeOrders(act, which.strip(), reminders="reminder" in kind)


def _read_chinese(folded: str, reads: ReadsTiming) -> OrderCommand | None:
    if _ZH_LIST.fullmatch(folded) is not None:
        return ListOrders()
    reminding = _ZH_REMIND.fullmatch(folded)
    if reminding is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    for act, before, behind in _ZH_ACTS:
        found = re.fullmatch(rf"(?:{before})(?P<a>.+)|把(?P<b>.+?)(?:都)?(?:{behind})", folded)
        named = _zh_which(found["a"] or found["b"], reads) if found is not None else None
        if named is not None:
            return ChangeOrders(act, named[0], reminders=named[1])
    denied = re.fullmatch(rf"{_ZH_NOT}(?P<what>.+?)了", folded)
    if denied is not None and reads(denied["what"], in_chinese=True):
        return ChangeOrders("remove", denied["what"])
    return None


def _zh_which(words: str, reads: ReadsTiming) -> tuple[str, bool] | None:
    """Return which orders are meant, and whether only reminders; None where none is named."""
    kind = re.fullmatch(rf"{_ZH_ALL}(?P<of>.*?)的?(?P<kind>{_ZH_KINDS})", words)
    if kind is not None:
        return kind["of"].strip("的"), kind["kind"] == "提醒"
    if re.fullmatch(r"(?:任务|提醒)?(?:o\d{1,6})", words):
        return words, False
    often = re.match(_ZH_OFTEN, words)
    return (words, False) if often is not None or reads(words, in_chinese=True) else None
