"""Read a sentence into a plan: the offline brain, as one pure function.

The law: every word of the sentence is accounted for by the grammar, or nothing moves; and every
place that a plan drives to is named by the sentence.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner.brain.offline.chinese import CHINESE
from planner.brain.offline.compose import Setting, compose, veto
from planner.brain.offline.english import ENGLISH
from planner.brain.offline.grammar import Grammar
from planner.brain.offline.guard import EXAMPLE, refuse_bad_text
from planner.brain.offline.lexicon import MARK, Marked, lexicon_of
from planner.brain.offline.meaning import Meaning, Problem, Reading, Steps
from planner.brain.offline.normalise import language_of, normalise
from planner.brain.offline.quotes import take_quotes
from planner.brain.stoplane import is_stop
from planner.plan import (
    Answer,
    Clarify,
    Code,
    Frozen,
    GoTo,
    Language,
    Refuse,
    StepPlan,
    Vocabulary,
    message,
)

_SEAM = re.compile(rf"(?<=[a-z0-9])(?={MARK})|(?<={MARK})(?=[a-z0-9])")
_LATIN = re.compile(r"[a-z]")


class Context(Frozen):
    """Tell a brain what it may know besides the sentence: the robot's room, the language."""

    room: str | None = None
    language: Language | None = None


NOWHERE = Context()


def plan(
    text: str, vocabulary: Vocabulary, context: Context = NOWHERE
) -> StepPlan | Answer | Clarify | Refuse:
    """Return the plan of a sentence. Same arguments, same plan; never raises on any text."""
    refused = refuse_bad_text(text)
    if refused is not None:
        return refused
    if is_stop(text):  # the stop lane comes first; should one get here, it stays a stop
        return Refuse(code=Code.STOPPED, reason=message(Code.STOPPED))
    apart, quotes = take_quotes(text)
    lexicon = lexicon_of(vocabulary)
    marked = lexicon.mark(normalise(apart))
    setting = Setting(vocabulary, lexicon, context.language or language_of(text), context.room)
    vetoed = _vetoed(marked, setting)
    if vetoed is not None:
        return vetoed
    meanings = _meanings(marked, Reading(marked, lexicon, vocabulary, quotes), language_of(text))
    if not meanings:
        return Refuse(code=Code.EMPTY_GOAL, reason=message(Code.EMPTY_GOAL, example=EXAMPLE))
    return compose(meanings, marked.restore(marked.text), setting)


def _vetoed(marked: Marked, setting: Setting) -> StepPlan | Answer | Clarify | Refuse | None:
    """Look for words that turn an order into something else, in both languages at once."""
    for (code, english), (_code, chinese) in zip(ENGLISH.vetoes, CHINESE.vetoes, strict=True):
        found = english.search(marked.text) or chinese.search(marked.text)
        if found:
            named = [mention.ids[0] for mention in marked.mentions if len(mention.ids) == 1]
            return veto(code, marked.restore(marked.text), named, setting)
    return None


def _meanings(marked: Marked, reading: Reading, language: Language) -> list[Meaning]:
    """Read the clauses; a Chinese sentence with Latin words is also tried as an English one."""
    if language is Language.EN:
        return _read(ENGLISH, marked.text, reading)
    meanings = _read(CHINESE, marked.text, reading)
    if _LATIN.search(marked.text) and _lost(meanings):
        mixed = _read(ENGLISH, _SEAM.sub(" ", marked.text), reading)
        return meanings if _lost(mixed) else mixed
    return meanings


def _lost(meanings: Sequence[Meaning]) -> bool:
    lost = {Code.NOT_UNDERSTOOD, Code.UNKNOWN_PLACE}
    return any(isinstance(meaning, Problem) and meaning.code in lost for meaning in meanings)


def _read(grammar: Grammar, text: str, reading: Reading) -> list[Meaning]:
    meanings: list[Meaning] = []
    going = False
    for clause in grammar.clauses(text):
        meaning = grammar.read(clause, reading.at(clause, going))
        meanings.append(meaning)
        going = isinstance(meaning, Steps) and (
            going if not meaning.steps else isinstance(meaning.steps[-1], GoTo)
        )
    return meanings
