"""Own the English words of orders that hang on something."""

from __future__ import annotations

import re

from planner.language.grammar.compound import CompoundForms, ConditionParts, MemoryParts
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
_PLACED = re.compile(
    r"(?P<thing>(?!there\b|it\b|he\b|she\b|they\b|that\b|this\b|you\b|i\b|we\b|what\b|who\b).+?)"
    r"(?: (?:is|are)|'s)(?P<not> not)?(?: still| already| now)?(?P<where> (?:in|on|at|near|by) .+)"
)
"""Somebody or something known: "if Dad is in the study", "if the dog is not at the door"."""
_NO_THING = re.compile(r"(?:no|not any) (?P<thing>.+)")
_ARTICLE = re.compile(r"^(?:a|an|any|some|the|my|our|your)\b ?")


def _read_condition(said: str) -> ConditionParts | None:
    found = _THERE.fullmatch(said) or _SEES.fullmatch(said) or _BODY.fullmatch(said)
    if found is None:
        return _read_placed(said)
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


def _read_placed(said: str) -> ConditionParts | None:
    """Return the question whether one known person or thing is somewhere."""
    found = _PLACED.fullmatch(said)
    if found is None:
        return None
    thing, where = found["thing"].strip(), found["where"].strip()
    are = "are" if re.fullmatch(r"people|.*(?:[^s]s|people|children)", thing) else "is"
    return ConditionParts(
        f"{are} {thing} {where}",
        _ARTICLE.sub("", thing).strip(),
        found["not"] is not None,
        is_placed=True,
        anybody=f"is there somebody {where}",
    )


_SEEN = r"(?:noticed|spotted|met|come across)"
_EVER = r"(?:ever |already |also |just |recently )?"
_YOU_SAW = re.compile(
    rf"you (?P<never>never )?{_EVER}(?:saw|came across|{_SEEN}) (?P<what>.+)"
    rf"|you (?:have|had)(?P<have_not>n't| not| never)? {_EVER}(?:seen|{_SEEN}) (?P<what_2>.+)"
    rf"|you did(?P<did_not> not)? {_EVER}(?:see|notice|spot|meet|come across) (?P<what_3>.+)"
)
_PEOPLE_WERE = re.compile(
    rf"(?:there (?P<there>was|were) )?(?P<who>{_PERSON}|{_NOBODY})"
    r"(?(there)| (?P<verb>was|were|has been|have been|came|went|walked|entered))(?P<rest> .+)?"
)
_BASE = {"came": "come", "went": "go", "walked": "walk", "entered": "enter"}
_THING_WAS = re.compile(
    r"(?:there (?:was|were) (?P<some>.+?)|(?P<thing>.+?) (?:was|were)(?P<not> not)?)"
    r"(?P<where> (?:in|on|at|near) .+)"
)


def _read_memory(said: str) -> MemoryParts | None:
    """Return the question about before that a condition in the past tense is."""
    saw = _YOU_SAW.fullmatch(said)
    if saw is not None:
        what = saw["what"] or saw["what_2"] or saw["what_3"]
        denied = bool(saw["never"] or saw["have_not"] or saw["did_not"])
        if (without := _NO_THING.fullmatch(what)) is not None:
            what, denied = without["thing"], not denied
        return MemoryParts(f"did you see {_somebody(what)}", denied)
    were = _PEOPLE_WERE.fullmatch(said)
    if were is not None:
        denied, rest = re.fullmatch(_NOBODY, were["who"]) is not None, were["rest"] or ""
        if were["there"] or were["verb"] in ("was", "were"):
            return MemoryParts(f"was somebody{rest}", denied)
        if were["verb"] in _BASE:
            return MemoryParts(f"did somebody {_BASE[were['verb']]}{rest}", denied)
        return MemoryParts(f"has somebody been{rest}", denied)
    was = _THING_WAS.fullmatch(said)
    if was is not None:
        return MemoryParts(
            f"did you see {was['some'] or was['thing']}{was['where']}", bool(was["not"])
        )
    return None


def _somebody(what: str) -> str:
    """Write "no one in the kitchen" and its like as the one that is asked about."""
    return re.sub(rf"^{_NOBODY}\b", "anybody", what)


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

_THEM = r"(?:him|her|them)"
_TOLD_END = r"(?=$|[,;]| and (?:then )?(?:go|come|drive|return|look|find|wait|follow|turn|head)\b)"

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
    read_memory=_read_memory,
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
                rf"\b(?:tell|inform|remind|let) {_THEM} (?:know )?to (?P<w>[^,;\"]+?){_TOLD_END}"
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
    reports=re.compile(
        r"(?:please )?(?:(?:tell|inform|notify|warn|say) me|let me know|say so|report(?: back)?)"
        r"(?: about it| please)?"
    ),
    calls=", ",
    cuts=re.compile(rf" then | (?={_VERBS}\b)"),
    failures=re.compile(
        rf"(?:try to )?(?P<main>.+?)[,;.]? (?:and |but |or )?{_IF} {_FAILS}"
        r"(?:,| then|, then)? (?P<else>.+?)(?: instead)?"
    ),
    rounds=re.compile(
        r"(?P<main>.+?),? (?P<times>twice|thrice|(?:two|three|four|five|six|seven|eight|nine|ten"
        r"|[2-9]|1\d|20) times)"
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
            r"(?:comes(?: in| by| along| over| home| here)?|is (?:there|here|back)|appears|arrives"
            rf"|shows up|turns up|walks in|drops by|gets here|enters){_GO_ON}"
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
