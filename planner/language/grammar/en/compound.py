"""Own the English words of orders that hang on something."""

from __future__ import annotations

import re

from planner.language.grammar.compound import CompoundForms, ConditionParts
from planner.language.numbers import EN_DURATION, times

_NOT = r"(?:can not|cannot|could not|do not|does not|are not able to|is not)"
_YOU = r"(?:you|it|that|this|the way|the door|there)"
_FAILS = (
    rf"(?:{_YOU} {_NOT}(?: (?:get|(?:go|drive)(?= there| in)|reach|enter|make|find|see|work"
    r"|possible|there|in|it|that|him|her|them|anything|a way|the (?:way|room)|out))*"
    r"|(?:it|that|this|the (?:way|door|room)) (?:fails|is (?:blocked|closed|shut|locked))"
    r"|there is no way(?: there| in)?)"
)
_OTHERWISE = r"(?:[,;.]? ?(?:and |but )?(?:otherwise|or else|else|if not|if no)(?:,| then)? )"
_IF = r"(?:if|in case)"
_PERSON = r"(?:somebody|someone|anybody|anyone|a person|people|a visitor|a guest)"
_NOBODY = r"(?:nobody|no one|noone|no people|no person)"

_VERBS = (
    r"(?:please|go|come|drive|return|turn|look|say|tell|wait|find|follow|move|head|patrol|count|stay"
    r"|search|check|visit|ask)"
)
_NO_QUESTION = r"(?!.*\b(?:check|see|look|find out|tell|know|ask|report|wonder|say)(?: \w+)? if\b)"
"""“See if somebody is there” asks, and hangs nothing on it."""
_THERE = re.compile(
    r"there(?: is| are|'s) (?P<thing>.+?)(?P<where> (?:in|on|at|under|near|by) .+)?"
)
_SEES = re.compile(
    r"you (?:can )?(?P<see>see|find|spot|notice) (?P<thing>.+?)"
    r"(?P<where> (?:in|on|at|under|near|by) .+)?"
)
_BODY = re.compile(
    rf"(?P<thing>{_PERSON}|{_NOBODY})(?: is|'s) (?:there )?(?P<where>(?:in|on|at|near|by) .+)"
)
_NO_THING = re.compile(r"(?:no|not any) (?P<thing>.+)")
_ARTICLE = re.compile(r"^(?:a|an|any|some|the|my|our|your)\b ?")


def _read_condition(said: str) -> ConditionParts | None:
    found = _THERE.fullmatch(said) or _SEES.fullmatch(said) or _BODY.fullmatch(said)
    if found is None:
        return None
    thing, where = found["thing"].strip(), (found["where"] or "").strip()
    denied = re.fullmatch(_NOBODY, thing) is not None
    if denied:
        thing = "anybody"
    elif (without := _NO_THING.fullmatch(thing)) is not None:
        thing, denied = without["thing"], True
    are = "are" if re.fullmatch(r"people|.*[^s]s", thing) else "is"
    return ConditionParts(
        f"{are} there {thing} {where}".strip(),
        _ARTICLE.sub("", thing).strip(),
        denied,
        is_placed=bool(where),
    )


def _count(words: str) -> int | None:
    return times(words) if words else None


_HOURS = {
    word: hour
    for hour, word in enumerate(
        ("twelve", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
         "eleven")
    )
}  # fmt: skip


def _time(words: str) -> str | None:
    found = re.fullmatch(
        r"(?P<half>half past )?(?P<hour>\d{1,2}|[a-z]+)(?::(?P<minute>\d\d))?(?: ?o'?clock)?"
        r"(?: ?(?P<noon>[ap])\.?m\.?)?",
        words,
    )
    if found is None:
        return None
    hour = int(found["hour"]) if found["hour"].isdigit() else _HOURS.get(found["hour"])
    minute = 30 if found["half"] else int(found["minute"] or 0)
    if hour is None or not (hour <= 23 and minute <= 59):
        return None
    if found["noon"] and hour <= 12:
        hour = hour % 12 + (12 if found["noon"] == "p" else 0)
    elif not found["minute"] or found["half"]:
        return None  # "seven" alone: in the morning or in the evening?
    return f"{hour:02d}:{minute:02d}"


_GO_ON = r"(?:[,;.]? ?(?:and then|then|and|,) ?(?P<rest>.+))?"
_BEFORE = r"(?:(?P<before>.+?)(?:,| and then|, then| and|;|\.) )?"
_STAY = r"(?:please )?(?:wait|stay|stand|hold on)(?: here| there| still| right here)*"

ENGLISH_COMPOUND = CompoundForms(
    trigger=re.compile(
        r"\b(?:if|in case|until|till|twice|thrice|times|wait for|slowly|carefully|follow)\b",
        re.ASCII,
    ),
    conditions=(
        re.compile(rf"(?:please )?{_IF} (?P<body>.+?){_OTHERWISE}(?P<else>.+)"),
        re.compile(rf"(?:please )?{_IF} (?P<body>.+)"),
        re.compile(
            rf"(?:please )?(?:check|see|look|find out) (?:if|whether) (?P<if>.+?)[;,.] ?(?:and )?"
            rf"if (?:so|yes|there is|they are)(?:,| then)? (?P<then>.+?){_OTHERWISE}(?P<else>.+)"
        ),
        re.compile(
            r"(?:please )?(?:check|see|look|find out) (?:if|whether) (?P<if>.+?)[;,.] ?(?:and )?"
            r"if (?:so|yes|there is|they are)(?:,| then)? (?P<then>.+)"
        ),
        re.compile(rf"{_NO_QUESTION}(?P<then>.+?),? {_IF} (?P<if>.+?){_OTHERWISE}(?P<else>.+)"),
        re.compile(rf"{_NO_QUESTION}(?P<then>.+?),? {_IF} (?P<if>.+)"),
    ),
    read_condition=_read_condition,
    cuts=re.compile(rf" then | (?={_VERBS}\b)"),
    failures=re.compile(
        rf"(?:try to )?(?P<main>.+?)[,;.]? (?:and |but |or )?{_IF} {_FAILS}"
        r"(?:,| then|, then)? (?P<else>.+?)(?: instead)?"
    ),
    rounds=re.compile(
        r"(?P<main>.+?),? (?P<times>twice|thrice|(?:two|three|four|[2-9]|1\d|20) times)"
    ),
    count=_count,
    waits=(
        re.compile(rf"{_BEFORE}{_STAY}(?: until| till) i say (?P<word>[a-z]+){_GO_ON}"),
        re.compile(
            rf"{_BEFORE}{_STAY}(?: until| till) (?:it is )?"
            rf"(?P<time>(?:half past )?[a-z0-9]+(?::\d\d)?(?: ?[ap]\.?m\.?)?){_GO_ON}"
        ),
        re.compile(
            rf"{_BEFORE}{_STAY}(?: until| till) (?P<who>{_PERSON}) "
            rf"(?:comes|is there|appears|arrives|shows up|is here|comes in){_GO_ON}"
        ),
        re.compile(
            rf"{_BEFORE}{_STAY}(?: until| till) you (?:can )?see (?P<who>{_PERSON}){_GO_ON}"
        ),
        re.compile(
            rf"{_BEFORE}{_STAY} for (?P<who>{_PERSON})"
            rf"(?: to (?:come|appear|arrive|show up))?{_GO_ON}"
        ),
    ),
    time=_time,
    slowly=re.compile(r"\b(?<!not )(?<!too )(?:very |nice and )?(?:slowly|carefully)\b"),
    follows=re.compile(rf"(?P<main>.*\bfollow\b.+?) for {EN_DURATION}"),
)
"""A bare "seven" is no time: whether in the morning or in the evening is not said."""
