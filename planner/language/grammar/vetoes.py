"""Own the veto: which words keep a sentence from being read as an order, and what is told of it.

A veto is broad: in doubt nothing moves. What is told is narrow: "you denied it", "I can't check
the condition" or "speeds are not mine" is said of the very part that surely is that; of all else
the robot says that it did not understand the clause.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from re import Pattern

from planner.language.grammar.denial import denied_part, without_compounds
from planner.plan import Code

Vetoes = Sequence[tuple[Code, Pattern[str]]]

_CLAUSE = re.compile(r"(?:[^,;!?。、]|,(?= ?-?\d))+?(?=,(?! ?-?\d)|[;!?。、]|\.(?!\d)|$)")
_IF_EN = re.compile(
    r"(?<!what )(?<!as )(?<!even )(?<!wonder )(?<!wondering )(?<!know )(?<!ask )(?<!see )"
    r"(?<!check )(?<!me )(?<!us )(?<!tell )(?<!sure )"
    r"(?P<if>\bif\b(?! (?:you )?(?:please|would|could|may|do not mind|like|went|go|possible|"
    r"(?:have|get) (?:a|time|some))\b)[^,.;!?]*"
    r"|\b(?:unless|(?<!just )in case|provided|assuming|depending on|except if|as long as)\b"
    r"[^,.;!?]*"
    r"|(?<!i )\bsuppose\b[^,.;!?]*"
    r"|\b(?:as soon as|once)\b(?! (?:you|there|more|again|around|a|in|every|upon)\b)[^,.;!?]*"
    r"|(?<!know )(?<!ask )(?<!remember )\bwhen(?:ever)? (?!(?:did|do|does|is|are|was|were|will|can|"
    r"should|would|have|has|had|to|there)\b)(?!you (?:are|get|have|arrive|reach|come) "
    r"(?:there|back|done|in|at|to|a|time|some)\b)[^,.;!?]+"
    r"|\b(?:until|till) (?!\d)[^,.;!?]+)"
)
_IF_ZH = re.compile(
    r"(?P<if>(?:如果|要是|假如|假若|倘若|若(?!干)|除非|只要|一旦|万一)(?!你?您?(?:方便|可以|有空|愿意))"
    r"[^,.;!?。]*?(?=就|再|[才便]|[,.;!?。]|$)"
    r"|只有[^,.;!?。]*?(?=才)"
    r"|[^,.;!?。]*?(?<![说听讲我你您他她妈爸便空以])的话(?=[,.;!?。就再去到回来请进]|$)"
    r"|当[^,.;!?。]+?(?:时候?|的时候)|[^,.;!?。]+?的时候(?=[,就再才去到])"
    r"|(?:直到|等到)[^,.;!?。]*?(?=就|再|才|[,.;!?。]|$)"
    r"|等(?!我?(?:一下|一会|片刻|等))(?=[我他她它你您有没门天客妈爸人水饭雨])[^,.;!?。]*?(?:之后|以后|(?=就|再|才|[,.;!?。后])))"
)
_SPEED = re.compile(
    r"(?<!no )(?<!to )\bhurry\b|\b(?:slowly|quickly|slower|faster|quicker|speeds?|mph|coordinates?|"
    r"latitude|longitude|gps)\b"
    r"|\b(?:go|drive|move|run|walk|turn|be|as|too|very|so) (?:slow|fast|quick)\b(?! food)"
    r"|\bslow down\b|(?:met(?:re|er)s?|cm|km) (?:per|an?) (?:second|hour|minute)|m/s|km/h"
    r"|\b[xy] ?= ?-?\d|[(\[] ?-?\d+(?:\.\d+)? ?, ?-?\d"
    r"|坐标|米每秒|米/秒|每秒|速度?|慢慢|缓慢|全速|经度|纬度"
)
_OR = re.compile(
    r"\bor\b(?! (?:so|else|something|whatever)\b)|\b(?:either|whichever)\b|或|要么|任意|随便"
    r"|(?<=[^\s你您我他,.;!?。那就])还是"
)


@dataclass(frozen=True, slots=True)
class Veto:
    """Name why a sentence may not be read as an order, and the part that says so."""

    code: Code
    part: str
    denies: bool = False  # a word of denial stands in the sentence, sure or not
    only: bool = True  # no other veto speaks against it


def vetoed(text: str, vetoes: Sequence[Vetoes]) -> Veto | None:
    """Return the veto on a marked sentence, the surest reason first; None where there is none."""
    fired = _fired(text, vetoes)
    if not fired:
        return None
    sure = _fired(without_compounds(text), vetoes)
    for code, told in _TOLD:
        part = told(text) if code in sure else None
        if part:
            return Veto(code, part, Code.NEGATED in sure, len(sure) == 1)
    part = _clause_at(text, min(fired.values()))
    return Veto(Code.NOT_UNDERSTOOD, part, Code.NEGATED in sure, set(sure) <= {Code.AMBIGUOUS})


def _fired(text: str, vetoes: Sequence[Vetoes]) -> dict[Code, int]:
    """Return which vetoes a text calls for, and where each stands first."""
    return {
        code: found.start()
        for grammar in vetoes
        for code, pattern in grammar
        if (found := pattern.search(text))
    }


def _condition(text: str) -> str | None:
    found = _IF_EN.search(text) or _IF_ZH.search(text)
    return found["if"].strip() if found else None


def _speed(text: str) -> str | None:
    found = _SPEED.search(text)
    return _clause_at(text, found.start()) if found else None


def _alternatives(text: str) -> str | None:
    return text if _OR.search(text) else None


_TOLD: tuple[tuple[Code, Callable[[str], str | None]], ...] = (
    (Code.NEGATED, denied_part),
    (Code.CONDITIONAL, _condition),
    (Code.AMBIGUOUS, _alternatives),
    (Code.OUT_OF_SCOPE, _speed),
)


def _clause_at(text: str, at: int) -> str:
    """Return the clause around a character."""
    spans = (found for found in _CLAUSE.finditer(text) if found.start() <= at < found.end())
    return next((span[0].strip() for span in spans), text)
