"""Turn what a model wrote about a picture into an answer or a point, or say why it is none.

Trusts nothing in it: whatever the reply holds, the result is words, a yes or no, or two whole
numbers in their range. Pure.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from planner.brain.endpoint.json_extraction import NoObject, one_object
from planner.brain.endpoint.reply_validation import Unusable, clean
from planner.brain.image_questions import FULL, MAX_SAID
from planner.plan import Bilingual

_LOOK = frozenset({"picture", "seen", "en", "zh"})
_POINT = frozenset({"picture", "there", "x", "y"})


@dataclass(frozen=True, slots=True)
class Words:
    """Hold the answer to a question."""

    text: Bilingual
    seen: bool | None


@dataclass(frozen=True, slots=True)
class Point:
    """Hold a point, each of 0 to 1000."""

    x: int
    y: int


@dataclass(frozen=True, slots=True)
class Absent:
    """Say that what was asked for is not there."""


@dataclass(frozen=True, slots=True)
class NoPicture:
    """Say that no picture reached the model: the server dropped it without a word."""


def judge_look(text: str) -> Words | NoPicture | Unusable:
    """Return the answer that a reply is, or why it is none."""
    reply = _reply(text, _LOOK)
    if not isinstance(reply, dict):
        return reply
    en, zh = reply.get("en") or reply.get("zh"), reply.get("zh") or reply.get("en")
    if not isinstance(en, str) or not isinstance(zh, str):
        return Unusable(("the reply needs the texts en and zh",))
    said = Bilingual(en=_short(en), zh=_short(zh))
    if not said.en or not said.zh:
        return Unusable(("the reply needs words in en and zh",))
    seen = reply.get("seen")
    if seen is not None and not isinstance(seen, bool):
        return Unusable(("seen must be true or false, or left out",))
    return Words(said, seen)


def judge_point(text: str) -> Point | Absent | NoPicture | Unusable:
    """Return the point that a reply is, or why it is none."""
    reply = _reply(text, _POINT)
    if not isinstance(reply, dict):
        return reply
    there = reply.get("there")
    if not isinstance(there, bool):
        return Unusable(("there must be true or false",))
    if not there:
        return Absent()
    x, y = _whole(reply.get("x")), _whole(reply.get("y"))
    if x is None or y is None:
        return Unusable((f"x and y must be whole numbers from 0 to {FULL}",))
    return Point(x, y)


def _reply(text: str, keys: frozenset[str]) -> dict[str, Any] | NoPicture | Unusable:
    try:
        reply = one_object(text)
    except NoObject as why:
        return Unusable((str(why),))
    except RecursionError:  # two deep objects were compared
        return Unusable(("the reply's JSON is too deep",))
    extra = sorted(clean(str(key))[:40] for key in reply.keys() - keys)
    if extra:
        return Unusable((f"the reply takes {', '.join(sorted(keys))}, not {', '.join(extra[:6])}",))
    if reply.get("picture") is False:
        return NoPicture()
    return reply


def _whole(value: object) -> int | None:
    right = isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= FULL
    return value if right and isinstance(value, int) else None


def _short(text: str) -> str:
    plain = clean(text)
    return plain if len(plain) <= MAX_SAID else plain[: MAX_SAID - 1] + "…"
