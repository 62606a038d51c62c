"""Own the English words of conditions: what eyes are asked for them, and what memory is.

A condition is read whole or not at all: a state that no eye tells ("if she is asleep") is none.
"""

from __future__ import annotations

import re

from planner.language.grammar.compound_forms import ConditionParts, MemoryParts

PERSON = r"(?:somebody|someone|anybody|anyone|a person|people|a visitor|a guest)"
NOBODY = r"(?:nobody|no one|noone|no people|no person)"

_LEFT = r"(?: (?:left(?: over)?|still|lying(?: around| about)?|standing(?: around)?|sitting))?"
_POSTURE = r"(?: (?:sitting|seated|sat|standing|lying|waiting))?"
"""How somebody is there says no more than that they are, where a place is named with it."""
_THERE = re.compile(
    rf"there(?: is| are|'s)(?: still)? (?P<thing>.+?){_LEFT}"
    r"(?P<where> (?:in|on|at|under|near|by) .+)?"
)
_SEES = re.compile(
    r"you (?:can )?(?P<see>see|find|spot|notice) (?P<thing>.+?)"
    r"(?P<where> (?:in|on|at|under|near|by) .+)?"
)
_BODY = re.compile(
    rf"(?P<thing>{PERSON}|{NOBODY})(?: is|'s)(?: still)?{_POSTURE}"
    r" (?:there )?(?P<where>(?:in|on|at|near|by) .+)"
)
_PLACED = re.compile(
    r"(?P<thing>(?!there\b|it\b|he\b|she\b|they\b|that\b|this\b|you\b|i\b|we\b|what\b|who\b).+?)"
    rf"(?: (?:is|are)|'s)(?P<not> not)?(?: still| already| now)?{_POSTURE}"
    r"(?P<where> (?:in|on|at|near|by) .+)"
)
"""Somebody or something known: "if Dad is in the study", "if the dog is not at the door"."""
_NO_THING = re.compile(r"(?:no|not any)(?: more)? (?P<thing>.+)")
_COUNTED = re.compile(
    r"(?:(?:the|my|our|all) )*(?:\d+|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve"
    r"|both|all|every|each|more|another|other|only|exactly|just|several|many|a few|a couple of)\b.*"
)
"""A look answers whether there is any: how many there must be, its yes does not say."""
_ARTICLE = re.compile(r"^(?:a|an|any|some|the|my|our|your)\b ?")


def read_condition(said: str) -> ConditionParts | None:
    """Return the question that tells whether somebody or something is there."""
    found = _THERE.fullmatch(said) or _SEES.fullmatch(said) or _BODY.fullmatch(said)
    if found is None:
        return _read_placed(said)
    thing, where = found["thing"].strip(), (found["where"] or "").strip()
    denied = re.fullmatch(NOBODY, thing) is not None
    if denied:
        thing = "anybody"
    elif (without := _NO_THING.fullmatch(thing)) is not None:
        thing, denied = without["thing"], True
    if _COUNTED.fullmatch(thing):
        return None
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
    if _COUNTED.fullmatch(thing):
        return None
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
    rf"(?:there (?P<there>was|were) )?(?P<who>{PERSON}|{NOBODY})"
    r"(?(there)| (?P<verb>was|were|has been|have been|came|went|walked|entered))(?P<rest> .+)?"
)
_BASE = {"came": "come", "went": "go", "walked": "walk", "entered": "enter"}
_THING_WAS = re.compile(
    r"(?:there (?:was|were) (?P<some>.+?)|(?P<thing>.+?) (?:was|were)(?P<not> not)?)"
    r"(?P<where> (?:in|on|at|near) .+)"
)


def read_memory(said: str) -> MemoryParts | None:
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
        denied, rest = re.fullmatch(NOBODY, were["who"]) is not None, were["rest"] or ""
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
    return re.sub(rf"^{NOBODY}\b", "anybody", what)
