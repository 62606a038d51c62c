"""Own the Chinese words of orders that hang on something."""

from __future__ import annotations

import re

from planner.language.grammar.compound_forms import CompoundForms, ConditionParts, MemoryParts
from planner.language.numbers import ZH_OFTEN, times

_IF = r"(?:如果|要是|假如|假若|倘若|若是|万一)"
_THEN = r"[,，]?(?:那么|那)?(?:就|便|你就)?"
_OTHERWISE = (
    r"[,，;；。]?(?:否则的?话?|不然的?话?|要不然|要不(?![要是])|"
    rf"{_IF}?(?:没有?|不是|没人|没有人|有人|有)(?:的话)?[,，]?(?=就|便|去|回|到|等|说))(?:就|便|再)?"
)


def _read_condition(said: str) -> ConditionParts | None:
    asked = said.replace("有没有", "有").replace("有无", "有")  # 有没有 asks, 没有 denies
    plain = re.sub(rf"^{_IF}|的话$", "", asked)
    found = re.fullmatch(
        r"(?P<where>.*?)(?:如果|要是|假如)?(?P<has>没有|没|有)(?:一?[个只把张瓶](?!子))?(?P<thing>.+)",
        plain,
    )
    if found is None:
        return _read_placed(plain)
    where, thing = found["where"].strip(), found["thing"].strip()
    asks = f"{where}有没有{thing}"
    anybody = f"{where}有没有人"
    return ConditionParts(asks, thing, found["has"] != "有", is_placed=bool(where), anybody=anybody)


def _read_placed(plain: str) -> ConditionParts | None:
    """Return the question whether one known person or thing is somewhere: 爸爸在书房."""
    found = re.fullmatch(
        r"(?P<thing>[^在不没他她它]{1,10}?)还?(?P<has>不在|没在|在)(?P<where>[^在了]{1,10}?)", plain
    )
    if found is None:
        return None
    where, thing = found["where"], found["thing"]
    anybody = f"{where}有没有人"
    asks = f"{where}有没有{thing}"
    return ConditionParts(asks, thing, found["has"] != "在", is_placed=True, anybody=anybody)


_SEE = r"(?:看到|看见|见到|碰到|碰见|遇到|发现|瞧见|见)"
_MET = rf"(?:{_SEE}|来|去|到|进|待|在)(?:过|了)"
_PAST = rf"(?>[^,，;；。]*?{_MET})[^,，;；。]*?"


def _read_memory(said: str) -> MemoryParts | None:
    """Return the question about before that a condition with 过 or 了 is."""
    plain = re.sub(rf"{_IF}|的话$", "", said.replace("有没有", "有"))
    if re.search(_MET, plain) is None:
        return None
    asked = re.sub(rf"(?:从来)?没有?(?={_SEE})", "", plain)
    asked = re.sub(r"没有?人", "有人", asked)
    return MemoryParts(asked, asked != plain)


_ORDER = (
    r"(?:先|去|回|到|等|说|左|右|转|前|往|跟|找|看|停|掉|开"
    r"|告诉|问|叫|喊|吱|吭|报告|通知|对|提醒|让)"
)
_THEN_ELSE = rf"(?P<then>{_ORDER}.+?)(?:{_OTHERWISE}(?P<else>.+))?"
_LATE = r"(?:现在|时间)?(?:已经)?(?:过了|超过|晚于|还没到|没到|没过|早于)[^,，;；。]+?"
_PLACE_HAS = r"[^,，;；。]*?(?:没有|没|有)[^,，;；。]*?"
_IS_AT = r"[^,，;；。有没不在]{1,10}?还?(?:不在|没在|在)[^,，;；。有没了在]{1,10}?"
_THEM = r"(?:他们?|她们?|那个?人|大家)"
_TOLD = r"(?P<w>[^,，;；。\"“”]{1,60}?)(?=$|[,，;；。])"

CHINESE_COMPOUND = CompoundForms(
    trigger=re.compile(
        r"如果|要是|假如|假若|倘若|若是|万一|除非|只有|的话|有没有|没有?的?话?|[次遍趟圈回]$|慢"
    ),
    conditions=(
        re.compile(rf"(?:现在)?{_IF}(?P<if>{_LATE})(?:的话)?{_THEN}{_THEN_ELSE}"),
        re.compile(rf"(?:请)?(?P<if>(?>[^,，;；。]*?{_IF}){_PAST})(?:的话)?{_THEN}{_THEN_ELSE}"),
        re.compile(rf"(?P<if>{_PAST})的话{_THEN}{_THEN_ELSE}"),
        re.compile(
            rf"(?:请)?{_IF}?(?P<if>{_PLACE_HAS})(?:的话)?{_THEN}"
            rf"(?P<then>{_ORDER}.+?){_OTHERWISE}(?P<else>.+)"
        ),
        re.compile(
            r"(?:请)?(?:去)?(?:看看|看一下|检查一下|看一看)(?P<if>[^,，;；。]*?(?:有没有|有无)[^,，;；。]*?)[,，;；。]"
            rf"(?:如果|要是)?(?:有人的话|有的话|有人|有)[,，]?(?:就|便)?(?P<then>.+?)(?:{_OTHERWISE}(?P<else>.+))?"
        ),
        re.compile(rf"(?:请)?{_IF}(?P<if>{_PLACE_HAS})(?:的话)?{_THEN}(?P<then>{_ORDER}.+)"),
        re.compile(rf"(?:请)?{_IF}(?P<if>{_IS_AT})(?:的话)?{_THEN}{_THEN_ELSE}"),
        re.compile(rf"(?P<if>{_PLACE_HAS})(?:的话)[,，]?(?:就|便)(?P<then>{_ORDER}.+)"),
        re.compile(
            rf"(?P<if>[^,，;；。]+?{_IF}(?:没有|没|有)[^,，;；。]*?)(?:的话)?{_THEN}"
            rf"(?P<then>{_ORDER}.+)"
        ),
    ),
    read_condition=_read_condition,
    read_memory=_read_memory,
    clock=re.compile(
        rf"{_IF}?(?:现在|时间)?(?:已经)?(?:(?:过了|超过|晚于)(?P<after>[^,]+?)(?:了|的话)*"
        r"|(?:还)?(?:没到|没过|早于|不到)(?P<before>[^,]+?)(?:的话)?)"
    ),
    go_there=re.compile(r"(?P<verb>去|到|回到?|前往|开到)(?:那里|那儿|那边)"),
    to="",
    tells=(
        (
            re.compile(
                rf"(?:(?:告诉|通知|提醒)(?:一下)?{_THEM}(?:说|讲)?|(?:跟|对|和|向|给){_THEM}(?:说|讲|讲讲|说说))"
                rf"(?:一声|一下)?[:：]?{_TOLD}"
            ),
            r"说“\g<w>”",
        ),
        (re.compile(r"(?:问问|问一下|询问|问)(?:他们?|她们?)(?=[^,，;；。]{2})"), "问问"),
        (re.compile(rf"(?:叫|让|喊|请){_THEM}{_TOLD}"), r"说“请\g<w>”"),
    ),
    calls=",",
    cuts=re.compile(r"(?!)"),
    rounds=re.compile(rf"(?P<main>.+?)(?P<times>{ZH_OFTEN})(?:次|遍|趟|回)"),
    count=times,
    slowly=re.compile(
        r"(?<![不太])(?:慢慢|缓慢|慢一?点儿?)地?(?=[去到回来开走往跟前后退倒转移靠绕向])"
    ),
)
