"""Own the Chinese rules about looking: find, count, look, questions about what is there."""

from __future__ import annotations

from re import Match

from planner.brain.offline.acts import count, find, look
from planner.brain.offline.chinese_words import SPOT, THING, loc
from planner.brain.offline.grammar import rule, where
from planner.brain.offline.meaning import Meaning, Reading, Rule, Steps

_AT = rf"(?:{loc('at')})?"
_MUST = loc("at")
_FIND = r"(?:找到|寻找|找找看?|找一找|找一下|找|搜索|搜寻|搜一下|定位|识别|寻)(?:一下|一个|个)?"
_SEE = (
    r"(?:看一看|看看|看一下|看下|看|瞧瞧|瞧|检查一下|检查|查看一下|查看|观察一下|观察|确认一下|"
    r"确认|巡视|查一下|"
    r"查查|拍照|拍张照片?|拍一张照片?|描述一下|描述|描绘|告诉我|说说|监控|盯着|留意|了解一下)"
)
_UNIT = r"(?:个|只|张|位|把|本|台|瓶|杯|名|条|件|辆|盒|罐|双|支|口|盏)?"
_IS_THERE = r"(?:还)?(?:有没有|是否有|是不是有|有无|有)"


def _find(found: Match[str], reading: Reading) -> Meaning:
    return find(found["what"], where(found, "at"), reading)


def _count(found: Match[str], reading: Reading) -> Meaning:
    groups = found.groupdict()
    return count(found["what"], groups.get("at2") or where(found, "at"), reading)


def _look(found: Match[str], reading: Reading) -> Meaning:
    groups = found.groupdict()
    here = reading.scene.place and ("那里" if "at" not in groups else None)
    return look(found[0], where(found, "at") or here, reading)


def _reported(_found: Match[str], reading: Reading) -> Meaning | None:
    return Steps(()) if reading.scene.seen else None


RULES: tuple[Rule, ...] = (
    rule(
        r"(?:然后)?(?:告诉|通知|报告|汇报)(?:给)?(?:我|我们)?(?:一下)?(?:结果|数量|情况|有几个|"
        r"有多少|在哪(?:里|儿)?)?|汇报",
        _reported,
    ),
    rule(
        rf"{_AT}(?:数一数|数一下|数数|数|清点|统计)(?:一下)?(?:(?P<at2>{SPOT})(?:里面?|上面?|"
        rf"中)?(?:的)?)?(?:有)?(?:几|多少)?{_UNIT}(?P<what>(?!到|我|你|不|岁|点){THING})",
        _count,
    ),
    rule(
        rf"(?:{_SEE})?{_AT}(?:{_SEE})?(?:一共|总共|现在)?(?:有|坐着|站着|躺着|摆着|放着|停着|坐了|"
        rf"站了)?(?:几|多少){_UNIT}(?P<what>(?!到|我|你|不|岁|点){THING})",
        _count,
    ),
    rule(
        rf"(?:{_SEE})(?P<what>{THING})(?:在不在|是不是在|是否在)(?P<at>{SPOT})(?:里面?|上面?|那里|"
        r"旁边)?",
        _find,
    ),
    rule(rf"{_AT}{_FIND}(?P<what>{THING})", _find),
    rule(rf"{_FIND}{_MUST}(?P<what>{THING})", _find),
    rule(rf"(?:把)?(?P<what>{THING})(?:给我)?找(?:出来|到)", _find),
    rule(rf"(?:{_SEE}){_MUST}{_IS_THERE}(?P<what>{THING})", _find),
    rule(rf"{_MUST}(?:{_SEE})?{_IS_THERE}(?P<what>(?!什么|事|问题|异常|情况){THING})", _find),
    rule(
        rf"(?:{_SEE})?有?(?:几|多少){_UNIT}(?P<what>(?!岁|点){THING}){_MUST}",
        _count,
    ),
    rule(rf"(?:(?:{_SEE})(?:谁|什么)?(?:人)?|谁){_MUST}(?:[^,]*)", _look),
    rule(rf"{_MUST}(?:{_SEE})(?:[^,\ue000-\ue8ff]*)", _look),
    rule(
        rf"{_MUST}(?:有(?:什么|谁|哪些)|(?:是|在)?(?:什么|怎么样|干净|整洁|安全|空的?|开着|"
        r"亮着))[^,\ue000-\ue8ff]*",
        _look,
    ),
    rule(rf"{_IS_THERE}(?P<what>(?!什么|事|问题|异常|情况){THING})", _find),
    rule(
        rf"(?:四处|到处|周围|环顾)?(?:{_SEE})(?:四周|周围|环境|情况)?[^,\ue000-\ue8ff]*|"
        r"你?看到了?什么|看见什么|环顾四周",
        _look,
    ),
)
