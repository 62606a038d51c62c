"""Own the English words of orders that hang on something."""

from __future__ import annotations

import re

from planner.language.grammar.compound_forms import CompoundForms
from planner.language.grammar.en.conditions import read_condition, read_memory
from planner.language.numbers import EN_OFTEN, times

_OTHERWISE = (
    r"(?:[,;.]? ?(?:and |but )?(?:otherwise|or else|else|if not|if no)(?:,| then)?(?: just)? )"
)
_ELSE = rf"(?:{_OTHERWISE}(?P<else>.+))?"
_IF = r"(?:if|in case)"
_IF_NOT = r"(?:if|in case|(?P<unless>unless))"
_VERBS = (
    r"(?:please|go|come|drive|return|turn|look|say|tell|wait|find|follow|move|head|patrol|count|stay"
    r"|search|check|visit|ask|let|try|greet|welcome|charge|recharge|dock|remind|inform|notify|warn|report"
    r"|just|announce|stand|meet|drop|wake|give|bring|play|do)"
)
_NOT_BEGUN = r"(?<!\bgo)(?<!\bcome)(?<! and)(?<!\bplease)(?<!\bjust)"
"""An order that has begun before: "go and tell …"."""
_NO_QUESTION = (
    r"(?!.*\b(?:(?:check|see|look|find out|tell|know|ask|report|wonder)(?: \w+)?|say) if\b)"
)
"""“See if somebody is there” asks, and hangs nothing on it."""


def _count(words: str) -> int | None:
    return times(words) if words else None


_THEM = r"(?:him|her|them)"
_TOLD_END = r"(?=$|[,;]| and (?:then )?(?:go|come|drive|return|look|find|wait|follow|turn|head)\b)"

ENGLISH_COMPOUND = CompoundForms(
    trigger=re.compile(r"\b(?:if|unless|in case|twice|thrice|times|slowly|carefully)\b", re.ASCII),
    conditions=(
        re.compile(
            rf"(?:please )?{_IF} (?P<body>(?:there is )?(?:nobody|no one)\b.+?)[,.;]"
            r" ?(?:and |but )?if (?:there is (?:some|any)(?:body|one)|(?:some|any)(?:body|one) is)"
            r"(?: (?:there|in|in there|inside))?,?(?: then)? (?P<else>.+)"
        ),
        re.compile(rf"(?:please )?{_IF_NOT} (?P<body>.+?){_ELSE}"),
        re.compile(
            r"(?:please )?(?:check|see|look|find out) (?:if|whether) (?P<if>.+?)[;,.] ?(?:and )?"
            rf"if (?:so|yes|there is|they are)(?:,| then)? (?P<then>.+?){_ELSE}"
        ),
        re.compile(
            r"(?P<then>.+?),? (?P<unless>unless) (?P<if>.+?)"
            rf"(?:,? (?:and )?in (?:which|that) case,? |{_OTHERWISE})(?P<else>.+)"
        ),
        re.compile(rf"{_NO_QUESTION}(?P<then>.+?),? {_IF_NOT} (?P<if>.+?){_ELSE}"),
    ),
    read_condition=read_condition,
    read_memory=read_memory,
    clock=re.compile(
        r"(?:it is|it's|the time is)(?: already)? (?:(?:after|past|later than) (?P<after>[^,]+)"
        r"|(?:before|earlier than|not yet|not (?:after|past)) (?P<before>[^,]+))"
    ),
    go_there=re.compile(
        r"\b(?P<verb>go|drive|move|head|come|return|get|walk|proceed)(?: over| back)? there\b"
    ),
    to=" to the ",
    tells=(
        (
            re.compile(
                rf"\b(?:tell|inform|remind|let|ask) {_THEM} (?:know )?to"
                rf" (?P<w>[^,;\"]+?){_TOLD_END}"
            ),
            r'say "please \g<w>"',
        ),
        (
            re.compile(
                rf"\b(?:tell|inform|remind|let) {_THEM} (?:know )?(?:that )?"
                r"(?!(?:if|whether|where|what|who|how|when|why|about)\b|(?:a|the) [a-z]+(?:$|[,;]))"
                rf"(?P<w>[^,;\"]+?){_TOLD_END}"
            ),
            r'say "\g<w>"',
        ),
        (
            re.compile(rf"\bask {_THEM} (?=(?:if|whether|what|where|when|how|why|which|who)\b)"),
            "ask ",
        ),
        (re.compile(rf"\bsay (?P<w>[^,;\"]+?) to {_THEM}(?=$|[,;]| and\b)"), r'say "\g<w>"'),
    ),
    calls=", ",
    cuts=re.compile(rf" then |{_NOT_BEGUN} (?={_VERBS}\b)"),
    rounds=re.compile(rf"(?P<main>.+?),? (?:a )?(?P<times>twice|thrice|(?:{EN_OFTEN}) times)"),
    count=_count,
    slowly=re.compile(r"\b(?<!not )(?<!too )(?:very |nice and )?(?:slowly|carefully)\b"),
)
