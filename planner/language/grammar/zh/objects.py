"""Own the Chinese rules about looking: find, count, look, things there, on, under or near it.

"椅子上有几本书", "椅子旁边有没有箱子" are read by the rules at the end. What stands on or near a
place of the site is read by the rules about places; where eyes don't know the neighbour ("楼上",
"网上") nothing is read here.
"""

from __future__ import annotations

import re
from dataclasses import replace
from re import Match

from planner.language.grammar.lexicon import MARK
from planner.language.grammar.noun_phrases import HOW_ZH, by_neighbour, is_known
from planner.language.grammar.parse_result import (
    ClauseProblem,
    Meaning,
    Reading,
    Rule,
    Steps,
    ahead,
    read_place,
    rule,
)
from planner.language.grammar.step_builders import arrive, count, find, look, offer_search, place_of
from planner.language.grammar.zh import IN, SEE, SPOT, THING, UNIT, WHAT, WHETHER, loc
from planner.plan import Code, Count, Step

_AT = rf"(?:{loc('at')})?"
_MUST = loc("at")
_FIND = (
    r"(?:找到|寻找|找找看?|找一找|找一下|找下|找|搜索|搜寻|搜一下|定位|识别|寻)(?:一下|一个|个)?"
)
_IS_THERE = rf"(?:{WHETHER}|[都还]?有)"
_ASKS = r"(?:吗|呢|么|嘛|啊)?"
_ASKING = re.compile(r"[吗谁啥哪几]|[什怎]么|么$|如何|多少|有没有|有无|是否|是不是")
"""What makes a question of words that else only tell: "客厅的灯亮着" asks for nothing."""
_AND_MANY = re.compile(rf"(?:(?:和|与|跟|以及|还有|、)有?|(?<!有))(?:几|多少){UNIT}(?=.)")
_AROUND = (
    r"(?:在?(?:你|您)?的?(?:这里|这儿|这边|那里|那儿|那边|附近|周围|四周|身边|旁边|边上|面前|眼前|"
    r"前面|前方)|(?:地上|地板上|地面上)|(?:这个?|这间)?(?:屋里|屋子里|房间里面?|房里))"
)
"""Where the robot is anyhow: a question about it drives nowhere."""
_WHOLE = r"(?:家里|家中|屋子里|房子里|哪里|哪儿|哪个(?:房间|屋子?)里?面?|什么地方)"
_ALL_OVER = r"(?:(?:在?家里|屋里|全家|全屋|整个(?:家|屋子|房子)|每个房间)?(?:到处|四处|挨个|都)?)"


def _find(found: Match[str], reading: Reading) -> Meaning:
    return find(found["what"], read_place(found, "at"), reading)


def _find_under(found: Match[str], reading: Reading) -> Meaning:
    named = by_neighbour(found["what"], found["how"], found["by"], reading)
    if named is None:
        return reading.problem(Code.NOT_UNDERSTOOD, found[0])
    return find(named, found["by"], reading)


def _find_all(found: Match[str], reading: Reading) -> Meaning:
    """Find one thing after the other: "杯子和球"; in 暖和的毯子, 和平鸽 no word joins things."""
    parts = re.split(r"和|以及|还有|与", found["what"])
    several = all(is_known(part, reading.things) for part in parts)
    steps: tuple[Step, ...] = ()
    meaning: Meaning = Steps(())
    for what in parts if several else [found["what"]]:
        meaning = find(what, None, reading)
        if not isinstance(meaning, Steps):
            return meaning
        steps += meaning.steps
    return replace(meaning, steps=steps) if isinstance(meaning, Steps) else meaning


def _count(found: Match[str], reading: Reading) -> Meaning:
    """Count one kind after the other: "几个人和几把椅子"."""
    place = found.groupdict().get("at2") or read_place(found, "at")
    steps: tuple[Step, ...] = ()
    meaning: Meaning = Steps(())
    for what in _AND_MANY.split(found["what"]):
        meaning = count(what, place, reading)
        if not isinstance(meaning, Steps):
            return meaning
        steps += meaning.steps
        reading = ahead(reading, meaning)
    return replace(meaning, steps=steps) if isinstance(meaning, Steps) else meaning


def _look(found: Match[str], reading: Reading) -> Meaning:
    groups = found.groupdict()
    here = reading.scene.place and ("那里" if "at" not in groups else None)
    return look(found[0], read_place(found, "at") or here, reading)


def _skip_report(_found: Match[str], reading: Reading) -> Meaning | None:
    return Steps(()) if reading.scene.seen else None


def _look_here(found: Match[str], reading: Reading) -> Meaning | None:
    """Look where nothing named a place; counting elsewhere is left to the next rules."""
    return None if reading.scene.place else _look(found, reading)


def _read_question(found: Match[str], reading: Reading) -> Meaning | None:
    """Read a question about what is there; said flatly it is none: "厨房有杯子" only tells."""
    flat = found.groupdict().get("flat") is not None
    said = reading.marked.text
    asked = said.rstrip(" 。!").endswith("?") or "请问" in said or _ASKING.search(found[0])
    return None if flat and not asked else _look(found, reading)


def _offer_search(found: Match[str], reading: Reading) -> Meaning:
    return offer_search(
        found["what"] or found["what2"] or found["what3"] or found["what4"], found[0], reading
    )


RULES: tuple[Rule, ...] = (
    rule(
        r"(?:然后)?(?:告诉|通知|报告|汇报)(?:给)?(?:我|我们)?(?:一下)?(?:结果|数量|情况|有几个|"
        r"有多少|在哪(?:里|儿)?)?|汇报",
        _skip_report,
    ),
    rule(
        rf"(?:{SEE}|数一数|数一下|数数|数|清点)?(?:{_AROUND})(?:现在|一共|总共)?(?:有|坐着|站着)?(?:几|多少)"
        rf"{UNIT}{THING}|有(?:几|多少){UNIT}(?!岁|点){THING}"
        rf"|(?:数一数|数一下|数数|数|清点)(?:{_AROUND})的?{THING}",
        _look_here,
    ),
    rule(
        rf"(?:{SEE}|数一数|数一下|数数|数)?(?:家里|全家|屋子里|整个屋子)的?(?:一共|总共)?有?(?:几|多少){UNIT}"
        rf"(?P<what>{THING})",
        _count,
    ),
    rule(
        rf"{_AT}(?:数一数|数一下|数数|数|清点|统计)(?:一下)?(?:(?P<at2>{SPOT}){IN})?"
        rf"(?:一共|总共|现在|还)*(?:有|坐着|站着|躺着|摆着|放着)?(?:几|多少)?{UNIT}(?P<what>(?!到|我|你|不|岁|点){THING})",
        _count,
    ),
    rule(
        rf"(?:{SEE})?{_AT}(?:{SEE})?(?:一共|总共|现在|还)*(?:有|坐着|站着|躺着|摆着|放着|停着|坐了|"
        rf"站了)?(?:几|多少){UNIT}(?P<what>(?!到|我|你|不|岁|点){THING})",
        _count,
    ),
    rule(
        rf"(?:{SEE})(?P<what>{THING})(?:在不在|是不是在|是否在)(?P<at>{SPOT})(?:里面?|上面?|那里|"
        r"旁边)?",
        _look,
    ),
    rule(
        rf"{_WHOLE}(?:{WHETHER}|有)(?P<what>(?!什么|谁|事|问题|异常|情况|[几多]){THING}){_ASKS}"
        rf"|{WHETHER}?有?(?P<what4>人)在家(?:里)?{_ASKS}"
        rf"|你?(?:有没有)?见过(?P<what3>{THING})(?:吗|没有)?"
        rf"|(?:告诉我|你?知不?知?道|你?知道)?(?P<what2>(?![他她它你您我]们?在|大家|告诉|知道){THING})"
        r"(?:现在|都)?在(?:哪里|哪儿|哪|什么地方|哪个房间)(?:里|呢|啊|呀|吗)?",
        _offer_search,
    ),
    rule(
        rf"{_FIND}(?:{WHETHER})?(?P<by>{MARK})(?P<how>下面?|下边|底下)的(?P<what>{THING})",
        _find_under,
    ),
    rule(rf"{_ALL_OVER}{_FIND}(?:{WHETHER})?(?P<what>{THING})", _find_all),
    rule(rf"{_AT}{_FIND}(?:{WHETHER})?(?P<what>{THING})", _find),
    rule(rf"{_FIND}{_MUST}(?:{WHETHER})?(?P<what>{THING})", _find),
    rule(rf"(?:把)?(?P<what>{THING})(?:给我)?找(?:出来|到)", _find),
    rule(
        rf"(?:(?:{SEE})(?:{WHETHER}|是不是有|有)|{WHETHER}|(?P<flat>有)){THING}在(?P<at>{SPOT})"
        rf"(?:里面?|上面?|那里|旁边)?{_ASKS}",
        _read_question,
    ),
    rule(
        rf"{_MUST}(?:的?人)?(?:是谁|都?有(?:些)?谁|现在)?(?:的?情况)?"
        r"(?:怎么样|怎样|如何|什么情况|啥情况|是谁|有谁)(?:了|啊|呀)?",
        _look,
    ),
    rule(rf"拍一?张?{_MUST}照片?", _look),
    rule(r"[这那]?(?:个)?(?:东西)?是(?:什么|谁|啥)(?:东西)?", _look),
    rule(rf"(?:{SEE}){_MUST}(?:{WHAT}|{_IS_THERE}{THING}){_ASKS}", _look),
    rule(
        rf"{_MUST}(?:(?:{SEE}){_IS_THERE}|{WHETHER}|[都还]?(?P<flat>有)"
        rf"(?!什么|啥|谁|哪些)){THING}{_ASKS}",
        _read_question,
    ),
    rule(
        rf"(?:{SEE})?有?(?:几|多少){UNIT}(?P<what>(?!岁|点){THING}){_MUST}",
        _count,
    ),
    rule(
        rf"{THING}(?:现在)?还?在(?P<at>{SPOT})(?:里面?|上面?|那里|旁边)?(?:吗|没有)",
        _look,
    ),
    rule(rf"(?:(?:{SEE})(?:谁|什么)?(?:人)?|谁(?:正?[坐站躺睡待](?=在))?){_MUST}(?:[^,]*)", _look),
    rule(rf"{_MUST}(?:{SEE})(?P<flat>[到见])?(?:[^,\ue000-\ue8ff]*)", _read_question),
    rule(
        rf"{_MUST}(?:{WHAT}|(?:[^,\ue000-\ue8ff]{{1,4}}(?=[开亮关锁]着))?(?:是|在)?(?:什么|怎么样|"
        r"(?P<flat>干净|整洁|安全|空的?|开着|亮着)))[^,\ue000-\ue8ff]*",
        _read_question,
    ),
    rule(
        rf"(?:{SEE})?(?:{_AROUND})?(?:{WHAT}[^,\ue000-\ue8ff]*|{WHETHER}{THING}{_ASKS}|"
        rf"(?P<flat>有){THING})",
        _read_question,
    ),
    rule(
        rf"你?(?:能|可以|有没有)?(?:看得到|看得见|看到|看见|见到|瞧见|发现)(?:了|过)?{THING}(?:了|没有)?"
        rf"{_ASKS}",
        _look,
    ),
    rule(
        rf"(?:四处|到处|周围|环顾)?(?:{SEE})(?:四周|周围|环境|情况)?[^,\ue000-\ue8ff]*|"
        r"你?看到了?什么|看见什么|环顾四周",
        _look,
    ),
)


_BY = (
    rf"(?:(?P<at>{SPOT})(?:里面?|里边|内|中)?的?)?"
    rf"(?P<by>(?![上下底旁边])[^,。\ue000-\ue8ff]{{1,10}}?)(?P<how>{HOW_ZH})"
)
_TELL = rf"(?:{SEE}|数一数|数一下|数数|数|清点一?下?|统计一?下?)?"
_NOW = r"(?:现在|一共|总共|[都还])*"
_STANDS = r"(?:有|(?:坐|站|躺|摆|放|停)[着了])"
_MANY = rf"(?:几|多少){UNIT}"
_COUNTED = rf"(?P<what>(?!岁|点){THING})"
_ASKS_NEIGHBOUR = r"(?:吗|呢|么|嘛|啊)?"
_SEVERAL = re.compile(r"[和与跟几]|以及|还有|多少")
_ASIDE = re.compile(rf"{HOW_ZH}的")
"""The neighbour of a neighbour."""
_LEAD = re.compile(r"^(?:(?:所有|全部)的?|[把张台个])")
"""Before a neighbour's name: all of them, or what "那把" leaves, whose 那 is taken for "so"."""


def _name_by_neighbour(found: Match[str], reading: Reading) -> str | None:
    """Return the thing's words with its neighbour's, where eyes know that one; else None."""
    by, how, what = found["by"], found["how"], found.groupdict().get("what") or "东西"
    known = by_neighbour(what, how, _LEAD.sub("", by), reading)
    if known is None or _SEVERAL.search(what) or _ASIDE.search(by):
        return None
    every = by.startswith(("所有", "全部"))
    return f"{by}{how}的{reading.marked.restore(what)}"[:80] if every else known


def _count_by_neighbour(found: Match[str], reading: Reading) -> Meaning | None:
    named, place = _name_by_neighbour(found, reading), place_of(found["at"], reading)
    if named is None or isinstance(place, ClauseProblem):
        return place if named is not None and isinstance(place, ClauseProblem) else None
    steps = (*arrive(place, reading), Count(object=named, place=place))
    return Steps(steps, thing=named, seen=True)


def _look_by_neighbour(found: Match[str], reading: Reading) -> Meaning | None:
    """Look where it is asked about what stands there; said flatly it is no question."""
    flat = found.groupdict().get("flat") and not reading.marked.text.rstrip(" 。!").endswith("?")
    if flat or _name_by_neighbour(found, reading) is None:
        return None
    return look(found[0], found["at"] or "那里", reading)


NEIGHBOUR_RULES: tuple[Rule, ...] = (
    rule(rf"{_TELL}在?{_BY}{_NOW}{_STANDS}{_MANY}{_COUNTED}", _count_by_neighbour),
    rule(rf"{_TELL}在?{_BY}的{_COUNTED}{_NOW}有{_MANY}", _count_by_neighbour),
    rule(rf"{_TELL}{_NOW}有?{_MANY}{_COUNTED}{_NOW}在{_BY}", _count_by_neighbour),
    rule(
        rf"(?:{SEE})?在?{_BY}{_NOW}(?:{WHETHER}(?P<what>{THING})|{WHAT}(?:东西|人)?){_ASKS_NEIGHBOUR}",
        _look_by_neighbour,
    ),
    rule(rf"(?:{SEE})?在?{_BY}{_NOW}有(?P<what>{THING})[吗么嘛]", _look_by_neighbour),
    rule(rf"在?{_BY}{_NOW}(?P<flat>有)(?P<what>{THING})", _look_by_neighbour),
    rule(rf"(?P<what>{THING}){_NOW}在{_BY}(?:吗|么|没有)", _look_by_neighbour),
    rule(rf"谁{_NOW}(?:正?[坐站躺睡])?在{_BY}{_ASKS_NEIGHBOUR}", _look_by_neighbour),
)
