"""Own the Chinese questions about what is on, under or near a thing that eyes know.

"椅子上有几本书", "椅子旁边有没有箱子": what stands on or near a place of the site is read by the
rules about places, and where eyes don't know the neighbour ("楼上", "网上") nothing is read here.
"""

from __future__ import annotations

import re
from re import Match

from planner.language.grammar.grammar import rule
from planner.language.grammar.object_targets import HOW_ZH, by_neighbour
from planner.language.grammar.parse_result import Meaning, Problem, Reading, Rule, Steps
from planner.language.grammar.step_builders import arrive, look, place_of
from planner.language.grammar.zh.words import SEE, SPOT, THING, UNIT, WHAT, WHETHER
from planner.plan import Count

_BY = (
    rf"(?:(?P<at>{SPOT})(?:里面?|里边|内|中)?的?)?"
    rf"(?P<by>(?![上下底旁边])[^,。\ue000-\ue8ff]{{1,10}}?)(?P<how>{HOW_ZH})"
)
_TELL = rf"(?:{SEE}|数一数|数一下|数数|数|清点一?下?|统计一?下?)?"
_NOW = r"(?:现在|一共|总共|[都还])*"
_STANDS = r"(?:有|(?:坐|站|躺|摆|放|停)[着了])"
_MANY = rf"(?:几|多少){UNIT}"
_COUNTED = rf"(?P<what>(?!岁|点){THING})"
_ASKS = r"(?:吗|呢|么|嘛|啊)?"
_SEVERAL = re.compile(r"[和与跟几]|以及|还有|多少")
_ASIDE = re.compile(rf"{HOW_ZH}的")
"""The neighbour of a neighbour."""
_LEAD = re.compile(r"^(?:(?:所有|全部)的?|[把张台个])")
"""Before a neighbour's name: all of them, or what "那把" leaves, whose 那 is taken for "so"."""


def _named(found: Match[str], reading: Reading) -> str | None:
    """Return the thing's words with its neighbour's, where eyes know that one; else None."""
    by, how, what = found["by"], found["how"], found.groupdict().get("what") or "东西"
    known = by_neighbour(what, how, _LEAD.sub("", by), reading)
    if known is None or _SEVERAL.search(what) or _ASIDE.search(by):
        return None
    every = by.startswith(("所有", "全部"))
    return f"{by}{how}的{reading.marked.restore(what)}"[:80] if every else known


def _count(found: Match[str], reading: Reading) -> Meaning | None:
    named, place = _named(found, reading), place_of(found["at"], reading)
    if named is None or isinstance(place, Problem):
        return place if named is not None and isinstance(place, Problem) else None
    steps = (*arrive(place, reading), Count(object=named, place=place))
    return Steps(steps, thing=named, seen=True)


def _look(found: Match[str], reading: Reading) -> Meaning | None:
    """Look where it is asked about what stands there; said flatly it is no question."""
    flat = found.groupdict().get("flat") and not reading.marked.text.rstrip(" 。!").endswith("?")
    if flat or _named(found, reading) is None:
        return None
    return look(found[0], found["at"] or "那里", reading)


RULES: tuple[Rule, ...] = (
    rule(rf"{_TELL}在?{_BY}{_NOW}{_STANDS}{_MANY}{_COUNTED}", _count),
    rule(rf"{_TELL}在?{_BY}的{_COUNTED}{_NOW}有{_MANY}", _count),
    rule(rf"{_TELL}{_NOW}有?{_MANY}{_COUNTED}{_NOW}在{_BY}", _count),
    rule(
        rf"(?:{SEE})?在?{_BY}{_NOW}(?:{WHETHER}(?P<what>{THING})|{WHAT}(?:东西|人)?){_ASKS}", _look
    ),
    rule(rf"(?:{SEE})?在?{_BY}{_NOW}有(?P<what>{THING})[吗么嘛]", _look),
    rule(rf"在?{_BY}{_NOW}(?P<flat>有)(?P<what>{THING})", _look),
    rule(rf"(?P<what>{THING}){_NOW}在{_BY}(?:吗|么|没有)", _look),
    rule(rf"谁{_NOW}(?:正?[坐站躺睡])?在{_BY}{_ASKS}", _look),
)
