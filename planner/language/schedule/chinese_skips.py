"""Read that orders are left out for now, or on some days, in Chinese: 周末就不用叫了, 晚安那个先停了.

Pure, on folded text, whole sentences only. Law: what is left out for a while or on some days is
dropped for good by none of these.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.asked import ZH_KINDS
from planner.language.schedule.chinese_corrections import ChineseCorrections
from planner.language.schedule.command import ChangeOrders, CorrectOrder, LeaveOutDays
from planner.language.schedule.parts import After, OnceDay
from planner.plan.timing import InRule

if TYPE_CHECKING:
    from planner.language.schedule.command import OrderCommand
    from planner.language.schedule.parts import ReadsWhole

_LASTS = r"(?P<lasts>[半一二三四五六七八九十两\d]{1,3}个?(?:分钟|小时|钟头|天|周|星期|礼拜))"
_STOPPED = re.compile(
    r"(?:把|将)?(?P<w>[^,]{1,20}?)的?(?:[那这]一?[个条项件])?(?:都)?"
    rf"(?:先(?:给我|帮我)?(?:暂停|停掉|停|关掉|关)(?:了|一下|一停|着)?{_LASTS}?|(?:停|关)(?:掉|上)?{_LASTS.replace('lasts', 'lasts2')})"
)
_TODAY = re.compile(
    r"(?P<day>今天|今日|今晚|今早)(?:就|先|都)*(?:(?:不用|不要|不必|别|免)(?:再)?(?:了|说|叫|去|做|提醒|来)*|算了|跳过|休息|停一?天)"
    r",(?:.{1,12},)?(?:明天|明晚|明早|后面|之后|以后)(?:起|开始)?(?:再|还是|还|又|照|就|继续|接着)*"
    r"(?:照旧|照常|继续|恢复|开始|来|说|叫|做|一样|照样|不变)(?:吧|就行|就好)?"
)
_NO_REMINDER = re.compile(
    r"(?P<day>今天|今日|今晚|今早)(?:就|先|都)*(?:不用|不要|不必|别)(?:再)?(?:提醒|催)(?:我们?)?了?"
)
_ANYTHING = re.compile(r"[我你他她它]们?|车|灯|电视|音乐|先|都")


def read_chinese_skip(folded: str, whole: ReadsWhole) -> OrderCommand | None:
    """Return which orders are left out, and when; None where the sentence says no such thing."""
    found = ChineseCorrections(whole).read(folded)
    if found is not None and isinstance(found[0], LeaveOutDays) and not found[1]:
        return CorrectOrder(found[0], found[2] or folded, "", is_sure=False)
    today = OnceDay(ahead=0)
    if _TODAY.fullmatch(folded) is not None:
        return ChangeOrders(
            "skip", "", is_single=True, day=today, until_words="今天", is_sure=False
        )
    if _NO_REMINDER.fullmatch(folded) is not None:
        return ChangeOrders(
            "skip", "", reminders=True, is_single=True, day=today, until_words="今天",
            is_sure=False,
        )  # fmt: skip
    return _read_stopped(folded, whole)


def _read_stopped(folded: str, whole: ReadsWhole) -> ChangeOrders | None:
    """Read 晚安那个先停了, 把叫起床那个停一个星期: for good is said in other words."""
    found = _STOPPED.fullmatch(folded)
    if found is None or _ANYTHING.fullmatch(found["w"]):
        return None
    lasts = found["lasts"] or found["lasts2"]
    kind = re.fullmatch(rf"(?:我的|所有的?|全部)?(?P<of>.*?)的?(?P<kind>{ZH_KINDS})", found["w"])
    if kind is not None:
        which, reminds = kind["of"], kind["kind"] == "提醒"
        if lasts is None:
            return ChangeOrders("pause", which, reminders=reminds)
    else:
        which, reminds = found["w"], False
    if lasts is None:
        return ChangeOrders("pause", which, is_sure=False)
    parts = whole(f"{lasts}后", in_chinese=True)
    if len(parts) != 1 or not isinstance(parts[0], After):
        return None
    until = InRule(seconds=parts[0].seconds)
    return ChangeOrders(
        "pause", which, reminders=reminds, until=until, until_words=lasts, is_sure=kind is not None
    )
