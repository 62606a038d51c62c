"""Leave out what is said around an order and orders nothing: courtesy, praise, a state of things.

A marked sentence is cut into clauses, and each that is an aside as a whole goes: a formula of
courtesy ("bless you", 辛苦啦), a check ("do you hear me?"), or a statement of how things stand ("my
back hurts", 我走不动了). Laws: no clause goes that names a place, a time or a number, that orders,
denies (but for what somebody can't), excepts, quotes, corrects, or hangs something on something;
something must be left, and it is read with all vetoes. So "don't", "instead" and "if" stay.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from planner.language.catalogue import say
from planner.language.folding import has_chinese
from planner.language.grammar.en.asides import ENGLISH_ASIDES
from planner.language.grammar.lexicon import MARK
from planner.language.grammar.sentence_text import normalise
from planner.language.grammar.zh.asides import CHINESE_ASIDES
from planner.plan import AnswerPlan

if TYPE_CHECKING:
    from planner.language.grammar.aside_forms import AsideForms

_MOST_CLAUSES = 12
_CUT = re.compile(r"\s*(?:[,;:!?。]+|\.+(?!\d)|\s[-–—]+\s|—+)\s*")

_TELLS_WHERE = re.compile(
    rf"(?:(?:oh|no|well|ah),? )*(?:he|she|they|it)(?: is|'s| are|'re) [^,.;!]*[,.;!]+"
    rf" (?:(?:sorry|no|well|i mean)[, ]+)*(?:in|on|at|by|under|near) (?:the |my |our )?{MARK}"
)


@dataclass(frozen=True, slots=True)
class _Clause:
    """Hold a clause and the mark behind it."""

    text: str
    mark: str


def without_asides(text: str) -> str:
    """Return a marked sentence without its asides; the same where it has none, or nothing else."""
    if tells_where(text):
        return text
    asides = CHINESE_ASIDES if has_chinese(text) else ENGLISH_ASIDES
    said = asides.closing.sub("", asides.opening.sub("", text.strip().rstrip(".!。")))
    clauses = [each for clause in _cut(said) for each in _part(clause, asides.seam)]
    if len(clauses) > _MOST_CLAUSES:
        return text
    speech = next((at for at, each in enumerate(clauses) if asides.speaks.search(each.text)), None)
    kept = [
        each
        for at, each in enumerate(clauses)
        if not _is_aside(each.text, asides, words=speech is not None and at > speech)
    ]
    if not kept or (len(kept) == len(clauses) and said == text.strip().rstrip(".!。")):
        return text
    if kept[0] is not clauses[0]:
        kept[0] = _Clause(asides.joint.sub("", kept[0].text), kept[0].mark)
    last = clauses[-1].mark if clauses[-1].text.endswith(kept[-1].text) else ""
    kept[-1] = _Clause(kept[-1].text, last)
    return "".join(f"{each.text}{each.mark}" for each in kept).strip(" ,;")


def tells_where(text: str) -> bool:
    """Tell whether somebody is said to be at a place: "she's upstairs, in the bedroom"."""
    return _TELLS_WHERE.fullmatch(text.strip(" .!")) is not None


def answer_praise(text: str) -> AnswerPlan | None:
    """Return the answer to a sentence that is nothing but courtesy, with thanks or praise in it."""
    said = normalise(text)
    asides = CHINESE_ASIDES if has_chinese(said) else ENGLISH_ASIDES
    clauses = [clause.text.strip(" \"'") for clause in _cut(said)]
    known = all(asides.formula.fullmatch(c) or asides.praise.fullmatch(c) for c in clauses)
    praises = known and any(asides.praise.fullmatch(clause) for clause in clauses)
    return AnswerPlan(text=say("talk.thanks")) if praises else None


def _cut(text: str) -> list[_Clause]:
    clauses: list[_Clause] = []
    start = 0
    for cut in _CUT.finditer(text):
        if cut.start() > start:
            clauses.append(_Clause(text[start : cut.start()], cut[0]))
        start = cut.end()
    if start < len(text):
        clauses.append(_Clause(text[start:], ""))
    return clauses


def _part(clause: _Clause, seam: re.Pattern[str]) -> list[_Clause]:
    """Part "sorry to bother you but go there" where a formula ends."""
    found = seam.match(clause.text)
    if found is None:
        return [clause]
    return [_Clause(found["aside"], " "), _Clause(clause.text[found.end() :], clause.mark)]


def _is_aside(clause: str, asides: AsideForms, *, words: bool) -> bool:
    """Tell whether a clause may go; behind words to be said no statement does: it may be one."""
    said = clause.strip(" \"'")
    if asides.formula.fullmatch(said) is not None:
        return True
    return not words and any(pattern.fullmatch(said) is not None for pattern in asides.states)
