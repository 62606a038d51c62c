"""Say in full a condition that leans on a question before it: "if he is, tell him …", 要是不在就….

Pure text to text. "Is Dad in the study?" and "if he is, say hello" are together "if Dad is in the
study, say hello". Law: the condition is written out only where the question asks whether one person
or thing is at one place, and where the sentence names no other condition; the order that hangs on
it is left word for word, for a grammar to read with all its vetoes.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from planner.language.folding import has_chinese

_WHERE = r"(?:in|inside|at|on|near|by) [^,;?]+"
_ASKS = (
    r"(?:(?:please|can you|could you|will you|just|go|come|and|to) )*"
    r"(?:see|check|look|find out|tell me|let me know)(?: and (?:see|check))? (?:if|whether) "
)
_SUBJECT = r"(?P<who>(?!there\b|it\b|he\b|she\b|they\b|that\b|this\b|you\b|i\b|we\b)[^,;?]{1,40}?)"
_STILL = r"(?: (?:still|already|now|around))?"
_ASKED = (
    re.compile(
        rf"(?:{_ASKS}|is |are )there (?:is |are )?(?P<who>[^,;?]{{1,40}}?)"
        rf"(?: (?P<where>{_WHERE}))?",
        re.IGNORECASE,
    ),
    re.compile(
        rf"{_ASKS}{_SUBJECT}(?: is| are|'s|'re){_STILL}"
        rf" (?:(?P<where>{_WHERE})|there|in|home|around)",
        re.IGNORECASE,
    ),
    re.compile(
        r"(?:(?:please|can you|could you|will you|just|go|come|and|to) )*(?:check|search|scan|scour"
        r"|(?:have a )?look(?: a?round)?(?: in| on| at| under)?) (?:the|my|our) [^,;?]+? for"
        r" (?P<who>(?:the|my|our|an?|some|any) [^,;?]{1,40}?)",
        re.IGNORECASE,
    ),
    re.compile(rf"(?:is|are) {_SUBJECT}{_STILL} (?P<where>{_WHERE})", re.IGNORECASE),
    re.compile(rf"(?:is|are) {_SUBJECT}{_STILL} (?:there|in|around)", re.IGNORECASE),
)
_LOOK_ZH = r"(?:请|帮我|你|去|再|先)*(?:看一看|看一下|看看|看|瞧瞧|瞅瞅|确认一下|查一下)?"
_HAS = r"(?:有没有|是否有|是不是有|有无|有)"
_ASKED_ZH = (
    re.compile(
        rf"{_LOOK_ZH}(?P<where>(?![看瞧瞅去])[^,，。?？有在]{{1,8}}?)?(?:里面?|那边|那儿|那里)?还?{_HAS}"
        r"(?P<who>[^,，。?？有]{1,10}?)(?:在)?[吗么呢没]?"
    ),
    re.compile(
        rf"{_LOOK_ZH}(?P<who>[^,，。?？有在不]{{1,10}}?)还?(?:在不在|是不是在|是否在|在没在|在)"
        r"(?P<where>[^,，。?？有在]{1,8}?)(?:里面?|那边|那儿)?[吗么呢没]?"
    ),
    re.compile(rf"{_LOOK_ZH}(?P<who>[^,，。?？有在不]{{1,10}}?)还?(?:在不在|在没在|在吗)"),
)
_ANYBODY = re.compile(
    r"(?:any|some)(?:body|one)(?: else)?|any people|people|a person|who", re.IGNORECASE
)
_SOME = re.compile(r"(?:any|some|an?) ", re.IGNORECASE)

_HE = r"(?:he|she|it|they|there|that one|the (?:man|woman|person|cat|dog)|someone|somebody|anyone)"
_ANY = r"(?: (?:somebody|someone|anybody|anyone|any|one|some))?"
_PLACED = r"(?: (?:there|in there|in here|in|at home|home|around))?"
_HOLDS = (
    rf"if (?:so|yes|{_HE}(?: is|'s| are|'re){_ANY}{_PLACED}"
    r"|you (?:do )?(?:see|find|spot) (?:him|her|it|them|one|any(?:one|body)|some(?:one|body)))"
)
_LACKS = (
    rf"if (?:not|no|{_HE}(?: is| are| ?ain't|'s|'re)(?: not|n't){_ANY}{_PLACED}"
    rf"|there(?: is|'s) (?:nobody|no one|no-one|none){_PLACED}|(?:nobody|no one)(?: is|'s){_PLACED}"
    r"|you (?:do not|don't|cannot|can not|can't) (?:see|find|spot)"
    r" (?:him|her|it|them|one|any(?:one|body))(?: there| in there)?"
    r"|(?:you have|you've|with) no luck(?: there)?|no luck(?: there)?"
    r"|there(?: is|'s) no (?:sign|trace) of (?:him|her|it|them)(?: there)?)"
)
_VERB = (
    r"(?:go|come|drive|tell|say|ask|look|find|wait|follow|turn|check|head|return|try|search|let|just"
    r"|have a look|take a look|never mind|greet|charge|dock|stay|remind|visit|move|get)"
)
_END = rf"(?= ?[,;.]| then| (?:please )?{_VERB}\b)"
_BEHIND = rf"{_END}(?:[,;.]| then)* (?P<then>.+?)"
_ELSE = rf"[,;.]? (?:and |but )?(?:otherwise|or else|else|{_LACKS})(?:,| then)* (?P<else>.+)"
_ELSE_YES = rf"[,;.]? (?:and |but )?(?:otherwise|or else|else|{_HOLDS})(?:,| then)* (?P<else>.+)"
_LEAD = r"(?:(?:and|then|ok|okay|so|well|now|right|please|but|good)[, ]+)*"
_LEANS = (
    (True, re.compile(rf"{_LEAD}{_HOLDS}{_BEHIND}(?:{_ELSE})?", re.IGNORECASE)),
    (
        False,
        re.compile(rf"{_LEAD}{_LACKS}{_BEHIND}(?:{_ELSE_YES})?", re.IGNORECASE),
    ),
    (
        False,
        re.compile(rf"{_LEAD}(?:otherwise|or else|else)[, ]+(?:then )?(?P<then>.+)", re.IGNORECASE),
    ),
    (
        True,
        re.compile(
            r"(?:and )?then (?P<then>[^,;]+?)[,;]? (?:otherwise|or else|else|if not)[, ]+"
            r"(?:then )?(?P<else>.+)",
            re.IGNORECASE,
        ),
    ),
    (True, re.compile(rf"{_LEAD}(?P<then>(?!if\b)[^,;]+?),? {_HOLDS}", re.IGNORECASE)),
    (False, re.compile(rf"{_LEAD}(?P<then>(?!if\b)[^,;]+?),? {_LACKS}", re.IGNORECASE)),
)
_IF_ZH = r"(?:如果|要是|假如|若是|倘若|若)"
_HE_ZH = r"(?:他们|她们|他|她|它|人)?(?:还|真的?|确实|就)?"
_THERE_ZH = r"(?:那儿|那里|那边|那|家|里面?)?"
_SOME_ZH = r"有(?:人(?:在)?(?![来进过出回到经路走])|(?!人))"
"""Who comes is waited for: 有人来 is no question whether somebody is there."""
_HOLDS_ZH = (
    rf"(?:{_IF_ZH}{_HE_ZH}(?:在{_THERE_ZH}|{_SOME_ZH}|是(?:的)?)(?:的话)?"
    rf"|(?:{_IF_ZH})?(?:你)?(?:看到|看见|发现|瞧见){_SOME_ZH}(?:的话)?(?=[就便,，])"
    rf"|{_HE_ZH}在{_THERE_ZH}的话|有人?(?:在)?的话|有人?(?=[就便])|{_HE_ZH}在{_THERE_ZH}(?=[就便]))"
)
_LACKS_ZH = (
    rf"(?:{_IF_ZH}{_HE_ZH}(?:都)?(?:不在{_THERE_ZH}|没在{_THERE_ZH}|没有?人?(?:在)?|不是)(?:的话)?"
    rf"|{_HE_ZH}不在{_THERE_ZH}(?:的话)?|没有?人?(?:在)?的话|没有?人?(?=[就便]))"
)
_SO_ZH = r"[,，]?(?:那么|那)?(?:你)?(?:就|便)?(?:再)?(?:帮我|给我|替我)?"
_OTHERWISE_ZH = r"(?:否则的?话?|不然的?话?|要不然的?话?)"
_LEAD_ZH = r"(?:那|那么|好的?|嗯|然后|但是?|,|，)*"
_LEANS_ZH = (
    (
        True,
        re.compile(
            rf"{_LEAD_ZH}{_HOLDS_ZH}{_SO_ZH}(?P<then>.+?)"
            rf"(?:[,，;；。](?:{_OTHERWISE_ZH}|{_LACKS_ZH}){_SO_ZH}(?P<else>.+))?"
        ),
    ),
    (
        False,
        re.compile(
            rf"{_LEAD_ZH}{_LACKS_ZH}{_SO_ZH}(?P<then>.+?)"
            rf"(?:[,，;；。](?:{_OTHERWISE_ZH}|{_HOLDS_ZH}){_SO_ZH}(?P<else>.+))?"
        ),
    ),
    (False, re.compile(rf"{_LEAD_ZH}{_OTHERWISE_ZH}{_SO_ZH}(?P<then>.+)")),
)
_OTHER_CONDITION = re.compile(
    r"\b(?:if|unless|when|whether|until|while|otherwise|else)\b|如果|要是|假如|除非|否则|不然|的话",
    re.IGNORECASE,
)
_ASK_IF = re.compile(r"\bask (?:him|her|them|it|[a-z]+) (?:if|whether)\b", re.IGNORECASE)
_AT_SUBJECT = re.compile(
    r"\b(?P<verb>(?:go|drive|come|walk)(?: up| over| right)* to|approach|follow|greet|find|count)"
    r" (?:him|her|it|them)\b",
    re.IGNORECASE,
)


@dataclass(frozen=True, slots=True)
class WhetherThere:
    """Hold a question whether somebody or something is somewhere, in its own words."""

    who: str
    where: str
    """A phrase with its preposition in English, a place's name in Chinese; empty: not said."""


def read_whether_there(question: str) -> WhetherThere | None:
    """Return who or what a question asks about, and where; None of any other question."""
    said = " ".join(question.split()).strip(" .!?。！？,，")
    for pattern in _ASKED_ZH if has_chinese(said) else _ASKED:
        found = pattern.fullmatch(said)
        if found is not None and (who := found["who"].strip()):
            return WhetherThere(who, (found.groupdict().get("where") or "").strip())
    return None


def write_condition(asked: WhetherThere, place: str, text: str) -> str | None:
    """Return a leaning sentence with its condition in full; None where it leans on nothing.

    Args:
        asked: the question before it.
        place: the name of the place where is looked, for a question that says "there".
        text: the sentence as it was said.
    """
    leaning = _read_leaning(text)
    chinese = has_chinese(text)
    if leaning is None or chinese is not has_chinese(asked.who):
        return None
    holds, order, other = leaning
    if any(_OTHER_CONDITION.search(_ASK_IF.sub("", part)) for part in (order, other)):
        return None
    if chinese:
        where = asked.where or place
        has = "有" if holds else "没有"
        condition = f"如果{where}{has}{asked.who}，就{order}"
        return condition + (f"，否则{other}" if other else "")
    where = asked.where or (f"in the {place}" if place else "")
    state = _state(asked.who, holds=holds) if where else _state_here(asked.who, holds=holds)
    if state is None:
        return None
    condition = f"if {f'{state} {where}'.strip()}, {_at_subject(order, asked.who)}"
    return condition + (f", otherwise {_at_subject(other, asked.who)}" if other else "")


def _state(who: str, *, holds: bool) -> str:
    """Return "Dad is", "there is no cup": whether somebody or something is there."""
    if _ANYBODY.fullmatch(who):
        return "somebody is" if holds else "nobody is"
    some = _SOME.match(who)
    if some is not None:
        bare = who[some.end() :]
        is_ = "are" if some[0].lower() in ("any ", "some ") and bare.endswith("s") else "is"
        return f"there {is_} {who}" if holds else f"there {is_} no {bare}"
    is_ = "are" if re.search(r"(?:[^s]s|people|children|men)$", who) else "is"
    return f"{who} {is_}" if holds else f"{who} {is_} not"


def _state_here(who: str, *, holds: bool) -> str | None:
    """Return "there is somebody", where the robot stands; None of one who is known by name."""
    if _ANYBODY.fullmatch(who):
        return "there is somebody" if holds else "there is nobody"
    return _state(who, holds=holds) if _SOME.match(who) else None


def _at_subject(order: str, who: str) -> str:
    """Return an order with the thing that is asked about for its pronoun."""
    if _ANYBODY.fullmatch(who):
        return order
    named = _SOME.sub("the ", who)
    return _AT_SUBJECT.sub(lambda found: f"{found['verb']} {named}", order)


def _read_leaning(text: str) -> tuple[bool, str, str] | None:
    """Return whether an order hangs on a yes, the order, and the one that hangs on the contrary."""
    said = " ".join(text.replace("’", "'").split()).strip(" .!?。！？")
    for holds, pattern in _LEANS_ZH if has_chinese(said) else _LEANS:
        found = pattern.fullmatch(said)
        if found is not None:
            other = found.groupdict().get("else") or ""
            return holds, found["then"].strip(" ,，;"), other.strip(" ,，;")
    return None
