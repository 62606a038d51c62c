"""Turn a place phrase into a place: the name whole, or with what adds nothing to it.

"the kitchen", "near the sofa", "the desk in the study", "客厅的沙发旁边". Any other word beside a
name ("the kitchen door", "behind the sofa") is not passed over: the phrase is then not understood.
"""

from __future__ import annotations

import re

from planner.language.grammar.lexicon import MARK
from planner.language.grammar.parse_result import Meaning, Problem, Reading, Steps
from planner.plan import Code, GoTo

_THE = r"(?:(?:the|a|my|our|your|this|that) )?"
_EN = re.compile(
    rf"(?:(?P<near>next to|near|by|beside|close to|up to) |at |over to )?{_THE}(?P<a>{MARK})"
    rf"(?: room| area)?(?: (?:in|of|inside) {_THE}(?P<room>{MARK}))?"
)
_ZH = re.compile(
    rf"(?:这个|那个|那边的|我的|我们的)?(?:(?P<room>{MARK})(?:里面?)?的?)?(?P<a>{MARK})"
    r"(?:(?P<near>的?(?:旁边|边上|附近|跟前|边|旁))|里面?|内|那边|那里|那儿|这边|这里|处)?"
)
_DETERMINER = re.compile(r"^(?:(?:the|a|an|my|our|your) )+")
_ZH_TAIL = re.compile(r"(?:里面?|内|那边|那里|那儿|这边|这里|旁边|附近|跟前)$")


def go_to(phrase: str, reading: Reading) -> Meaning:
    """Return the go-to step of a place phrase, or why there is none."""
    phrase = phrase.strip(" \"'")
    found = _EN.fullmatch(phrase) or _ZH.fullmatch(phrase)
    if found:
        return _named(found, phrase, reading)
    if re.search(MARK, phrase):
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    return _unnamed(phrase, reading)


def _named(found: re.Match[str], phrase: str, reading: Reading) -> Meaning:
    mention = reading.marked.mention(found["a"])
    room = found["room"]
    if len(mention.ids) > 1:
        ids = mention.ids
        return Problem(Code.AMBIGUOUS, reading.marked.restore(phrase), places=ids)
    entry = reading.vocabulary.by_id[mention.ids[0]]
    about_a_room = entry.kind == "room" and found["near"] is not None
    in_its_room = room is None or entry.room in reading.marked.mention(room).ids
    if about_a_room or not in_its_room:  # "near the kitchen" is not in it; the sofa is elsewhere
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    return Steps((GoTo(place=entry.id),))


def _unnamed(phrase: str, reading: Reading) -> Meaning:
    name = _ZH_TAIL.sub("", _DETERMINER.sub("", phrase)).strip()
    if not any(char.isalnum() for char in name):
        return reading.problem(Code.NOT_UNDERSTOOD, phrase)
    meant = reading.lexicon.typo(name)
    if meant is not None:
        return Steps((GoTo(place=meant),))
    name = reading.marked.restore(name)
    return Problem(Code.UNKNOWN_PLACE, name, places=reading.lexicon.near(name), name=name)
