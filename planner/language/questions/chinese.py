"""Read Chinese questions about what is there: their patterns, and what each of them asks for.

Matched against folded words without spaces and without punctuation at their ends.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.color_names import CHINESE
from planner.language.folding import CHINESE as _HAN
from planner.language.questions.question import ObjectQuestion

if TYPE_CHECKING:
    from collections.abc import Iterator

    from planner.language.questions.question import PlaceNames

_ASKS = r"(?:吗|么|嘛|呢|啊)?"
_SEE = r"(?:看得?[到见]|发现|见到)"
_UNIT = r"[个只张把台架辆本瓶杯盆棵株扇条件副双支部块面口盏头匹颗]"
_NOUN = (
    rf"(?P<unit>(?:[一二两三几]|\d+)?{_UNIT}(?!子))?(?:[我你您他她]们?的)?"
    rf"(?P<what>(?:(?:{CHINESE})(?:的|(?<=色)))?(?P<noun>[{_HAN}]{{1,6}}?))"
)
_AT = (
    r"(?P<at>[^有看]{0,12}?)(?P<in>(?:里|内|上|下|旁|边|底|前|后|附近|周围|中间|门口)[面边下]?"
    r"|[那这][里儿边])?"
)
_LEAD = (
    r"(?:请|麻烦)?[你您]?(?:帮我|给我|替我)?(?:去|到)?"
    r"(?:看一看|看一眼|看看|看一?下|瞧瞧|检查一?下?|查看一?下?|确认一?下?|观察一?下?|告诉我)?"
)
_HOW = r"(?:[上下][面边]?|底下|旁边?|边上)"
_SEES = re.compile(
    rf"[你您]?(?P<q>能不能|有没有|是否)?能?{_SEE}[了过]?(?:(?P<where>[^有]{{1,12}}?{_HOW})的)?{_NOUN}"
    r"(?P<end>了?(?:吗|没有|没|么))?"
)
_HOLDS = re.compile(
    rf"{_LEAD}(?!地)(?P<where>[^有]{{1,12}}?{_HOW})(?:现在|[还都])*[坐放摆]着{_NOUN}[吗么嘛]"
)
"""Who is on a chair sits there; who is on the floor may stand."""
_THERE_IS = re.compile(
    rf"{_LEAD}(?:{_AT})?{_LEAD}[还都]?(?:现在)?"
    rf"(?:(?:有没有|是否有|是不是有|有无){_NOUN}(?:在(?P<where>.{{1,12}}))?{_ASKS}"
    rf"|有(?!.*在){_NOUN.replace('>', '_2>')}[吗么嘛])"
)
_IS_IT = re.compile(
    rf"{_LEAD}{_NOUN}(?:现在)?还?"
    r"(?:(?:在不在|是不是在|是否在)(?P<where>.{0,12})|在(?P<where_2>.{1,12})[吗么嘛])"
)
_NO_NOUN = re.compile(r"[的了着过吗呢啊没不在是和或跟与被把给有人谁什么哪几多少么怎物事]")
_VAGUE = re.compile(
    r"东西|问题|危险|异常|情况|变化|动静|声音|味道|地方|空间|[空座]位|位置|位子|垃圾|灰尘|饮料|水果"
    r"|玩具|家具|电器|餐具|衣服|需要|可能|办法|时间|小偷|老师|医生|护士|学生|同学|朋友|邻居|亲戚"
    r"|保姆|阿姨|叔|爷|奶奶|外[公婆]|爸|妈|哥|姐|弟|妹|老[公婆]|[先女]"
)
_VERB = re.compile(
    r"[开关锁收漏下坐站躺睡醒来去走到回吃喝做打看见发变弄整玩修坏倒掉丢放摆挂停亮响动洗擦扫拖搬拿"
    r"送装拆换充插拔点烧煮炒切起出进上跑哭笑说叫喊听闻摔碰撞撒洒流滴堵断裂破烂湿脏乱空满好准完"
    r"能会想该可应必](?!.*(?:.机|[器具鞋垫])$)"
)
"""有没有 asks for what was done as well as for what is there; a thing's name may begin so, too."""
_NAME = re.compile(r"[小老阿].{1,2}|[王李张刘陈杨黄赵吴周徐孙马朱胡郭何高林罗郑梁].{1,2}")
"""Who is seen may be somebody by name."""
_OPEN = re.compile(
    rf"{_LEAD}(?P<where>[^有]{{1,12}}?){_LEAD}[还都]?(?:现在)?"
    r"(?:有|是|[放摆坐站躺停][着了])(?:些|点)?(?:什么|啥|谁|哪些|何).{0,4}"
    r"|谁(?:正?[坐站躺睡])?在(?P<where_2>.{1,12}?)[吗呢啊]?"
)
_LOOSE = (
    re.compile(
        rf"{_LEAD}(?P<where>[^有]{{1,12}}?{_HOW})(?:现在|[还都])*"
        r"(?:是不是有|有|[放摆坐站躺停][着了])(?P<what>.+)"
    ),
    re.compile(
        rf".*?(?:看|见|发现)[到见]?[了过]?(?P<where>[^有]{{1,12}}?{_HOW})的(?P<what>.+?)了?(?:吗|没有|没|么)"
    ),
    re.compile(rf"(?P<what>.+?)在(?P<where>[^在]{{1,12}}?{_HOW})(?:吗|没有|的.*)?"),
)

WHEREABOUTS = re.compile(
    r"在?(?P<by>.+?)(?:(?P<on>上面?|上边)|(?P<under>下面?|下边|底下)"
    r"|(?P<near>旁边?|边上?|附近|周围|身[边旁])"
    r"|(?P<odd>里面?|里边|内|[背身]?后[面边]?|[面眼]?前[面边方]?|中间))的?"
)
HERE = re.compile(
    r"[你您我这那]们?(?:里|儿|边|的)?|[面眼身背]|(?:[这那]个?)?(?:房间|屋子?|家|图片?|照片)"
)
BESIDE = "上下里内旁边底后前中附周"
"""How words go on that say where beside a place itself."""
RELATED = re.compile(
    r"(?P<by>.+?)(?:(?P<on>上面?|上边)|(?P<under>下面?|下边|底下)|(?P<near>旁边?|边上|附近))的(?P<what>.+)"
)
SEVERAL = re.compile(r"所有|全部|每|各|几|两|三")
FLOOR = re.compile(r"地板?|地面")
ROUND = re.compile(r"环顾|环境|四处|到处|(?:^|[你您我看察在有 ，])的?(?:四周|周围)")
"""To look about."""


def read_yes_no(text: str, names: PlaceNames) -> Iterator[ObjectQuestion]:
    """Yield what a question may ask for, yes or no."""
    text = text.replace(" ", "")
    found = _SEES.fullmatch(text)
    if found is not None and (found["q"] or found["end"]):
        noun = found["noun"]
        certain = _is_noun(noun, found["unit"]) and not _NAME.fullmatch(noun)
        where = found["where"] or ""
        yield ObjectQuestion(found["what"], certain, where, may_refuse=not where)
        return
    found = _HOLDS.fullmatch(text)
    if found is not None:
        yield ObjectQuestion(found["what"], where=found["where"], may_refuse=False)
    found = _THERE_IS.fullmatch(text)
    if found is not None and (not found["at"] or found["in"] or names.get(found["at"])):
        noun, unit = found["noun"] or found["noun_2"], found["unit"] or found["unit_2"]
        where = found["where"] or f"{found['at'] or ''}{found['in'] or ''}"
        yield ObjectQuestion(found["what"] or found["what_2"], _is_noun(noun, unit), where)
    found = _IS_IT.fullmatch(text)
    if found is not None:
        yield ObjectQuestion(found["what"], where=found["where"] or found["where_2"] or "")


def _is_noun(what: str, unit: str | None) -> bool:
    """Return whether a run of characters is surely the name of one kind of thing."""
    if len(what) < 2 or _NO_NOUN.search(what) or _VAGUE.search(what):
        return False
    return unit is not None or _VERB.match(what) is None


def open_at(text: str) -> str | None:
    """Return the words for where everything is asked for: 桌子上有什么; else None."""
    found = _OPEN.fullmatch(text)
    return None if found is None else found["where"] or found["where_2"]


def loosely(text: str) -> tuple[str, str]:
    """Return what a sentence says of a thing, and what of its neighbour."""
    for pattern in _LOOSE:
        if (found := pattern.fullmatch(text.replace(" ", ""))) is not None:
            return found["what"], found["where"]
    return text, ""
