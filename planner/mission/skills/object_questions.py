"""Tell whether a question is about one kind of thing that the eyes do not know. Pure.

"Do you see a piano?", "厨房里有没有钢琴": yes or no needs eyes that know pianos, and no drive helps
eyes that do not. Only what surely is such a question counts. An open one ("what is there?"), one
about people, about things of many kinds ("any toys?") or about a state ("is it tidy?", 有没有关好)
is looked at, and so is whatever is not understood.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from planner.language.color_names import CHINESE
from planner.language.folding import CHINESE as _HAN
from planner.language.folding import fold_words, has_chinese
from planner.language.object_names import resolve
from planner.mission.skills.object_matching import READ, mentioned
from planner.plan import Language

if TYPE_CHECKING:
    from collections.abc import Iterable

    from planner.mission.state import SiteView

_WHERE_EN = (
    r"(?: (?:here|there|anywhere|somewhere|nearby|left|too|(?:right )?now|at all|in sight|ahead))*"
    r"(?: (?P<where>(?:in|on|at|under(?:neath)?|below|beneath|near|by|beside|inside|behind|around"
    r"|outside|next to|close to) .+))?"
)
_A = r"(?:(?:an?|any|some|another|the|my|our|your|his|her|their|this|that|these|those) )"
_NOUN_EN = r"(?P<what>[a-z][a-z'-]*(?: [a-z][a-z'-]*){0,2}?)"
_EN = re.compile(
    r"(?:(?:please|hey|and|so|ok|now)[ ,]+)*"
    r"(?:(?:is|are) there |(?P<sees>(?:do|can|could|did) you see )"
    r"|[a-z, ]{0,30}\b(?:check|see|look|tell me|tell us|know|find out|say) (?:if|whether) "
    r"(?:there (?:is|are) |(?P<may>you (?:can )?see )))"
    rf"(?P<a>{_A})?{_NOUN_EN}{_WHERE_EN}"
)
_IS_IT_EN = re.compile(rf"(?:is|are) {_A}{_NOUN_EN}(?: still| now)?(?= ){_WHERE_EN}")
_NO_NOUN_EN = re.compile(
    r"\b(?:about|and|as|at|but|by|for|from|in|into|it|like|not|of|off|on|or|out|over|than|that|the"
    r"|to|up|what|when|where|which|who|with|without|you|me|him|them|us|he|she|they|else|enough|lots?"
    r"|many|more|most|much|ones?|others?|any|some|all|both|less|few|open|closed|shut|wrong|missing"
    r"|free|available|ready|broken|new|different|strange)\b"
)
_VAGUE_EN = re.compile(
    r"(?:thing|stuff|something|anything|everything|nothing|object|item|kind|sort|type|food|drink"
    r"|meal|furniture|animal|pet|fruit|vegetable|toy|clothe|clothing|dish|tableware|cutlery|vehicle"
    r"|appliance|device|electronic|container|obstacle|trash|rubbish|garbage|litter|dirt|dust|mess"
    r"|space|room|place|way|light|sound|noise|smell|movement|activity|change|problem|danger|damage"
    r"|difference|reason|chance|need|point|sign|text|word|number|colou?r|view|people|crowd|group"
    r"|family|friend|neighbou?r|stranger|burglar|thief|intruder|(?:grand)?(?:mother|father|ma|pa)"
    r"|mom|mum|dad|parent|son|daughter|brother|sister|wife|husband|aunt|uncle|doctor|nurse|teacher"
    r"|student|worker|owner)(?:e?s)?"
)
_ASKS_ZH = r"(?:吗|么|嘛|呢|啊)?"
_SEE_ZH = r"(?:看得?[到见]|发现|见到)"
_UNIT = r"[个只张把台架辆本瓶杯盆棵株扇条件副双支部块面口盏头匹颗]"
_NOUN_ZH = (
    rf"(?P<unit>(?:[一二两三几]|\d+)?{_UNIT}(?!子))?(?:[我你您他她]们?的)?"
    rf"(?P<what>(?:(?:{CHINESE})(?:的|(?<=色)))?(?P<noun>[{_HAN}]{{1,6}}?))"
)
_AT_ZH = (
    r"(?P<at>[^有看]{0,12}?)(?P<in>(?:里|内|上|下|旁|边|底|前|后|附近|周围|中间|门口)[面边下]?"
    r"|[那这][里儿边])?"
)
LEAD_ZH = (
    r"(?:请|麻烦)?[你您]?(?:帮我|给我|替我)?(?:去|到)?"
    r"(?:看一看|看一眼|看看|看一?下|瞧瞧|检查一?下?|查看一?下?|确认一?下?|观察一?下?|告诉我)?"
)
_SEES_ZH = re.compile(
    rf"[你您]?(?P<q>能不能|有没有|是否)?能?{_SEE_ZH}[了过]?{_NOUN_ZH}(?P<end>了?(?:吗|没有|没|么))?"
)
_ZH = re.compile(
    rf"{LEAD_ZH}(?:{_AT_ZH})?{LEAD_ZH}[还都]?(?:现在)?"
    rf"(?:(?:有没有|是否有|是不是有|有无){_NOUN_ZH}(?:在(?P<where>.{{1,12}}))?{_ASKS_ZH}"
    rf"|有(?!.*在){_NOUN_ZH.replace('>', '_2>')}[吗么嘛])"
)
_IS_IT_ZH = re.compile(
    rf"{LEAD_ZH}{_NOUN_ZH}(?:现在)?还?"
    r"(?:(?:在不在|是不是在|是否在)(?P<where>.{0,12})|在(?P<where_2>.{1,12})[吗么嘛])"
)
_NO_NOUN_ZH = re.compile(r"[的了着过吗呢啊没不在是和或跟与被把给有人谁什么哪几多少么怎物事]")
_VAGUE_ZH = re.compile(
    r"东西|问题|危险|异常|情况|变化|动静|声音|味道|地方|空间|[空座]位|位置|位子|垃圾|灰尘|饮料|水果"
    r"|玩具|家具|电器|餐具|衣服|需要|可能|办法|时间|小偷|老师|医生|护士|学生|同学|朋友|邻居|亲戚"
    r"|保姆|阿姨|叔|爷|奶奶|外[公婆]|爸|妈|哥|姐|弟|妹|老[公婆]|[先女]"
)
_VERB_ZH = re.compile(
    r"[开关锁收漏下坐站躺睡醒来去走到回吃喝做打看见发变弄整玩修坏倒掉丢放摆挂停亮响动洗擦扫拖搬拿"
    r"送装拆换充插拔点烧煮炒切起出进上跑哭笑说叫喊听闻摔碰撞撒洒流滴堵断裂破烂湿脏乱空满好准完"
    r"能会想该可应必](?!.*(?:.机|[器具鞋垫])$)"
)
"""有没有 asks for what was done as well as for what is there; a thing's name may begin so, too."""
_NAME_ZH = re.compile(r"[小老阿].{1,2}|[王李张刘陈杨黄赵吴周徐孙马朱胡郭何高林罗郑梁].{1,2}")
"""Who is seen may be somebody by name."""
_ENDS = re.compile(r"^[ .,!?。]+|[ .,!?。]+$")


class Asked(NamedTuple):
    """Say what a question asks for, in its words."""

    what: str
    certain: bool = False
    """It is a kind of thing though no table names it."""
    where: str = ""
    """Where it is to be: ``on the table``, ``桌子上``; empty: nowhere in particular."""


def unknown_kind(
    question: str, facts: SiteView, language: Language, classes: tuple[str, ...]
) -> str | None:
    """Return the one kind that a question asks for and eyes with these classes don't know.

    None where it asks for anything else, for what they know, or for a room or place of the site,
    and where it is not known yet what they know.
    """
    for what, certain, _ in _asked(question, facts) if classes else ():
        if resolve(what, language, classes) is None and (
            resolve(what, language) is not None or (certain and mentioned(what, classes) is None)
        ):
            return what
    return None


def asked_for(question: str, facts: SiteView) -> Asked | None:
    """Return what a question asks for, yes or no, apart from where; None where that is open.

    "Is there a cup next to the sofa?" asks for no sofa.
    """
    return next(iter(_asked(question, facts)), None)


def plain(question: str) -> str:
    """Return a question in one way of writing; nothing of one that is too long to be read."""
    text = _ENDS.sub("", fold_words(question))
    return text if len(text) <= READ else ""


def in_chinese(text: str) -> bool:
    """Tell whether words are Chinese."""
    return has_chinese(text)


def _asked(question: str, facts: SiteView) -> Iterable[Asked]:
    text = plain(question)
    return (_in_chinese if in_chinese(text) else _in_english)(text, facts)


def _in_english(text: str, facts: SiteView) -> Iterable[Asked]:
    found, places = _EN.fullmatch(text), _names(facts)
    if found is not None:
        named = not found["a"] and (found["sees"] or found["may"])  # Mary may be seen, no cat
        what, head = found["what"], found["what"].split()[-1]
        vague = _VAGUE_EN.fullmatch(head) is not None or _NO_NOUN_EN.search(what) is not None
        certain = not (named or vague) and what not in places
        yield Asked(what, certain, found["where"] or "")
    found = _IS_IT_EN.fullmatch(text)
    if found is not None:
        yield Asked(found["what"], where=found["where"] or "")


def _in_chinese(text: str, facts: SiteView) -> Iterable[Asked]:
    closed = text.replace(" ", "")
    found = _SEES_ZH.fullmatch(closed)
    if found is not None and (found["q"] or found["end"]):
        noun = found["noun"]
        certain = _noun(noun, found["unit"]) and not _NAME_ZH.fullmatch(noun)
        yield Asked(found["what"], certain)
        return
    found = _ZH.fullmatch(closed)
    if found is not None and (not found["at"] or found["in"] or found["at"] in _names(facts)):
        noun, unit = found["noun"] or found["noun_2"], found["unit"] or found["unit_2"]
        where = found["where"] or f"{found['at'] or ''}{found['in'] or ''}"
        yield Asked(found["what"] or found["what_2"], _noun(noun, unit), where)
    found = _IS_IT_ZH.fullmatch(closed)
    if found is not None:
        yield Asked(found["what"], where=found["where"] or found["where_2"] or "")


def _noun(what: str, unit: str | None) -> bool:
    """Tell whether a run of characters is surely the name of one kind of thing."""
    if len(what) < 2 or _NO_NOUN_ZH.search(what) or _VAGUE_ZH.search(what):
        return False
    return unit is not None or _VERB_ZH.match(what) is None


def _names(facts: SiteView) -> frozenset[str]:
    """Return what the rooms are called: a room is asked for by its state, not by sight."""
    return frozenset(
        fold_words(name)
        for t in facts.targets.values()
        if t.room
        for name in (t.name.en, t.name.zh, *t.aliases)
    )
