"""Read what a person wants remembered or forgotten: whole sentences, word for word. Pure.

A fact is no order, whatever it says. A sentence that goes on after it is left to a brain.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.commands import chinese, english
from planner.language.commands.command import ForgetFacts, TeachFact
from planner.language.commands.statements import find_statement
from planner.language.folding import fold_script, fold_width, has_chinese

if TYPE_CHECKING:
    from types import ModuleType

    from planner.language.commands.folded_text import FoldedText

_ENDS = " .!,;:。~…"
_QUOTES = "\"'「」『』“”‘’《》"
_APOSTROPHES = str.maketrans({"’": "'", "‘": "'", "，": ",", "；": ";", "：": ":", "、": ","})
MAX_STATEMENT = 90
"""Characters; a flat statement is short."""


def read_fact_order(said: FoldedText, grammar: ModuleType) -> TeachFact | ForgetFacts | None:
    """Return what is to be remembered or forgotten, or None."""
    return _read_forgetting(said, grammar) or _read_teaching(said, grammar)


def read_long_fact(said: FoldedText, grammar: ModuleType) -> TeachFact | None:
    """Return what is to be remembered of a text that is too long for any other command."""
    return _read_teaching(said, grammar) if grammar.LESSON.match(said.folded) else None


def _read_forgetting(said: FoldedText, grammar: ModuleType) -> ForgetFacts | None:
    for pattern, told, seen in (
        (grammar.FORGET_TOLD, True, False),
        (grammar.FORGET_SEEN, False, True),
        (grammar.FORGET_ALL, True, True),
        (grammar.FORGET_ABOUT, True, True),
    ):
        found = pattern.fullmatch(said.folded)
        if found is None:
            continue
        group = next((name for name, text in found.groupdict().items() if text), None)
        about = said.part(*found.span(group)).written if group else ""
        about = about.strip(_ENDS + _QUOTES)
        if pattern is grammar.FORGET_ABOUT and (not about or _PRONOUN.fullmatch(about.lower())):
            return None
        return ForgetFacts(about, told=told or bool(about), seen=seen)
    return None


_PRONOUN = re.compile(
    r"it|that|this|them|him|her|me|us|you|going.*|driving.*|那|这|它|他|她|我|你|刚才|刚才说"
)


def _read_teaching(said: FoldedText, grammar: ModuleType) -> TeachFact | None:
    found = grammar.TEACH.fullmatch(said.folded)
    kept = grammar.KEPT.search(said.folded)
    if kept is not None and grammar.STATEMENT.fullmatch(said.folded[: kept.start()]):
        return TeachFact(said.part(0, kept.start()).written.strip(_ENDS + _QUOTES))
    if found is None:
        return None
    group = next(name for name, text in found.groupdict().items() if text is not None)
    fact = said.part(*found.span(group))
    words = fact.written.strip(_ENDS + _QUOTES)
    here = grammar.THIS_IS.fullmatch(fact.folded) is not None
    return TeachFact(words, here=here) if words else None


def read_statement(text: str) -> TeachFact | None:
    """Return a flat statement of where something is, as a fact; None for anything else."""
    written = " ".join(fold_width(text).translate(_APOSTROPHES).split()).strip(_ENDS)
    if not 0 < len(written) <= MAX_STATEMENT:
        words = find_statement(text)
        return TeachFact(words) if words is not None else None
    grammar = chinese if has_chinese(written) else english
    whole = grammar.STATEMENT.fullmatch(fold_script(written.lower()))
    if whole is not None:
        return TeachFact(written)
    words = find_statement(text)
    return TeachFact(words) if words is not None else None
