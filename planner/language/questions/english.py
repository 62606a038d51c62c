"""Read English questions about what is there: their patterns, and what each of them asks for.

Matched against folded words in lower case with single spaces, without punctuation at their ends.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.questions.question import ObjectQuestion

if TYPE_CHECKING:
    from collections.abc import Iterator

    from planner.language.questions.question import PlaceNames

_WHERE = (
    r"(?: (?:here|there|anywhere|somewhere|nearby|left|too|(?:right )?now|at all|in sight|ahead))*"
    r"(?: (?P<where>(?:in|on|at|under(?:neath)?|below|beneath|near|by|beside|inside|behind|around"
    r"|outside|next to|close to) .+))?"
)
_A = r"(?:(?:an?|any|some|another|the|my|our|your|his|her|their|this|that|these|those) )"
_NOUN = r"(?P<what>[a-z][a-z'-]*(?: [a-z][a-z'-]*){0,2}?)"
_THERE_IS = re.compile(
    r"(?:(?:please|hey|and|so|ok|now)[ ,]+)*"
    r"(?:(?:is|are) there |(?P<sees>(?:do|can|could|did) you see )"
    r"|[a-z, ]{0,30}\b(?:check|see|look|tell me|tell us|know|find out|say) (?:if|whether) "
    r"(?:there (?:is|are) |(?P<may>you (?:can )?see )))"
    rf"(?P<a>{_A})?{_NOUN}{_WHERE}"
)
_IF = r"(?:[a-z, ]{0,30}\b(?:check|see|look|tell me|tell us|know|find out|say) (?:if|whether) )"
_SITS = r"(?: sitting(?= on (?!(?:the |your )?(?:floor|ground)\b)))?"
"""Who is on a chair sits there; who is on the floor may stand."""
_IS_IT = re.compile(rf"(?:is|are) {_A}{_NOUN}(?: still| now)?{_SITS}(?= ){_WHERE}")
_IF_IT_IS = re.compile(rf"{_IF}{_A}{_NOUN} (?:is|are)(?: still| now)?{_SITS}(?= ){_WHERE}")
_ANYBODY = re.compile(
    rf"(?:(?:please|hey|and|so|ok|now)[ ,]+)*{_IF}?(?:(?:is|are) )?"
    rf"(?P<what>(?:any|some)(?:body|one)|any [a-z'-]+(?: [a-z'-]+)?)(?: is| are)?{_SITS}{_WHERE}"
)
_NO_NOUN = re.compile(
    r"\b(?:about|and|as|at|but|by|for|from|in|into|it|like|not|of|off|on|or|out|over|than|that|the"
    r"|to|up|what|when|where|which|who|with|without|you|me|him|them|us|he|she|they|else|enough|lots?"
    r"|many|more|most|much|ones?|others?|any|some|all|both|less|few|open|closed|shut|wrong|missing"
    r"|free|available|ready|broken|new|different|strange)\b"
)
_VAGUE = re.compile(
    r"(?:thing|stuff|something|anything|everything|nothing|object|item|kind|sort|type|food|drink"
    r"|meal|furniture|animal|pet|fruit|vegetable|toy|clothe|clothing|dish|tableware|cutlery|vehicle"
    r"|appliance|device|electronic|container|obstacle|trash|rubbish|garbage|litter|dirt|dust|mess"
    r"|space|room|place|way|light|sound|noise|smell|movement|activity|change|problem|danger|damage"
    r"|difference|reason|chance|need|point|sign|text|word|number|colou?r|view|people|crowd|group"
    r"|family|friend|neighbou?r|stranger|burglar|thief|intruder|(?:grand)?(?:mother|father|ma|pa)"
    r"|mom|mum|dad|parent|son|daughter|brother|sister|wife|husband|aunt|uncle|doctor|nurse|teacher"
    r"|student|worker|owner)(?:e?s)?"
)
_OPEN = re.compile(
    r"(?:[a-z, ]{0,30}\b)?(?:what|who)(?: else)?(?: (?:is|are|do|can|you|see|there|things?|lying"
    r"|standing|sitting|lies|stands|sits))* (?P<where>(?:in|on|at|under|below|beneath|near|by"
    r"|beside|inside|behind|around|next to|close to)\b.+)"
)

THE = r"(?:(?:the|this|that|my|our|your) )?"
WHEREABOUTS = re.compile(
    r"(?:(?P<on>on(?: top of)?)|(?P<under>under(?:neath)?|below|beneath)"
    r"|(?P<near>near|next to|beside|close to|by|at|around)"
    r"|(?P<odd>in front of|in|inside|behind|outside)) (?P<by>.+?)"
    r"(?: (?:still|now|right now|there|here|over there|please))*"
)
HERE = re.compile(
    rf"here|there|you|me|us|all|home|sight|view|front(?: of (?:you|me|us))?"
    rf"|{THE}(?:room|house|home|flat|apartment|place|picture|image|view|moment)"
)
IN_HERE = re.compile(rf" in(?:side)? {THE}(?:room|house|home|flat|apartment|picture)$")
RELATED = re.compile(
    r"(?P<what>.+?) (?:(?P<on>on(?: top of)?)|(?P<under>under(?:neath)?|below|beneath)"
    r"|(?P<near>near|next to|beside|close to|by)) (?P<by>.+)"
)
SEVERAL = re.compile(r"\b(?:all|every|each|any|both|two|three|\d+)\b")
FLOOR = re.compile(r"(?:the |your )?(?:floor|ground)")
ROUND = re.compile(
    r"\b(?:look|turn)(?:s|ing)? (?:all )?a?round\b|\b(?:all around|everywhere|surroundings)\b"
    r"|\baround(?: (?:you|me|us|here|there|the (?:room|house|home|place|flat)))?[ ?.!]*$"
)
"""To look about; "a round table" and "around the table" are things to look at."""


def read_yes_no(text: str, names: PlaceNames) -> Iterator[ObjectQuestion]:
    """Yield what a question may ask for, yes or no."""
    found = _THERE_IS.fullmatch(text)
    if found is not None:
        named = not found["a"] and (found["sees"] or found["may"])  # Mary may be seen, no cat
        what, head = found["what"], found["what"].split()[-1]
        vague = _VAGUE.fullmatch(head) is not None or _NO_NOUN.search(what) is not None
        certain = not (named or vague or names.get(what))
        yield ObjectQuestion(what, certain, found["where"] or "")
    found = _IS_IT.fullmatch(text)
    if found is not None:
        yield ObjectQuestion(found["what"], where=found["where"] or "")
    found = _IF_IT_IS.fullmatch(text) or _ANYBODY.fullmatch(text)
    if found is not None:
        yield ObjectQuestion(found["what"], where=found["where"] or "", may_refuse=False)


def open_at(text: str) -> str | None:
    """Return the words for where everything is asked for: "what is on the table?"; else None."""
    found = _OPEN.fullmatch(text)
    return found["where"] if found is not None else None


def loosely(text: str) -> tuple[str, str]:
    """Return what a sentence says before its neighbour, and what of that."""
    found = RELATED.fullmatch(text)
    if found is None:
        return text, ""
    how = next(how for how in ("on", "under", "near") if found[how])
    return found["what"], f"{how} {found['by']}"
