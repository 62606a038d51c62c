"""Join a question, or a drive, and the condition behind it that leans on it, into one sentence.

"Is Dad in the study? If he is, say hello" is read as "if Dad is in the study, say hello": one
condition, told by one look. Law: the part before is read by the grammar alone, and is nothing but
the way to one place and a look or a search there; else the text stays as it is.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from planner.language.folding import has_chinese
from planner.language.grammar.sentence_text import MAX_CHARACTERS
from planner.language.leaning_condition import (
    WhetherThere,
    asks_for_anybody,
    join_within,
    place_condition,
    read_whether_there,
    write_condition,
)
from planner.plan import AnswerPlan, Clarify, Find, GoTo, Language, Look, Refuse, StepPlan

if TYPE_CHECKING:
    from collections.abc import Callable

    from planner.plan import Vocabulary

    PlanOf = Callable[[str], StepPlan | AnswerPlan | Clarify | Refuse]


_WHERE = re.compile(
    r"\b(?P<at>in|inside|on|at|under|near|by) (?:(?:the|my|our) )?[a-z]+(?: (?!for\b)[a-z]+)?"
    r"(?= for\b|[ ,.!?]*$)",
    re.IGNORECASE,
)


def _at(question: str, place: str | None, vocabulary: Vocabulary) -> str:
    """Return how a question says that something is at a place: "on" the desk, "in" the study."""
    found = _WHERE.search(question)
    room = any(entry.id == place and entry.kind == "room" for entry in vocabulary.entries)
    return found["at"].lower() if found is not None else "in" if room else "on"


def in_one_condition(text: str, vocabulary: Vocabulary, plan_of: PlanOf) -> str:
    """Return a text with the condition in full that leans on its first part; else the text.

    Args:
        text: as it was said.
        vocabulary: the site's names.
        plan_of: reads the first part alone.
    """
    parts = join_within(text) if len(text) <= MAX_CHARACTERS else None
    if parts is None:
        return text
    question, rest = parts
    made = plan_of(question)
    steps = made.steps if isinstance(made, StepPlan) else ()
    last = steps[-1] if steps else None
    if not isinstance(last, GoTo | Look | Find) or not all(
        isinstance(step, GoTo | Look | Find) and step.place == last.place for step in steps
    ):
        return text
    language = Language.ZH if has_chinese(rest) else Language.EN
    name = vocabulary.name(last.place).of(language) if last.place is not None else ""
    asked = read_whether_there(last.question) if isinstance(last, Look) else None
    asked = WhetherThere(last.object, "") if isinstance(last, Find) else asked
    if asked is not None and not asked.where and name and language is Language.EN:
        asked = WhetherThere(asked.who, f"{_at(question, last.place, vocabulary)} the {name}")
    asked = asked or asks_for_anybody(rest)
    if asked is not None and (asked.where or name):
        return write_condition(asked, name, rest) or text
    return (place_condition(name, rest) if name else None) or text
