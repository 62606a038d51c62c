"""Read English orders to be told or asked something at a time: "at six tell me to turn it off".

They are reminders: what is told stands in one clause, and what is asked is turned to the person
("whether I have eaten" is "have you eaten?"). Pure. Law: a clause that goes on with another order
or a condition, or a question that can't be turned, is no reminder.
"""

from __future__ import annotations

import re

from planner.language.schedule import english
from planner.language.schedule.command import ScheduleCommand
from planner.language.schedule.folded_sentence import FoldedSentence
from planner.language.schedule.parts import combine
from planner.language.schedule.time_finder import FoundTime, first_parts, last_parts
from planner.plan.timing import EventRule

TELLS = re.compile(r"(?:tell|(?P<asks>ask)) (?:me|us)(?![\w'])[ ,]*")
_ONE = (
    r"(?!.*(?:;|:|\b(?:if|unless|until|otherwise)\b"
    r"|(?:,|\band\b|\bthen\b) ?(?:and |then )*(?:if|when|go|come|drive|say|tell|ask|remind|look|find|wait|turn|patrol|check)\b))"
)
_TO = re.compile(rf"(?P<how>to|that) (?P<what>{_ONE}.+)")
_WHETHER = re.compile(rf"(?:whether|if) (?P<what>{_ONE}.+)")
_I = (
    (re.compile(r"(?:i|we)(?:'ve| have) (?!to\b)(?P<rest>.+)"), "have you {}?"),
    (re.compile(r"(?:i'm|i am|we're|we are) (?P<rest>.+)"), "are you {}?"),
    (re.compile(r"(?:i|we)(?:'ll| will) (?P<rest>.+)"), "will you {}?"),
    (re.compile(r"(?:i|we) (?P<can>can|should|could|must|would|was|were|had) (?P<rest>.+)"), "{can} you {}?"),
    (re.compile(r"(?:i|we) (?P<rest>(?:still |also |really )?(?:need|want|like|feel|have to|remember|know)\b.*)"),
     "do you {}?"),
)  # fmt: skip
_IT = re.compile(
    r"(?P<who>(?:the|my|our) (?:[a-z]+ ){0,2}?[a-z]+|it|he|she|they|everyone|everybody|somebody|anyone|[A-Z][a-z]+)"
    r"(?:(?P<short>'s)| (?P<is>is|are|was|were|has|have|will|can)) (?P<rest>.+)"
)
_TURNED = {"my": "your", "me": "you", "mine": "yours", "myself": "yourself", "our": "your",
           "us": "you", "i": "you", "we": "you", "ourselves": "yourselves"}  # fmt: skip
_YOU = re.compile(r"\b(?:you|your|yours)\b", re.IGNORECASE)


def read_told(words: str, *, asks: bool, timed: bool) -> str | None:
    """Return the words of a reminder; None where what is told or asked is none.

    Args:
        words: what stands behind "tell me" or "ask me" and its time, as it was written.
        asks: it is asked.
        timed: the time stands before it, so that one behind it is of what is told.
    """
    if asks:
        found = _WHETHER.fullmatch(words)
        return turn_question(found["what"].strip(" .!?")) if found is not None and timed else None
    found = _TO.fullmatch(words)
    if found is None or (found["how"] == "that" and not timed):
        return None
    return found["what"].strip(" .!")


def turn_question(words: str) -> str | None:
    """Return the question to a person that an indirect one is; None where it can't be turned."""
    if _YOU.search(words) is not None:
        return None  # "whether I need you": who is meant by what?
    lowered = words[:1].lower() + words[1:] if re.match(r"(?:I|We)\b", words) else words
    for pattern, form in _I:
        found = pattern.fullmatch(lowered)
        if found is not None:
            can = {"was": "were"}.get(
                found.groupdict().get("can") or "", found.groupdict().get("can")
            )
            return _capital(form.format(_turn(found["rest"]), can=can))
    found = _IT.fullmatch(lowered)
    if found is None:
        return None
    verb = found["is"] or ("has" if re.match(r"(?:been|got|had|done)\b", found["rest"]) else "is")
    return _capital(f"{verb} {_turn(found['who'])} {_turn(found['rest'])}?")


def _turn(words: str) -> str:
    return re.sub(r"[A-Za-z]+", lambda each: _TURNED.get(each[0].lower(), each[0]), words)


def _capital(words: str) -> str:
    return words[:1].upper() + words[1:]


def read_told_order(rest: FoldedSentence, before: FoundTime) -> ScheduleCommand | None:
    """Read what a person wants to be told or asked at a time: it is a reminder."""
    tells = TELLS.match(rest.folded)
    if tells is None:
        return None
    inner = rest.part(tells.end())
    middle = first_parts(inner.folded, english)
    inner = inner.part(middle.at).bare()
    parts = (*before.parts, *middle.parts)
    after = last_parts(inner.folded, english) if not parts else FoundTime((), len(inner.folded))
    timing = combine(parts or after.parts)
    what = read_told(
        inner.part(0, after.at).bare().written, asks=bool(tells["asks"]), timed=bool(parts)
    )
    if timing is None or what is None or isinstance(timing.when, EventRule):
        return None
    return ScheduleCommand(timing.when, what, "", reminder=what, problem=timing.problem)
