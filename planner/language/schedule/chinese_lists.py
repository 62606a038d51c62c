"""Read Chinese questions for the list of standing orders: 你手里都有哪些定时的活儿, 明天要提醒我啥.

Pure, on folded text, whole sentences only. Law: every word of the sentence is one of those that
people ask with; it names standing orders or reminders, and asks or bids to tell them. What is over
(提醒了我什么, 提醒过) is asked of the memory, and is none of these.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.schedule.command import ListOrders
from planner.language.schedule.parts import OnceDay

if TYPE_CHECKING:
    from planner.language.schedule.parts import ReadsWhole

_THING = r"(?:事情|事儿?|活儿?|任务|工作)"
_KIND = (
    r"(?:提醒(?!我|你|[他她])|定时任务|定时命令|常规任务|日程安排|日程|闹钟|定时(?!做|干)的?"
    rf"(?:{_THING})?|(?:定|设|安排|说|记)好了?的{_THING}|(?:每天|每周|平时|按时|定时)(?:都|要|该|得|会|固定)*(?:做|干)的{_THING})"
)
_DOES = (
    rf"(?:要|会|该|得|让你|叫你|请你)*提醒我(?:的{_THING}?)?"
    r"|(?:每天|每周|平时|按时|定时)(?:都|要|该|得|会|固定)*(?:做|干)"
)
_ASKS = rf"(?:哪些|哪几个|哪几样|什么|啥|几个|几样|多少个?|些什么|些啥)(?:{_THING})?"
_BIDS = (
    r"(?:列一?下|列出来?|列|念一?念|念一下|念|报一?下|报|说说|讲讲|查一?查|查一下|查看|看看|看一下|数数|说一下|讲一下|告诉我|给我听)"
    r"(?:一遍)?"
)
_GAVE = (
    r"(?:给|让|叫|请|跟|替|要)你|(?:设置?|定|安排|布置|交代|吩咐|记|存|说)(?:着|过|了|好|下|住)?的?"
)
_LITTLE = (
    r"[你您我都还有是把个的要会着]|现在|目前|眼下|手里|手头|手上|这儿|一共|总共|到底|已经|之前|以前|帮我|给我|所有|全部|记得"
    r"|没响|没到|没做|在跑|要做|一遍|来着|规矩"
)
_DAY = re.compile(
    r"(?:今天|明天|后天|每天|今早|明早|今晚|明晚|每晚|每早|每?个?工作日|每?个?周末|(?:每|下|这|本)?(?:周|星期|礼拜)[一二三四五六日天]?)"
    r"(?:早上|上午|中午|下午|晚上|夜里)?"
)
_WHOLE = re.compile(
    rf"(?>{_KIND}|{_DOES}|{_ASKS}|{_BIDS}|{_GAVE}|{_LITTLE})+(?:吗|呢|啊|呀|来着|没有)?"
)
_NAMED = re.compile(rf"{_KIND}|{_DOES}|(?:给|让|叫|请|跟|替)你(?:设置?|定|安排)的?规矩")
_WANTED = re.compile(rf"{_ASKS}|{_BIDS}|吗$")


def read_list(folded: str, whole: ReadsWhole) -> ListOrders | None:
    """Return which orders a sentence asks to be told; None where it asks for no list of them."""
    if _is_list(folded):
        return ListOrders(which="每周" if folded.count("每周") else "")
    day = _DAY.search(folded)
    if day is None or not _is_list(folded[: day.start()] + folded[day.end() :]):
        return None
    parts = whole(day[0], in_chinese=True)
    once = next((part for part in parts if isinstance(part, OnceDay)), None)
    if once is not None and len(parts) == 1:
        return ListOrders(day=once)
    return ListOrders(day[0]) if parts else None


def _is_list(said: str) -> bool:
    return (
        _WHOLE.fullmatch(said) is not None
        and _NAMED.search(said) is not None
        and _WANTED.search(said) is not None
        and not (said.startswith("提醒我") and re.search(_ASKS, said) is None)
    )
