"""Read how people drop a standing order in everyday words: "scrap the plumber one", 闹钟取消了.

Pure, on folded text, whole sentences only. Law: what names no reminder, no alarm, no standing order
and no time that comes again drops nothing ("forget the kitchen", 不要了).
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.asked import KINDS, ZH_KINDS
from planner.language.schedule.command import ChangeOrders

if TYPE_CHECKING:
    from planner.language.schedule.parts import ReadsTiming, ReadsWhole


_MORE = (
    r"(?: (?:any ?more|any longer|now|from now on|for good|please|after all|then|again|either))*"
)
_YOU = r"(?:(?:actually|you know what|oh|ah|well|no)[ ,]+)*(?:(?:you|we) (?:can|may|could|might as well|should) (?:now |also |actually )*|let's |just |please )*"
_DROPS = (
    r"(?:forget(?: about)?|scrap|bin|ditch|lose|axe|kill|cancel|delete|remove|drop|stop|end|clear"
    r"|get rid of|take off|call off|switch off|turn off|undo|wipe)"
)
_NEEDS = r"(?:(?:i|we) (?:don't|do not|no longer|won't) (?:need|want)|no more need for|(?:i am|i'm|we're|we are) done with)"
_ALL = r"(?:all (?:of )?|both (?:of )?|every (?:single |last )?|each )"
_THE = r"(?:the|my|your|our|that|this|those|these)"
_LOT = r"(?:[ ,]+(?:the (?:whole )?lot|all of them|every (?:single |last )?one))?"
_KIND = rf"(?P<kind>{KINDS}|tasks?|jobs?|errands?)"
_OF = r"(?: (?P<at>(?:in the (?:morning|afternoon|evening)|at (?:night|noon)|on (?:weekdays|weekends))s?))?(?: (?:for|about|to|of|at|with|on|that says?) (?P<of>.+?))?"
_NAMED = re.compile(
    rf"{_YOU}(?:{_DROPS}|{_NEEDS}) (?P<all>{_ALL})?(?:{_THE} )?(?:(?P<what>(?!of\b)[a-z0-9' -]+?) )??{_KIND}{_OF}{_MORE}{_LOT}"
)
_GONE = re.compile(
    rf"(?P<all>{_ALL})?(?:{_THE} )?(?:(?P<what>[a-z0-9' -]+?) )??{_KIND}{_OF}"
    r" (?:(?:can|should|may) (?:all )?(?:go|be (?:scrapped|dropped|deleted|removed|cancelled|canceled))"
    rf"|(?:isn't|is not|aren't|are not|is no longer|are no longer) (?:needed|necessary|wanted)){_MORE}"
)
_THING = r"(?:ones?|orders?|things?|business|stuff|idea|lark|routine|bit)"
_ONE = re.compile(
    rf"{_YOU}(?:{_DROPS}|{_NEEDS}|never ?mind(?: about)?|no more of) (?:the|that|this|your|my|all (?:the|that)) (?P<called>[a-z0-9' -]+?)"
    rf" {_THING}{_MORE}"
    rf"|(?:the|that|this|your|all that) (?P<gone>[a-z0-9' -]+?) {_THING} (?:can|should|may) (?:go|stop|be (?:dropped|scrapped|cancelled)){_MORE}"
    rf"|{_YOU}(?:{_DROPS}|{_NEEDS}|enough (?:of|with)) (?:the|that|my|your|our|these|those) (?P<called2>[a-z0-9' -]+?) (?:(?:calls?|watch|greetings?|rounds?|patrols?|checks?"
    rf"|visits?|runs?|trips?|laps?|service|announcements?|questions?|messages?|nudges?|alerts?|warnings?)){_MORE}"
)
_DEED = re.compile(
    r"(?:don't|do not|(?:you |we )?(?:needn't|need not|(?:don't|do not) (?:have|need) to)|(?:you |we )?(?:can|may|could) stop|stop|quit|never"
    r"|(?:i|we) (?:don't|do not) want you to) "
    r"(?!let me forget\b|forget\b)(?:bother (?:with |to )?|keep |go on )?(?P<deed>[a-z0-9' -]{3,60}?)"
    r" (?:any ?more|any longer|from now on|ever again)(?: please)?"
)
"""What was done again and again, and shall not be."""
_REMINDING = re.compile(
    r"(?:(?:you|we) )?(?:(?:can|may|could) (?:just )?(?:stop|quit|cease) reminding me"
    r"|(?:(?:don't|do not|needn't|need not|no longer)(?: (?:need|have)(?: to)?)?"
    r"|(?:there(?:'s| is) )?no (?:more )?need (?:for you )?to) (?:keep )?remind(?:ing)? me"
    r"|(?:i|we) (?:don't|do not|no longer) need (?:to be reminded|reminding|a reminder))"
    rf"(?: (?:to|about|of|that|for) (?P<of>.+?))?{_MORE}"
)
_TOLD = re.compile(
    rf"{_YOU}{_DROPS} (?:(?:all|everything)(?: of)?(?: the)?(?: things| jobs| tasks| stuff| orders)?|the things|what)(?: that)?"
    r" (?:i|we)(?:'ve| have)? (?:told|asked|got|made|given|set|want|wanted)(?: you)? (?:to do|doing|do)(?: (?P<when>.+?))?"
    rf"{_MORE}"
)
_ALL_ORDERS = re.compile(
    rf"{_YOU}{_DROPS} (?:{_ALL}(?:{_THE} )?(?:standing )?orders(?: (?:that )?i(?:'ve| have)? (?:given|gave)(?: you)?)?"
    rf"|(?:everything|all)(?: that)? (?:i|we)(?:'ve| have)? (?:set up|scheduled|planned)(?: (?:with|for) you)?){_MORE}"
)
_ZH_ALL = (
    r"(?:我?(?:给你)?(?:定|设|安排)的(?:那些|所有|全部)?|所有|全部|一切|每[一个条]+|这些|那些)"
)
_ZH_GO = (
    r"(?:都|全|全部|统统|通通|全都|给我|帮我|就|先|一起|可以|也|已经)*"
    r"(?:取消|删除|删|去掉|清除|清空|清|撤销|撤|关|停|作废|不要|不用|不需要|免)(?:掉|了|吧|啦|算了)*"
)
_ZH_KIND = re.compile(
    rf"(?:把|将)?(?P<all>{_ZH_ALL})?的?(?:我的|你的)?(?P<of>.*?)的?(?P<kind>{ZH_KINDS}){_ZH_GO}"
)
_ZH_DROP = re.compile(
    rf"(?:取消|删除|删掉|删了|去掉|清空|清掉|撤销|关掉|停掉|不要|不用)(?:掉|了)?(?P<all>{_ZH_ALL})?的?(?P<of>.*?)的?(?P<kind>{ZH_KINDS})(?:了|吧)?"
)
_ZH_ONE = re.compile(
    rf"(?:把|将)?(?P<of>.{{1,20}}?)的?(?:那|这)一?[个条项件](?P<more>[^,]{{1,10}}?的)?,?{_ZH_GO}"
)
_ZH_NTH = re.compile(
    rf"(?:把|将)?(?P<of>第[一二三四五])(?:个|条|项)(?:定时|提醒|任务|闹钟)*(?!问题|房间){_ZH_GO}"
)
_ZH_REMIND = re.compile(
    r"(?:以后|今后|从今天起)?(?:都|就)?(?:不要|不用|不必|不需要|别|甭|用不着|无需)(?:你)?(?:再)?(?:来)?(?:提醒|催)我?(?P<of>.*?)(?:的事情?)?了?"
)
_ZH_TOLD = re.compile(
    r"(?:把)?我(?:都)?(?:让|叫|要|请|安排|交代)(?:给)?你(?:每天|天天|定时|平时|按时)?(?:做|干|办)?的(?:那些)?(?:事情?|活儿?|任务|东西)?"
    rf"{_ZH_GO}"
)
_ZH_THAT = re.compile(r"的?[那这]一?[个条项]$")
_SEVERAL = re.compile(
    r"\b(?:or|unless|if|but|then)\b|\band (?:the|my|your|go|come|tell|drive)\b|还是|或者?|如果|要是|然后"
)
"""A choice, a condition or a second order: nothing is dropped."""
_ASKS_ZH = re.compile(r"[吗呢?？]|什么|几|哪|谁|没有?$")


def read_removal(
    folded: str, reads: ReadsTiming, whole: ReadsWhole, *, chinese: bool
) -> ChangeOrders | None:
    """Return what a sentence drops; None where it drops no standing order."""
    if _SEVERAL.search(folded) is not None:
        return None
    return _read_chinese(folded, reads) if chinese else _read_english(folded, whole)


def _read_english(folded: str, whole: ReadsWhole) -> ChangeOrders | None:
    reminding = _REMINDING.fullmatch(folded)
    if reminding is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    told = _TOLD.fullmatch(folded)
    if told is not None:
        when = told["when"] or ""
        timed = not when or whole(when, in_chinese=False) or whole(f"on {when}", in_chinese=False)
        return ChangeOrders("remove", when, is_every=True) if timed else None
    if _ALL_ORDERS.fullmatch(folded) is not None:
        return ChangeOrders("remove", "", is_every=True)
    for pattern in (_NAMED, _GONE):
        found = pattern.fullmatch(folded)
        if found is not None:
            named = (found["what"] or "", found["of"] or "", found["at"] or "")
            which = " ".join(each.strip() for each in named if each)
            every, kind = found["all"] is not None, found["kind"]
            if not which and kind.rstrip("s") in ("task", "job", "errand"):
                return None  # "cancel the task": what is under way
            single = not which and not every and not kind.endswith("s")
            reminds = kind.startswith("reminder")
            return ChangeOrders(
                "remove", which, reminders=reminds, is_single=single, is_every=every,
                is_sure=kind.rstrip("s") not in ("task", "job", "errand"),
            )  # fmt: skip
    one = _ONE.fullmatch(folded)
    if one is not None:
        called = one["called"] or one["gone"] or one["called2"]
        return ChangeOrders("remove", called, is_sure=False)
    deed = _DEED.fullmatch(folded)
    return ChangeOrders("remove", deed["deed"], is_sure=False) if deed is not None else None


def _read_chinese(folded: str, reads: ReadsTiming) -> ChangeOrders | None:
    if _ASKS_ZH.search(folded):
        return None
    reminding = _ZH_REMIND.fullmatch(folded)
    if reminding is not None:
        return ChangeOrders("remove", reminding["of"] or "", reminders=True)
    if _ZH_TOLD.fullmatch(folded) is not None:
        return ChangeOrders("remove", "", is_every=True)
    for pattern in (_ZH_KIND, _ZH_DROP):
        found = pattern.fullmatch(folded)
        if found is not None:
            which, every = _ZH_THAT.sub("", found["of"].strip("的我你给")), found["all"] is not None
            return ChangeOrders(
                "remove", which, reminders=found["kind"] == "提醒", is_every=every,
                is_single=not which and not every and "全" not in folded and "都" not in folded,
            )  # fmt: skip
    nth = _ZH_NTH.fullmatch(folded)
    if nth is not None:
        return ChangeOrders("remove", nth["of"], is_sure=False)
    one = _ZH_ONE.fullmatch(folded)
    if one is None or re.match(r"[我你他她它]$", one["of"]):
        return None
    which = f"{one['of']}{(one['more'] or '').removesuffix('的')}"
    return ChangeOrders("remove", which, is_sure=reads(one["of"], in_chinese=True))
