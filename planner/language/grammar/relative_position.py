"""Own what is said of the robot's own sides, in both languages: behind it, on its left, its right.

The camera looks ahead. An order to look there turns the robot first; a question, "tell me" too,
orders no turn, and what is ahead is no answer to it: it is not understood. After a turn to that
very side what is ahead is the answer.
"""

from __future__ import annotations

import re
from math import cos, pi
from re import Match

from planner.language.grammar.grammar import rule
from planner.language.grammar.parse_result import Meaning, Reading, Rule, Steps
from planner.language.grammar.zh.words import SEE, THING, WHAT, WHETHER
from planner.plan import Code, Look, Turn

_SAME_SIDE = 0.9
"""Cosine of a turn against the side that is asked about: within 25 degrees."""
_LEFT = re.compile(r"\b(?:your|the|look|look to) left\b|\bleft of\b|左")
_RIGHT = re.compile(r"\b(?:your|the|look|look to) right\b|\bright of\b|右")
_BEHIND = re.compile(r"\bbehind\b|\bback(?:wards?)?\b|[后背]")


def _side_rad(said: str) -> float:
    """Return by how much the robot must turn to face the side that words name [rad]."""
    if _BEHIND.search(said):
        return pi
    return pi / 2 if _LEFT.search(said) else -pi / 2


def _look_aside(found: Match[str], _reading: Reading) -> Meaning:
    """Turn to the side that is to be looked at."""
    return Steps((Turn(angle_rad=_side_rad(found[0])), Look(question=found[0])), seen=True)


def _unseen(found: Match[str], reading: Reading) -> Meaning | None:
    """Say no to a question about a side that the camera does not see; None where it does."""
    turned_rad = reading.scene.turned_rad
    if turned_rad is not None and cos(turned_rad - _side_rad(found[0])) > _SAME_SIDE:
        return None
    return reading.problem(Code.NOT_UNDERSTOOD, found[0])


_NO_PLACE = r"[^,\ue000-\ue8ff]*"
_LOOK = r"(?:(?:have |take )a (?:quick )?look|look|check|inspect|peek|glance)(?! (?:around )?for\b)"
_TOLD = r"(?: (?:and|to) (?:tell me|see) what [a-z ]+)?"
_TELL = r"(?:(?:tell|show) (?:me|us)|let (?:me|us) know|say|find out|see|check|report)"
_SEES = r"(?:is|are|do you see|can you see|you (?:can )?see|(?:is|are) (?:there|standing|sitting))"
_WHICH = r"(?:what|who|whose|which|how many|if|whether|any[a-z]*|some[a-z]*)"
_ASK = (
    rf"(?:{_TELL} {_WHICH}|{_WHICH}|tell (?:me|us) about|is|are|(?:do|did|can|have) you|report|"
    r"describe|count|see behind)"
)
_OWN = (
    r"(?:behind(?: (?:you|me|us)\b|$)|at your back|(?:on|to|at|by) your (?:left|right)\b"
    r"|(?:left|right)(?: (?:hand )?side)? of (?:you|me)\b)"
)

ENGLISH: tuple[Rule, ...] = (
    rule(
        rf"{_LOOK} (?:(?:to )?(?:the |your )?(?:left|right)|behind(?: you)?"
        rf"|(?<=look )back(?:wards?)?){_TOLD}"
        rf"|{_LOOK}\b{_NO_PLACE}? (?:behind you|(?:on|to|at) your (?:left|right)){_TOLD}",
        _look_aside,
    ),
    rule(
        rf"(?:{_TELL} )?what (?:is|do you see|can you see) behind.*"
        r"|what (?:is|do you see|can you see) (?:on|to) (?:your|the) (?:left|right).*",
        _unseen,
    ),
    rule(rf"(?={_ASK}\b){_NO_PLACE}?\b{_OWN}{_NO_PLACE}", _unseen),
    rule(
        rf"(?:(?:{_TELL} )?(?:what|who) {_SEES}(?: there)?|(?:is|are) there{_NO_PLACE}?) "
        r"(?:on|to) the (?:left|right)(?: side)?",
        _unseen,
    ),
)
"""Tried ahead of what is said of people: "can you see anyone behind you" orders no search."""

_SIDE = r"(?:[左右后](?:手?边|面|侧|方)|背后|身后)"
_YOUR = r"(?:你|您|我)?(?:自己)?的?"
_TELLING = r"(?:告诉我们?|说说|说一下|讲讲|描述一下|描述|描绘|报告|汇报)"
_LOOKS = rf"(?!描|告诉|说)(?:{SEE})(?![到见])"
_SEEN = r"(?:(?:看得?|瞧|见)[到见]|发现|数一数|数一下|数数|数|清点|统计)"
_THERE = (
    rf"(?:{WHAT}{_NO_PLACE}|(?:{WHETHER}|[都还]?有){THING}[吗呢么]?|的{THING}"
    rf"|的?(?:是|[坐站躺]着)(?:谁|什么|啥){_NO_PLACE})"
)

CHINESE: tuple[Rule, ...] = (
    rule(
        rf"(?:往|向|朝)[左右后](?:边|面|侧)?{_LOOKS}(?:{_THERE})?"
        rf"|{_LOOKS}{_YOUR}(?:[左右后]|{_SIDE}(?:{_THERE})?)",
        _look_aside,
    ),
    rule(
        rf"(?:你|您)?(?:能|可以)?(?:{_TELLING}|{SEE}|{_SEEN})(?:一下|下|了)?"
        rf"(?:{_NO_PLACE}?在)?{_YOUR}(?:{_SIDE}|左右){_NO_PLACE}",
        _unseen,
    ),
)
