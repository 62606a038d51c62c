"""Find the place that a question is about where nobody here knows it. Pure.

"Is there a cup in the conservatory?", 看看储藏室, "is the garage door open?". Law: a question about
a place is answered there or not at all; what is seen from here says nothing of it. A name stands
where a place stands: after "in the" or before 里, or it is a sort of room. What eyes know as a
thing is none ("in the box"), nor is what only says where about the robot ("in front", 这里).
"""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING

from planner.language.catalogue import CATALOGUE
from planner.language.folding import CHINESE as _HAN
from planner.language.folding import fold_words, has_chinese
from planner.language.object_names import MAX_READ, resolve
from planner.language.questions import english
from planner.plan import Language

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

_THE = r"(?:the|my|our|your)"
_LATE = r"(?: (?:still|now|right now|at the moment|today|too|there|please))*"
_SLOT_EN = re.compile(
    rf"\b(?:in|inside|into|(?<!look )(?<!peek )(?<!glance )at) {_THE} (?P<name>[a-z][a-z' -]*?)"
    rf"{_LATE}(?=$| (?:on|under|near|by|beside|behind|next)\b)"
)
_ABOUT_EN = re.compile(
    r"(?:far )?(?:corner|middle|cent(?:re|er)|way|front|back|rear|distance|background|foreground"
    r"|dark|air|light|sky|moment|time|end|top|bottom|morning|afternoon|evening|night|meantime"
    r"|first place|world|(?:left|right|other)(?: side| hand)?|side|floor|ground|wall|ceiling"
    r"|camera|table|same .+|next .+)(?: of .+)?"
)
"""What "in the" and "at the" say of time, or of where about the robot."""
_SORT_EN = r"(?:(?<=^)|(?<= ))(?:the|my|our|your) (?P<name>(?:[a-z]+ )?(?:{sorts}))"
_DOOR_EN = re.compile(
    rf"\b{_THE} (?P<name>(?:back|front|side|rear|main|garden|street) (?:door|gate|entrance))\b"
)
_DOOR_ZH = re.compile(r"(?P<name>[前后侧边正大院]门)(?![^的有是在锁关开吗么呢没好上,，。\s])")
"""A door of the house is told by its side: it is one place, wherever the robot is."""
_OF_IT = r"(?= (?:doors?|windows?|lights?|lamps?|gate|shutters?|blinds?)\b|{late}$| (?:is|are)\b)"
_LEAD_ZH = (
    r"(?:^|看一看|看看|看一?下|瞧瞧|检查一?下?|查看一?下?|观察一?下?|巡视一?下?|去|到|在|往|把|[,，。])"
    r"(?:[我你您他她]们?家?的|那个|这个)?"
)
_SLOT_ZH = re.compile(
    rf"{_LEAD_ZH}(?P<name>[{_HAN}]{{1,6}}?)(?:里[面边头]?|内(?!容))(?=有|是|的|还|都|现|没|吗|么|呢|啊|看|怎|$)"
)
_SORT_ZH = rf"{_LEAD_ZH}(?P<name>[{_HAN}]{{{{0,3}}}}?(?:{{sorts}}|[^教]室|库|[^卫套]房(?!间)|厅))"
_BEFORE_ZH = re.compile(
    r"^.*(?:看看|看一看|看一?下|瞧瞧|[检查]查一?下?|观察一?下?|巡视一?下?|[去到在往把])"
)
_ABOUT_ZH = re.compile(
    r".*(?:这|那|哪|你|您|我|它|他|她|家|屋子?|房间|角落|手|嘴|眼|怀|心|梦|夜|路|空中|画面|照片|视野"
    r"|镜头|图|全部|所有|每个?|各个?|周围|附近|有|看|里|的|谁)"
)
"""What these do not name: a place here, in a picture, or in nobody's home."""


def find_elsewhere(text: str, names: Collection[str] = ()) -> str | None:
    """Return the unknown place that a question or a look is about; None where it is about here.

    Args:
        text: as it was said, or with its known places as private characters.
        names: what the known rooms and places are called, folded.
    """
    plain = re.sub(r"[?？!！。. ]+$", "", fold_words(text))
    if len(plain) > MAX_READ:
        return None
    found = _in_chinese(plain.replace(" ", "")) if has_chinese(plain) else _in_english(plain)
    return next((name for name in found if not _is_known(name, names)), None)


def _is_known(name: str, names: Collection[str]) -> bool:
    return name in names or any(not known.isascii() and name.endswith(known) for known in names)


def _in_english(plain: str) -> Iterator[str]:
    for found in _SLOT_EN.finditer(plain):
        name = found["name"]
        nearby = english.HERE.fullmatch(name) or english.HERE.fullmatch(f"the {name}")
        if not nearby and not _ABOUT_EN.fullmatch(name) and resolve(name, Language.EN) is None:
            yield name
    for pattern in (_sorts(Language.EN), _DOOR_EN):
        yield from (found["name"] for found in pattern.finditer(plain))


def _in_chinese(plain: str) -> Iterator[str]:
    patterns = (_SLOT_ZH, _sorts(Language.ZH), _DOOR_ZH)
    for found in (each for pattern in patterns for each in pattern.finditer(plain)):
        name = _BEFORE_ZH.sub("", found["name"])
        if name and not _ABOUT_ZH.fullmatch(name) and resolve(name, Language.ZH) is None:
            yield name


@cache
def _sorts(language: Language) -> re.Pattern[str]:
    """Return the pattern of what a sort of room is called, where a question is about one."""
    sorts = (
        w for sort in CATALOGUE.keys("room") for w in CATALOGUE.synonyms(f"room.{sort}", language)
    )
    words = "|".join(map(re.escape, sorted(set(sorts), key=len, reverse=True)))
    if language is Language.ZH:
        return re.compile(_SORT_ZH.format(sorts=words))
    return re.compile(_SORT_EN.format(sorts=words) + _OF_IT.format(late=_LATE))
